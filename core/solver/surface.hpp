// A side of the model, or a part of one: quadrature points on it, where they are now, and what can be measured
// there.
#pragma once
#include "core/solver/motion.hpp"
#include "core/solver/stiffness.hpp"

#include <array>
#include <optional>
#include <vector>

namespace gault::core {

class Surface {
  public:
    // Of the cells [first, last) along the side, all of them where none are given.
    Surface(const Motion& motion, int side, std::optional<std::array<int, 2>> cells = {});
    // The one place at this coordinate along the side: its radius and displacement are the place's.
    static Surface at(const Motion& motion, int side, double place);

    int side() const { return side_; }
    const std::array<int, 2>& cells() const { return cells_; } // [first, last)
    bool has_cell(int cell) const { return cell >= cells_[0] && cell < cells_[1]; }
    std::size_t size() const { return facets_.size(); } // quadrature points
    int cell(std::size_t q) const { return facets_[q].cell; }

    // Positions and area vectors now, if anything moved since the last time.
    void refresh(const Motion& motion);
    // Whose functions are not zero everywhere on it, in the order of the side: nodes of the grid, and indices
    // into a nodal field.
    const std::vector<std::array<int, 2>>& ij() const { return ij_; }
    const std::vector<std::size_t>& nodes() const { return nodes_; }
    // The integral of function `a` of a cell over that cell at the start, m^2.
    double extent(int cell, int a) const { return extent_[cell - cells_[0]][a]; }

    // Of quadrature point q. The area vector points out of the soil, m^2 (whole ring, or 1 m of plane
    // strain).
    std::array<double, 2> position(std::size_t q) const { return {at_[q].position[0], at_[q].position[1]}; }
    std::array<double, 2> reference(std::size_t q) const { return {reference_[q][0], reference_[q][1]}; }
    std::array<double, 2> area(std::size_t q) const { return {at_[q].area[0], at_[q].area[1]}; }
    // Nodal interpolation at q.
    std::array<double, 2> interpolate(const VectorField& field, std::size_t q) const;
    // field += N^T force, the consistent nodal force.
    void add_force(VectorField& field, std::size_t q, const std::array<double, 2>& force) const;

    // stiffness += -d(force)/d(displacement) of a pressure against the area vector and a traction on the area
    // whose own derivative is -slope, Pa/m.
    void add_stiffness(Stiffness& stiffness, std::size_t q, double pressure,
                       const std::array<double, 2>& traction,
                       const std::array<std::array<double, 2>, 2>& slope) const;

    // Measures, from the last refresh.
    double initial_radius() const { return initial_radius_; }
    double initial_area() const { return initial_area_; }
    double mean_radius() const;       // m, over the length
    double projected_area() const;    // m^2, across the surface's axis
    double mean_displacement() const; // m, into the soil
    double enclosed_volume() const;   // m^3, between the axis and the surface

  private:
    struct Facet {
        std::array<std::size_t, 3> node{}; // indices into a nodal field
        std::array<std::array<int, 2>, 3> ij{};
        std::array<double, 3> value{}, slope{}; // N and dN/dxi, xi in [0, 1] along the cell
        int cell = 0, functions = 0;
        std::size_t first = 0; // of its nodes, among the surface's
        double weight = 0.0;
        double length = 0.0; // along an axis of degree 0, whose one function has no slope
    };
    struct Now {
        std::array<double, 2> position, area, tangent; // tangent times weight
        double length;
    };

    Surface(const Grid& grid, int side) : side_(side), axisymmetric_(grid.axisymmetric()) {}
    void add_nodes(const Grid& grid);
    void add_facet(const Grid& grid, int cell, double xi, double weight);
    void begin(const Motion& motion); // once it has its facets

    int side_;
    std::array<int, 2> cells_{};
    bool axisymmetric_;
    int64_t configuration_ = -1; // of the last refresh
    std::vector<Facet> facets_;
    std::vector<Now> at_;
    std::vector<std::array<double, 2>> reference_;
    std::vector<std::array<int, 2>> ij_;
    std::vector<std::size_t> nodes_;
    std::vector<std::array<double, 2>> node_at_; // positions
    std::vector<std::array<double, 3>> extent_;
    double initial_radius_ = 0.0, initial_area_ = 0.0;
};

} // namespace gault::core
