#include "core/solver/boundaries.hpp"
#include "core/registry/answer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace gault::core {
namespace {

template <std::size_t N>
void resize(std::array<Column, N>& columns, std::size_t n) {
    for (Column& c : columns)
        c.resize(round_up(n, GAULT_LANES));
}

template <std::size_t N, class Pointer>
void point_at(Pointer (&to)[N], std::array<Column, N>& columns) {
    for (std::size_t k = 0; k < N; ++k)
        to[k] = columns[k].data();
}

template <std::size_t N>
void clear(std::array<Column, N>& columns) {
    for (Column& c : columns)
        std::fill(c.begin(), c.end(), 0.0);
}

std::string described(const SurfaceUse& part, const Scene& scene, const Grid& grid) {
    const Axis& along = grid.axis(1 - normal_axis(part.side));
    const auto [first, last] = *part.cells;
    return fmt::format("part {}: {} of {} cells of {}, from {:.6g} m to {:.6g} m", part.name, last - first,
                       along.cells(), scene.surfaces[static_cast<std::size_t>(part.side)].name,
                       along.knots()[static_cast<std::size_t>(first)],
                       along.knots()[static_cast<std::size_t>(last)]);
}

static_assert(4 + most_parts <= FixedField::symmetry);

} // namespace

Boundaries::Boundaries(const Scene& scene, const Motion& motion,
                       const std::function<SoilBehind(const std::array<double, 2>&)>& behind) {
    for (const SurfaceUse& use : scene.surfaces) {
        surfaces_.emplace_back(motion, use.side, use.cells);
        std::vector<int>& beside = beside_.emplace_back();
        for (int other = 0; other < static_cast<int>(scene.surfaces.size()); ++other)
            if (scene.surfaces[static_cast<std::size_t>(other)].side == use.side) beside.push_back(other);
        if (use.cells) parts_.push_back(described(use, scene, motion.grid()));
    }
    load_on_.resize(surfaces_.size());
    for (const BoundaryUse& use : scene.boundaries) {
        Condition c{Instance(*use.model.component, use.model.parameters),
                    use.surfaces,
                    {},
                    {},
                    {},
                    use.model.parameters.where,
                    {}};
        for (const int surface : c.surfaces)
            c.names.push_back(scene.surfaces[static_cast<std::size_t>(surface)].name);
        for (uint32_t k = 0; k < c.api().control_count; ++k)
            c.control.push_back(c.api().controls[k].initial);
        if (c.api().constrain) hold(c, motion);
        if (c.api().load) prepare_load(c, behind);
        conditions_.push_back(std::move(c));
    }
}

void Boundaries::hold(Condition& condition, const Motion& motion) {
    for (const int index : condition.surfaces) {
        const Surface& surface = surfaces_[index];
        Held held;
        held.ij = surface.ij();
        held.node = surface.nodes();
        const std::size_t n = held.node.size();
        for (auto* columns :
             {&held.reference, &held.position, &held.normal, &held.displacement, &held.fixed, &held.velocity})
            resize(*columns, n);
        for (std::size_t k = 0; k < n; ++k) {
            held.normal[normal_axis(surface.side())][k] = outward(surface.side());
            for (int a = 0; a < 2; ++a)
                held.reference[a][k] = motion.node_position(held.ij[k][0], held.ij[k][1], a);
        }
        condition.held.push_back(std::move(held));
    }
}

void Boundaries::prepare_load(Condition& condition,
                              const std::function<SoilBehind(const std::array<double, 2>&)>& behind) {
    for (const int index : condition.surfaces) {
        const Surface& surface = surfaces_[index];
        const int side = surface.side();
        Loaded l;
        const std::size_t n = surface.size();
        for (auto* columns :
             {&l.position, &l.normal, &l.displacement, &l.velocity, &l.traction, &l.initial_traction})
            resize(*columns, n);
        resize(l.impedance, n);
        l.shear_modulus.resize(round_up(n, GAULT_LANES));
        l.pressure.resize(round_up(n, GAULT_LANES));
        for (std::size_t q = 0; q < n; ++q) {
            const SoilBehind soil = behind(surface.reference(q));
            l.impedance[0][q] = soil.impedance_p;
            l.impedance[1][q] = soil.impedance_s;
            l.shear_modulus[q] = soil.shear_modulus;
            const int axis = normal_axis(side);
            l.initial_traction[axis][q] = outward(side) * soil.stress[axis];
            l.initial_traction[1 - axis][q] = outward(side) * soil.stress[2];
        }
        condition.loaded.push_back(std::move(l));
    }
}

void Boundaries::refuse(const Condition& condition, gault_status status, const gault_error& error) const {
    const std::string text = error_text(error);
    throw RunError(fmt::format("boundary '{}' on {}: {}{}", condition.instance.declaration().name,
                               fmt::join(condition.names, ", "),
                               text.empty() ? "no result and no reason" : text,
                               status == GAULT_RETRY ? " (a boundary cannot ask for a shorter step)" : ""));
}

void Boundaries::constrain(const Motion& motion, double time, double dt, FixedField& fixed,
                           VectorField& value) {
    fixed.release();
    const Grid& grid = motion.grid();
    if (grid.axisymmetric() && grid.axis(0).lower() == 0.0) // no motion across the axis
        for (int j = 0; j < grid.layout().ny; ++j)
            fixed.hold(FixedField::symmetry, 0, grid.layout().index(0, j));
    for (int i = 0; grid.radial() && i < grid.layout().nx; ++i)
        fixed.hold(FixedField::symmetry, 1, grid.layout().index(i, 0));
    for (Condition& condition : conditions_)
        for (std::size_t s = 0; s < condition.held.size(); ++s) {
            Held& held = condition.held[s];
            gault_nodes nodes{};
            nodes.size = sizeof nodes;
            nodes.count = static_cast<int64_t>(held.node.size());
            nodes.padded = static_cast<int64_t>(held.position[0].size());
            nodes.time = time;
            nodes.dt = dt;
            for (std::size_t k = 0; k < held.node.size(); ++k)
                for (int a = 0; a < 2; ++a) {
                    held.position[a][k] = motion.node_position(held.ij[k][0], held.ij[k][1], a);
                    held.displacement[a][k] = held.position[a][k] - held.reference[a][k];
                }
            clear(held.fixed);
            clear(held.velocity);
            point_at(nodes.position, held.position);
            point_at(nodes.normal, held.normal);
            point_at(nodes.displacement, held.displacement);
            point_at(nodes.fixed, held.fixed);
            point_at(nodes.velocity, held.velocity);
            nodes.control = condition.control.data();
            gault_error error{-1, 0, -1, ""};
            const gault_status status = condition.api().constrain(condition.instance.self(), &nodes, &error);
            if (status != GAULT_OK) refuse(condition, status, error);
            impose(condition, condition.surfaces[s], held, dt > 0.0, fixed, value);
        }
}

void Boundaries::impose(const Condition& condition, int surface, const Held& held, bool moves,
                        FixedField& fixed, VectorField& value) const {
    for (int a = 0; a < 2; ++a)
        for (std::size_t k = 0; k < held.node.size(); ++k) {
            if (held.fixed[a][k] == 0.0) continue;
            const std::size_t n = held.node[k];
            const double wanted = held.velocity[a][k];
            if (moves && !std::isfinite(wanted))
                throw RunError(fmt::format("boundary '{}' on {} prescribes a velocity that is not a number",
                                           condition.instance.declaration().name,
                                           fmt::join(condition.names, ", ")));
            if (fixed.c[a][n] != 0.0 &&
                std::abs(value.c[a][n] - wanted) > 1e-12 * (std::abs(value.c[a][n]) + std::abs(wanted)))
                throw InputError(
                    condition.where,
                    fmt::format(
                        "boundary '{}' on {} prescribes {} = {:g} m/s at a node where another boundary "
                        "prescribes {:g} m/s",
                        condition.instance.declaration().name, fmt::join(condition.names, ", "),
                        a ? "v_y" : "v_x", wanted, value.c[a][n]));
            fixed.hold(surface, a, n);
            value.c[a][n] = wanted;
        }
}

void Boundaries::load(const Motion& motion, double time, double dt, const VectorField& velocity,
                      VectorField& force, Stiffness* stiffness) {
    for (int side = 0; side < 4; ++side)
        for (const std::size_t n : surfaces_[side].nodes())
            force.c[0][n] = force.c[1][n] = 0.0;
    std::fill(load_on_.begin(), load_on_.end(), std::array{0.0, 0.0});
    for (Condition& condition : conditions_)
        for (std::size_t s = 0; s < condition.loaded.size(); ++s) {
            Loaded& l = condition.loaded[s];
            Surface& surface = surfaces_[condition.surfaces[s]];
            surface.refresh(motion);
            const std::size_t n = surface.size();
            for (std::size_t q = 0; q < n; ++q) {
                const auto x = surface.position(q), area = surface.area(q),
                           v = surface.interpolate(velocity, q);
                const double size = std::sqrt(area[0] * area[0] + area[1] * area[1]);
                for (int a = 0; a < 2; ++a) {
                    l.position[a][q] = x[a];
                    l.normal[a][q] = size > 0.0 ? area[a] / size : 0.0;
                    l.displacement[a][q] = x[a] - surface.reference(q)[a];
                    l.velocity[a][q] = v[a];
                }
            }
            std::fill(l.pressure.begin(), l.pressure.end(), 0.0);
            clear(l.traction);
            gault_facets facets{};
            facets.size = sizeof facets;
            facets.count = static_cast<int64_t>(n);
            facets.padded = static_cast<int64_t>(l.pressure.size());
            facets.time = time;
            facets.dt = dt;
            point_at(facets.position, l.position);
            point_at(facets.normal, l.normal);
            point_at(facets.displacement, l.displacement);
            point_at(facets.velocity, l.velocity);
            point_at(facets.impedance, l.impedance);
            facets.shear_modulus = l.shear_modulus.data();
            point_at(facets.initial_traction, l.initial_traction);
            facets.control = condition.control.data();
            facets.pressure = l.pressure.data();
            point_at(facets.traction, l.traction);
            if (stiffness) {
                if (l.slope[0].empty()) resize(l.slope, n);
                clear(l.slope);
                point_at(facets.slope, l.slope);
            }
            gault_error error{-1, 0, -1, ""};
            const gault_status status = condition.api().load(condition.instance.self(), &facets, &error);
            if (status != GAULT_OK) refuse(condition, status, error);
            for (std::size_t q = 0; q < n; ++q) {
                const auto area = surface.area(q);
                const double size = std::sqrt(area[0] * area[0] + area[1] * area[1]), p = l.pressure[q];
                const std::array<double, 2> push{l.traction[0][q] * size - p * area[0],
                                                 l.traction[1][q] * size - p * area[1]};
                surface.add_force(force, q, push);
                if (stiffness)
                    surface.add_stiffness(*stiffness, q, l.pressure[q], {l.traction[0][q], l.traction[1][q]},
                                          {{{l.slope[0][q], l.slope[1][q]}, {l.slope[3][q], l.slope[4][q]}}});
                add_load(condition.surfaces[s], surface.cell(q), push);
            }
        }
}

double Boundaries::dashpot_rate(const Motion& motion) {
    VectorField resistance(motion.grid().layout());
    for (const Condition& condition : conditions_) {
        if (!(condition.api().flags & GAULT_BOUNDARY_ELASTIC_BEHIND)) continue;
        for (std::size_t s = 0; s < condition.loaded.size(); ++s) {
            Surface& surface = surfaces_[condition.surfaces[s]];
            surface.refresh(motion);
            for (std::size_t q = 0; q < surface.size(); ++q) {
                const auto area = surface.area(q);
                const double r = condition.loaded[s].impedance[0][q] * std::hypot(area[0], area[1]);
                surface.add_force(resistance, q, {r, r});
            }
        }
    }
    double fastest = 0.0;
    for (const Surface& surface : surfaces_)
        for (const std::size_t n : surface.nodes())
            if (motion.mass()[n] > 0.0) fastest = std::max(fastest, resistance.c[0][n] / motion.mass()[n]);
    return fastest;
}

void Boundaries::add_load(int surface, int cell, const std::array<double, 2>& force) {
    for (const int other : beside_[surface])
        if (surfaces_[other].has_cell(cell))
            for (int a = 0; a < 2; ++a)
                load_on_[other][a] += force[a];
}

double Boundaries::share(int surface, std::size_t k, const FixedField& fixed) const {
    const Surface& own = surfaces_[surface];
    const Surface& side = surfaces_[own.side()];
    const std::vector<int>& beside = beside_[surface];
    const auto holds = [&](int other) {
        return fixed.held_by(other, normal_axis(own.side()), own.nodes()[k]);
    };
    if (std::none_of(beside.begin(), beside.end(), holds)) return 0.0;
    if (surface < 4) return 1.0;
    const int node = own.cells()[0] + static_cast<int>(k); // and the last cell where its function is not zero
    double all = 0.0, here = 0.0;
    for (int cell = std::max(node - 2, 0); cell <= std::min(node, side.cells()[1] - 1); ++cell) {
        if (std::none_of(beside.begin(), beside.end(),
                         [&](int other) { return holds(other) && surfaces_[other].has_cell(cell); }))
            continue;
        const double extent = side.extent(cell, node - cell);
        all += extent;
        if (own.has_cell(cell)) here += extent;
    }
    return here / all;
}

bool Boundaries::Condition::is_on(std::optional<int> surface) const {
    return !surface || std::find(surfaces.begin(), surfaces.end(), *surface) != surfaces.end();
}

std::vector<double*> Boundaries::listeners(const std::string& name, std::optional<int> surface,
                                           std::string& unit) {
    std::vector<double*> found;
    for (Condition& condition : conditions_) {
        if (!condition.is_on(surface)) continue;
        for (uint32_t k = 0; k < condition.api().control_count; ++k)
            if (name == condition.api().controls[k].name) {
                found.push_back(&condition.control[k]);
                unit = condition.api().controls[k].unit;
            }
    }
    return found;
}

std::vector<std::string> Boundaries::control_names(std::optional<int> surface) const {
    std::vector<std::string> names;
    for (const Condition& condition : conditions_) {
        if (!condition.is_on(surface)) continue;
        for (uint32_t k = 0; k < condition.api().control_count; ++k)
            names.emplace_back(condition.api().controls[k].name);
    }
    return names;
}

std::vector<std::string> Boundaries::description() const {
    std::vector<std::string> lines = parts_;
    for (const Condition& condition : conditions_) {
        std::size_t nodes = 0, facets = 0;
        for (const Held& held : condition.held)
            nodes += held.node.size();
        for (std::size_t s = 0; s < condition.loaded.size(); ++s)
            facets += surfaces_[condition.surfaces[s]].size();
        std::vector<std::string> took;
        if (nodes) took.push_back(fmt::format("{} nodes", nodes));
        if (facets) took.push_back(fmt::format("{} quadrature points", facets));
        lines.push_back(fmt::format("{} on {}: {}", condition.instance.declaration().name,
                                    fmt::join(condition.names, ", "), fmt::join(took, ", ")));
    }
    return lines;
}

} // namespace gault::core
