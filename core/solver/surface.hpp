// A side of the model: quadrature points on it, where they are now, and what can be measured there.
#pragma once
#include "core/solver/motion.hpp"
#include "core/solver/stiffness.hpp"

#include <array>
#include <vector>

namespace gault::core {

class Surface {
  public:
    Surface(const Motion& motion, int side);

    int side() const { return side_; }
    std::size_t size() const { return facets_.size(); } // quadrature points

    // Positions and area vectors now, if anything moved since the last time.
    void refresh(const Motion& motion);
    const std::vector<std::size_t>& nodes() const { return nodes_; } // indices into a nodal field

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
    double mean_radius() const;       // m, over the length
    double projected_area() const;    // m^2, across the surface's axis
    double mean_displacement() const; // m, into the soil
    double enclosed_volume() const;   // m^3, between the axis and the surface

  private:
    struct Facet {
        std::array<std::size_t, 3> node{}; // indices into a nodal field
        std::array<std::array<int, 2>, 3> ij{};
        std::array<double, 3> value{}, slope{}; // N and dN/dxi, xi in [0, 1] along the cell
        int functions = 0;
        double weight = 0.0;
        double length = 0.0; // along an axis of degree 0, whose one function has no slope
    };
    struct Now {
        std::array<double, 2> position, area, tangent; // tangent times weight
        double length;
    };

    int side_;
    bool axisymmetric_;
    int64_t configuration_ = -1; // of the last refresh
    std::vector<Facet> facets_;
    std::vector<Now> at_;
    std::vector<std::array<double, 2>> reference_;
    std::vector<std::size_t> nodes_;
};

} // namespace gault::core
