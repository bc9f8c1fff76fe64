#include "core/config/component.hpp"
#include "core/config/sections.hpp"
#include "core/grid/grid.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gault::core::config {
namespace {

// Stresses that rise with depth, or are the same everywhere where there is no gravity.
InitialStress read_vertical(const Fields& fields, bool gravity) {
    InitialStress stress;
    stress.gravity = gravity;
    stress.k0 = fields.quantity("k0", "1", not_negative);
    if (!gravity) {
        if (const Node* depth = fields.find("depth"))
            throw InputError(depth->where(),
                             fields.path("depth") +
                                 " needs gravity: without it the stress does not rise with depth");
        if (fields.find("vertical") == nullptr)
            throw InputError(fields.where(), fields.path() +
                                                 " follows the weight of the soil, and there is no gravity; "
                                                 "write `gravity: 9.81 m/s^2`, or the vertical stress");
    }
    stress.depth = fields.quantity("depth", "m", not_negative, 0.0);
    stress.vertical = fields.quantity("vertical", "Pa", {}, 0.0);
    return stress;
}

InitialStress read_stress(const Fields& fields, bool gravity) {
    const Node* isotropic = fields.find("isotropic");
    if (isotropic == nullptr) return read_vertical(fields, gravity);
    for (const char* other : {"vertical", "k0", "depth"})
        if (const Node* node = fields.find(other))
            throw InputError(node->where(), fields.path(other) + " contradicts " + fields.path("isotropic") +
                                                "; the stress is one or the other");
    InitialStress stress;
    stress.vertical = fields.quantity("isotropic", "Pa", {});
    return stress;
}

bool overlap(const SurfaceUse& a, const SurfaceUse& b) {
    if (a.side != b.side) return false;
    return !a.cells || !b.cells || ((*a.cells)[0] < (*b.cells)[1] && (*b.cells)[0] < (*a.cells)[1]);
}

// A spring that falls with the radius needs one: on a flat side x is no radius, and soil inside a cavity is not beyond.
void refuse_without_radius(const BoundaryUse& boundary, const SurfaceUse& surface, const Node& node,
                           const std::string& path, const Scene& scene) {
    const gault_component& c = *boundary.model.component->declaration;
    if (!(static_cast<const gault_boundary_api*>(c.api)->flags & GAULT_BOUNDARY_ELASTIC_BEHIND)) return;
    if (surface.side >= low_y || (surface.side == high_x && scene.geometry.kind != "block")) return;
    throw InputError(node.where(), fmt::format("{}: {} stands for the soil outside a cylinder; it cannot act "
                                               "on {}",
                                               path, c.name, in_quotes(surface.name)));
}

void add_surface(BoundaryUse& boundary, const Node& node, const std::string& path, const Scene& scene) {
    const int index = surface_index(node, path, scene);
    const SurfaceUse& surface = scene.surfaces[static_cast<std::size_t>(index)];
    if (index == 0 && surface.name == "axis")
        throw InputError(node.where(), path + ": the axis takes no boundary condition; "
                                              "the radial velocity there is zero by symmetry");
    refuse_without_radius(boundary, surface, node, path, scene);
    for (const int other : boundary.surfaces) {
        const SurfaceUse& before = scene.surfaces[static_cast<std::size_t>(other)];
        if (overlap(surface, before))
            throw InputError(node.where(), path + ": the surface " + in_quotes(surface.name) +
                                               (other == index ? " is named twice"
                                                               : " overlaps " + in_quotes(before.name)));
    }
    boundary.surfaces.push_back(index);
}

BoundaryUse read_boundary(const Node& node, const std::string& path, const Source& source,
                          const Scene& scene) {
    require_kind(node, NodeKind::map, path);
    BoundaryUse boundary{{}, read_component(node, path, {"on", "type"}, GAULT_BOUNDARY, source.registry)};
    const Node* on = node.find("on");
    if (on == nullptr)
        throw InputError(node.where(), fmt::format("{}.on is missing: one or more of {}", path,
                                                   fmt::join(surface_names(scene), ", ")));
    const auto surfaces = one_or_more(*on);
    if (surfaces.empty()) throw InputError(on->where(), path + ".on names no surface");
    for (std::size_t i = 0; i < surfaces.size(); ++i)
        add_surface(boundary, *surfaces[i],
                    path + (on->kind == NodeKind::list ? ".on." + std::to_string(i) : ".on"), scene);
    return boundary;
}

// Where the outer radius is left open and nothing acts there: a boundary that declares itself made for it.
void stand_for_the_soil_beyond(const Source& source, const Location& where, Scene& scene) {
    for (const BoundaryUse& use : scene.boundaries)
        for (const int surface : use.surfaces)
            if (scene.surfaces[static_cast<std::size_t>(surface)].side == high_x) return;
    for (const Component& component : source.registry.components()) {
        if (component.declaration->kind != GAULT_BOUNDARY ||
            !(static_cast<const gault_boundary_api*>(component.declaration->api)->flags &
              GAULT_BOUNDARY_ELASTIC_BEHIND))
            continue;
        Node nothing;
        nothing.kind = NodeKind::map;
        BoundaryUse use{{high_x}, {&component, read_parameters(nothing, "boundaries", {}, component)}, true};
        use.model.parameters.where = where;
        scene.boundaries.push_back(std::move(use));
        return;
    }
    throw InputError(where, "the outer radius is auto, and no plugin stands for the soil beyond it");
}

} // namespace

void read_gravity(const Source& source, Scene& scene) {
    scene.gravity = {0.0, 0.0};
    if (const double g = source.root.quantity("gravity", "m/s^2", not_negative, 0.0); g > 0.0)
        scene.gravity[1] = -g;
}

void read_initial(const Source& source, Scene& scene) {
    const Node* node = source.root.find("initial");
    if (node == nullptr) {
        note_choice(scene, "initial.stress", "0 Pa", "nothing is said");
        return;
    }
    const Fields initial(*node, "initial", {"stress"});
    const Node& stress = initial.require("stress", "{isotropic: 90 kPa} or {vertical: 100 kPa, k0: 0.5}");
    const Fields fields(stress, "initial.stress", {"isotropic", "vertical", "k0", "depth"});
    scene.initial_stress = read_stress(fields, scene.gravity[1] != 0.0);
    scene.initial_stress.where = fields.where();
}

void read_boundaries(const Source& source, Scene& scene) {
    const Node& boundaries = source.root.require("boundaries", "a list of {on: SURFACE, type: NAME, ...}");
    require_kind(boundaries, NodeKind::list, "boundaries");
    if (boundaries.items.empty())
        throw InputError(boundaries.where(), "boundaries is empty; nothing would hold the soil");
    for (std::size_t i = 0; i < boundaries.items.size(); ++i)
        scene.boundaries.push_back(
            read_boundary(boundaries.items[i], "boundaries." + std::to_string(i), source, scene));
    if (scene.geometry.open_ended) stand_for_the_soil_beyond(source, boundaries.where(), scene);
}

void read_program(const Source& source, Scene& scene) {
    const Node& program = source.root.require("program", "what is done to the soil: {type: NAME, ...}");
    scene.program =
        read_component(program, "program", {"on", "type", "gauge"}, GAULT_PROGRAM, source.registry);
    if (const Node* on = program.find("on")) scene.program_surface = surface_index(*on, "program.on", scene);
    if (const Node* gauge = program.find("gauge")) scene.program_gauge = read_gauge(*gauge, scene);
}

void read_solver(const Source& source, Scene& scene) {
    const std::vector<std::string> dynamic = {"time_step_factor", "damping", "viscosity", "mass_scaling",
                                              "stress_update"},
                                   quasi_static = {"strain_step", "tolerance"};
    std::vector<std::string> keys = dynamic;
    keys.insert(keys.end(), quasi_static.begin(), quasi_static.end());
    const Fields fields = source.root.section("solver", keys);
    for (const std::string& key : dynamic)
        if (fields.find(key)) scene.solver.dynamic_key = fields.path(key);
    const bool open = std::any_of(scene.chosen.begin(), scene.chosen.end(),
                                  [](const Choice& choice) { return choice.key == "model.solver"; });
    const bool inertia = open ? !scene.solver.dynamic_key.empty() // as the plan will have it
                              : scene.solver.kind == SolverKind::explicit_dynamics;
    for (const std::string& key : inertia ? quasi_static : dynamic)
        if (fields.find(key))
            note_choice(scene, fields.path(key), "not used",
                        inertia ? "the solver is explicit" : "the solver is quasi_static");
    SolverSettings& solver = scene.solver;
    solver.time_step_factor = fields.quantity(
        "time_step_factor", "1", {.min = 0.0, .max = 2.0, .min_open = true}, solver.time_step_factor);
    solver.viscosity = fields.quantity("viscosity", "1", not_negative, solver.viscosity);
    solver.damping =
        fields.quantity("damping", "1", {.min = 0.0, .max = 1.0, .max_open = true}, solver.damping);
    if (!is_auto(fields.find("strain_step")))
        solver.strain_step = fields.quantity("strain_step", "1", positive);
    else if (!inertia)
        note_choice(scene, fields.path("strain_step"), fmt::format("{:g}", solver.strain_step),
                    "no pilot run is made");
    solver.tolerance =
        fields.quantity("tolerance", "1", {.min = 0.0, .max = 0.1, .min_open = true}, solver.tolerance);
    solver.mass_scaling = fields.quantity("mass_scaling", "1", {.min = 1.0}, solver.mass_scaling);
    if (const Node* update = fields.find("stress_update"))
        solver.stress_update =
            static_cast<StressUpdate>(read_choice(*update, "solver.stress_update", {"usl", "usf"}));
}

} // namespace gault::core::config
