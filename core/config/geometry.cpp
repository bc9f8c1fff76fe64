#include "core/config/sections.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace gault::core::config {
namespace {

using Sides = std::array<std::string, 4>;

constexpr double wide = 1000.0; // cavity radii, where the outer radius is left open

Sides read_annulus(const Fields& fields, Geometry& geometry) {
    const double inner = fields.quantity("inner_radius", "m", positive);
    geometry.open_ended = is_auto(&fields.require("outer_radius", "the word auto, or a radius in m"));
    const double outer = geometry.open_ended ? wide * inner : fields.quantity("outer_radius", "m", positive);
    if (!(inner < outer))
        throw InputError(fields.require("inner_radius").where(),
                         fmt::format("{} is {}; it must be less than the outer radius, {}",
                                     fields.path("inner_radius"), described(fields.require("inner_radius")),
                                     described(fields.require("outer_radius"))));
    const double bottom = fields.quantity("bottom", "m", {}, 0.0);
    geometry.lower = {inner, bottom};
    geometry.upper = {outer, bottom + fields.quantity("height", "m", positive)};
    return {"inner", "outer", "bottom", "top"};
}

Sides read_cylinder(const Fields& fields, Geometry& geometry) {
    const double bottom = fields.quantity("bottom", "m", {}, 0.0);
    geometry.lower = {0.0, bottom};
    geometry.upper = {fields.quantity("radius", "m", positive),
                      bottom + fields.quantity("height", "m", positive)};
    return {"axis", "outer", "bottom", "top"};
}

Sides read_block(const Fields& fields, Geometry& geometry) {
    geometry.lower = {0.0, 0.0};
    if (const Node* origin = fields.find("origin")) {
        require_kind(*origin, NodeKind::list, fields.path("origin"));
        if (origin->items.size() != 2)
            throw InputError(origin->where(), fields.path("origin") + " must be [x, y]");
        for (std::size_t i = 0; i < 2; ++i)
            geometry.lower[i] = read_quantity(origin->items[i], fields.path("origin"), "m");
    }
    geometry.upper = {geometry.lower[0] + fields.quantity("width", "m", positive),
                      geometry.lower[1] + fields.quantity("height", "m", positive)};
    return {"left", "right", "bottom", "top"};
}

struct Shape {
    std::string name;
    std::vector<std::string> keys;
    Sides (*read)(const Fields&, Geometry&);
};

const std::vector<Shape>& shapes() {
    static const std::vector<Shape> all = {
        {"annulus", {"inner_radius", "outer_radius", "height", "bottom"}, read_annulus},
        {"cylinder", {"radius", "height", "bottom"}, read_cylinder},
        {"block", {"width", "height", "origin"}, read_block}};
    return all;
}

void check_symmetry(const Node& node, const Scene& scene) {
    const bool block = scene.geometry.kind == "block";
    if (block && scene.symmetry != Symmetry::plane_strain)
        throw InputError(node.where(), "model.symmetry: a block has no axis; use the geometry annulus or "
                                       "cylinder, or plane_strain");
    if (!block && scene.symmetry == Symmetry::plane_strain)
        throw InputError(node.where(), "model.symmetry: the geometry " + scene.geometry.kind +
                                           " is axisymmetric; use the geometry block for plane_strain");
}

} // namespace

void note_choice(Scene& scene, const std::string& key, const std::string& value, const std::string& reason) {
    scene.chosen.push_back({key, value, reason});
}

std::size_t choose(Scene& scene, const Fields& fields, std::string_view key,
                   const std::vector<std::string>& words, std::size_t fallback, const std::string& reason) {
    const Node* node = fields.find(key);
    if (is_auto(node)) {
        note_choice(scene, fields.path(key), words[fallback], reason);
        return fallback;
    }
    std::vector<std::string> allowed{"auto"};
    allowed.insert(allowed.end(), words.begin(), words.end());
    return read_choice(*node, fields.path(key), allowed) - 1;
}

std::array<std::string, 2> axis_names(const Geometry& geometry) {
    return {geometry.kind == "block" ? "x" : "r", "y"};
}

void read_geometry(const Source& source, Scene& scene) {
    std::vector<std::string> names;
    for (const auto& shape : shapes())
        names.push_back(shape.name);
    names.emplace_back("parts");
    const Node& node = source.root.require("geometry", "one of annulus, cylinder, block");
    const Fields fields(node, "geometry", names);
    std::vector<Key> found;
    std::copy_if(node.keys.begin(), node.keys.end(), std::back_inserter(found),
                 [](const Key& key) { return key.text != "parts"; });
    if (found.size() != 1)
        throw InputError(node.where(), "geometry must be exactly one of annulus, cylinder, block");
    const auto shape = std::find_if(shapes().begin(), shapes().end(),
                                    [&](const Shape& candidate) { return candidate.name == found[0].text; });
    scene.geometry.kind = shape->name;
    scene.geometry.where = found[0].place.location();
    const Sides sides = shape->read(
        Fields(fields.require(shape->name), fields.path(shape->name), shape->keys), scene.geometry);
    for (int side = 0; side < 4; ++side)
        scene.surfaces.push_back({sides[static_cast<std::size_t>(side)], side, {}});
    for (std::size_t axis = 0; axis < 2; ++axis)
        if (!(scene.geometry.lower[axis] < scene.geometry.upper[axis]))
            throw InputError(scene.geometry.where,
                             "geometry." + shape->name + " is too small for where it lies");
    if (scene.geometry.open_ended)
        note_choice(scene, "geometry.annulus.outer_radius", fmt::format("{:g} m", scene.geometry.upper[0]),
                    "far away");
}

void read_model(const Source& source, Scene& scene) {
    const Fields fields = source.root.section("model", {"symmetry", "frame", "solver", "volumetric_strain"});
    const std::string& kind = scene.geometry.kind;
    scene.symmetry = choose(scene, fields, "symmetry", {"radial", "axisymmetric", "plane_strain"},
                            kind == "block" ? Symmetry::plane_strain : Symmetry::axisymmetric,
                            "the geometry is " + std::string(kind == "annulus" ? "an " : "a ") + kind);
    scene.symmetry_open = kind != "block" && is_auto(fields.find("symmetry"));
    if (const Node* symmetry = fields.find("symmetry")) check_symmetry(*symmetry, scene);
    scene.height = {scene.geometry.lower[1], scene.geometry.upper[1]};
    if (scene.symmetry == Symmetry::radial) {
        scene.geometry.lower[1] = 0.0;
        scene.geometry.upper[1] = 1.0;
    }
    scene.frame =
        choose(scene, fields, "frame", {"total", "updated"}, Frame::total, "material stays in place");
    scene.solver.kind = choose(scene, fields, "solver", {"explicit", "quasi_static"},
                               SolverKind::explicit_dynamics, "nothing is assumed about inertia");
    scene.volumetric_strain = choose(scene, fields, "volumetric_strain", {"pointwise", "cell_mean"},
                                     VolumetricStrain::pointwise, "the strain of every point is its own");
    // A solver that is chosen later is written then.
    if (scene.volumetric_strain == VolumetricStrain::cell_mean &&
        scene.solver.kind == SolverKind::explicit_dynamics && !is_auto(fields.find("solver")))
        throw InputError(fields.require("volumetric_strain").where(),
                         "model.volumetric_strain: the explicit solver has it pointwise only; take "
                         "model.solver: quasi_static");
}

} // namespace gault::core::config
