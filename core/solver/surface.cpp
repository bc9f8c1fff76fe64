#include "core/solver/surface.hpp"

#include <cmath>
#include <numbers>

namespace gault::core {
namespace {

// Gauss points on [0, 1]: exact for the products of quadratic functions, their slopes and r.
constexpr std::array<std::array<double, 2>, 3> gauss = {
    {{0.1127016653792583, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.8872983346207417, 5.0 / 18.0}}};

} // namespace

Surface::Surface(const Motion& motion, int side, std::optional<std::array<int, 2>> cells)
    : Surface(motion.grid(), side) {
    const Grid& grid = motion.grid();
    const Axis& along = grid.axis(1 - normal_axis(side));
    cells_ = cells.value_or(std::array{0, along.cells()});
    add_nodes(grid);
    for (int cell = cells_[0]; cell < cells_[1]; ++cell)
        for (const auto& [xi, weight] : gauss)
            add_facet(grid, cell, xi, weight);
    begin(motion);
    extent_.resize(static_cast<std::size_t>(cells_[1] - cells_[0]));
    for (std::size_t q = 0; q < facets_.size(); ++q)
        for (int a = 0; a < facets_[q].functions; ++a)
            extent_[q / gauss.size()][a] += facets_[q].value[a] * std::abs(at_[q].area[normal_axis(side)]);
}

Surface Surface::at(const Motion& motion, int side, double place) {
    const Grid& grid = motion.grid();
    const Axis& along = grid.axis(1 - normal_axis(side));
    const int cell = along.cell_of(place);
    Surface surface(grid, side);
    surface.cells_ = {cell, cell + 1};
    surface.add_nodes(grid);
    surface.add_facet(grid, cell, (place - along.origin()[cell]) * along.inverse_length()[cell], 1.0);
    surface.begin(motion);
    return surface;
}

void Surface::add_nodes(const Grid& grid) {
    const int degree = grid.axis(1 - normal_axis(side_)).degree();
    for (int k = cells_[0]; k < cells_[1] + degree; ++k) {
        ij_.push_back(grid.side_node(side_, k));
        nodes_.push_back(grid.layout().index(ij_.back()[0], ij_.back()[1]));
    }
    node_at_.resize(ij_.size());
}

void Surface::add_facet(const Grid& grid, int cell, double xi, double weight) {
    const Axis& along = grid.axis(1 - normal_axis(side_));
    Facet f;
    const Axis::Weights w = along.weights(cell, xi);
    f.cell = cell;
    f.first = static_cast<std::size_t>(cell - cells_[0]);
    f.functions = along.degree() + 1;
    f.weight = weight;
    f.length = along.degree() == 0 ? along.length()[cell] : 0.0;
    for (int a = 0; a < f.functions; ++a) {
        f.ij[a] = grid.side_node(side_, cell + a);
        f.node[a] = grid.layout().index(f.ij[a][0], f.ij[a][1]);
        f.value[a] = w.value[a];
        f.slope[a] = w.slope[a] * along.length()[cell];
    }
    facets_.push_back(f);
}

void Surface::begin(const Motion& motion) {
    at_.resize(facets_.size());
    refresh(motion);
    for (const Now& now : at_)
        reference_.push_back(now.position);
    initial_radius_ = mean_radius();
    initial_area_ = projected_area();
}

void Surface::refresh(const Motion& motion) {
    if (configuration_ == motion.configuration()) return;
    configuration_ = motion.configuration();
    for (std::size_t n = 0; n < ij_.size(); ++n)
        for (int k = 0; k < 2; ++k)
            node_at_[n][k] = motion.node_position(ij_[n][0], ij_[n][1], k);
    for (std::size_t q = 0; q < facets_.size(); ++q) {
        const Facet& f = facets_[q];
        std::array<double, 2> x{}, tangent{0.0, f.length};
        for (int a = 0; a < f.functions; ++a)
            for (int k = 0; k < 2; ++k) {
                const double at = node_at_[f.first + static_cast<std::size_t>(a)][k];
                x[k] += f.value[a] * at;
                tangent[k] += f.slope[a] * at;
            }
        // The outward normal is the tangent turned by a quarter: left of +y on low x, right of it on high x.
        const double turn = side_ == low_x || side_ == high_y ? 1.0 : -1.0;
        const double ring = f.weight * (axisymmetric_ ? 2.0 * std::numbers::pi * x[0] : 1.0);
        at_[q] = {x,
                  {-turn * tangent[1] * ring, turn * tangent[0] * ring},
                  {f.weight * tangent[0], f.weight * tangent[1]},
                  f.weight * std::sqrt(tangent[0] * tangent[0] + tangent[1] * tangent[1])};
    }
}

std::array<double, 2> Surface::interpolate(const VectorField& field, std::size_t q) const {
    const Facet& f = facets_[q];
    std::array<double, 2> v{};
    for (int a = 0; a < f.functions; ++a)
        for (int k = 0; k < 2; ++k)
            v[k] += f.value[a] * field.c[k][f.node[a]];
    return v;
}

void Surface::add_force(VectorField& field, std::size_t q, const std::array<double, 2>& force) const {
    const Facet& f = facets_[q];
    for (int a = 0; a < f.functions; ++a)
        for (int k = 0; k < 2; ++k)
            field.c[k][f.node[a]] += f.value[a] * force[k];
}

void Surface::add_stiffness(Stiffness& stiffness, std::size_t q, double pressure,
                            const std::array<double, 2>& traction,
                            const std::array<std::array<double, 2>, 2>& slope) const {
    const Facet& f = facets_[q];
    const Now& now = at_[q];
    const double turn = side_ == low_x || side_ == high_y ? 1.0 : -1.0;
    const double around = axisymmetric_ ? 2.0 * std::numbers::pi : 0.0,
                 ring = axisymmetric_ ? around * now.position[0] : 1.0;
    const double size = std::hypot(now.area[0], now.area[1]);
    for (int b = 0; b < f.functions; ++b) {
        // d(area vector)/d(displacement of node b)
        const double along = f.slope[b] * f.weight * ring, wider = around * f.value[b];
        const double area[2][2] = {{-turn * now.tangent[1] * wider, -turn * along},
                                   {turn * now.tangent[0] * wider + turn * along, 0.0}};
        double force[2][2];
        for (int m = 0; m < 2; ++m) {
            const double stretch =
                size > 0.0 ? (now.area[0] * area[0][m] + now.area[1] * area[1][m]) / size : 0.0;
            for (int k = 0; k < 2; ++k)
                force[k][m] = pressure * area[k][m] - traction[k] * stretch + slope[k][m] * f.value[b] * size;
        }
        for (int a = 0; a < f.functions; ++a) {
            const double n = f.value[a];
            stiffness.add(f.ij[a], f.ij[b],
                          {{n * force[0][0], n * force[0][1]}, {n * force[1][0], n * force[1][1]}});
        }
    }
}

double Surface::mean_radius() const {
    double total = 0.0, length = 0.0;
    for (const Now& now : at_)
        total += now.position[0] * now.length, length += now.length;
    return total / length;
}

double Surface::projected_area() const {
    double total = 0.0;
    for (const Now& now : at_)
        total += now.area[normal_axis(side_)];
    return std::abs(total);
}

double Surface::mean_displacement() const {
    const int axis = normal_axis(side_);
    double total = 0.0, length = 0.0;
    for (std::size_t q = 0; q < at_.size(); ++q) {
        total += -outward(side_) * (at_[q].position[axis] - reference_[q][axis]) * at_[q].length;
        length += at_[q].length;
    }
    return total / length;
}

// Of the solid of revolution: half the flux of (r, 0) through the surface.
double Surface::enclosed_volume() const {
    double total = 0.0;
    for (const Now& now : at_)
        total += 0.5 * now.position[0] * std::abs(now.area[0]);
    return total;
}

} // namespace gault::core
