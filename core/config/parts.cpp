// Surfaces by name: sides, and parts of them between two knots of the grid.
#include "core/config/sections.hpp"
#include "core/grid/grid.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gault::core::config {
namespace {

constexpr double rounding = 1e-6; // of a cell: what a place may be off a knot that it means

std::vector<double> knots_of(const Scene& scene, int side) {
    return knots_along(scene, 1 - normal_axis(side));
}

int knot_at(double place, const Node& node, const std::string& path, const std::vector<double>& knots) {
    const auto after = std::upper_bound(knots.begin() + 1, knots.end() - 1, place);
    const double low = *(after - 1), high = *after, slack = rounding * (high - low);
    const int cell = static_cast<int>(after - knots.begin()) - 1;
    if (std::abs(place - low) <= slack) return cell;
    if (std::abs(place - high) <= slack) return cell + 1;
    const bool within = place > knots.front() && place < knots.back();
    throw InputError(
        node.where(),
        fmt::format("{} is {}; it must lie where two cells of the grid meet, or at an end; nearest: {}", path,
                    described(node),
                    within ? fmt::format("{:.12g} m and {:.12g} m", low, high)
                           : fmt::format("{:.12g} m", place < low ? low : high)));
}

std::array<int, 2> read_cells(const Node& node, const std::string& path, const std::vector<double>& knots) {
    const auto range = read_range(node, path, "m");
    const std::array<int, 2> cells{knot_at(range[0], node.items[0], path + ".0", knots),
                                   knot_at(range[1], node.items[1], path + ".1", knots)};
    if (cells[0] == cells[1])
        throw InputError(node.where(), path + " holds no cell: both ends are the same place");
    return cells;
}

SurfaceUse read_part(const Key& name, const Node& node, const std::string& path, const Scene& scene) {
    std::vector<std::string> sides = surface_names(scene);
    sides.resize(4);
    if (std::find(sides.begin(), sides.end(), name.text) != sides.end())
        throw InputError(name.place.location(), path + ": " + in_quotes(name.text) +
                                                    " is a side of this geometry; take another name");
    const Node* of = require_kind(node, NodeKind::map, path).find("of");
    if (of == nullptr)
        throw InputError(node.where(),
                         fmt::format("{}.of is missing: one of {}", path, fmt::join(sides, ", ")));
    const int side = index_of_name(*of, path + ".of", sides, "side");
    if (of->text == "axis")
        throw InputError(of->where(), path + ".of: the axis has no parts; it takes no boundary condition");
    const std::string along = axis_names(scene.geometry)[normal_axis(side) == 0 ? 1 : 0];
    const Fields fields(node, path, {"of", along});
    const Node& range = fields.require(along, "from where to where along " + of->text);
    return {name.text, side, read_cells(range, fields.path(along), knots_of(scene, side))};
}

} // namespace

std::vector<std::string> surface_names(const Scene& scene) {
    std::vector<std::string> names;
    for (const SurfaceUse& surface : scene.surfaces)
        names.push_back(surface.name);
    return names;
}

int surface_index(const Node& node, const std::string& path, const Scene& scene) {
    return index_of_name(node, path, surface_names(scene), "surface");
}

void read_parts(const Source& source, Scene& scene) {
    const Node* parts = source.root.require("geometry").find("parts");
    if (parts == nullptr) return;
    require_kind(*parts, NodeKind::map, "geometry.parts");
    if (scene.symmetry == Symmetry::radial)
        throw InputError(parts->where(), "geometry.parts: in radial symmetry nothing varies along a surface, "
                                         "so none has parts; use axisymmetric");
    if (parts->items.size() > most_parts)
        throw InputError(parts->where(), fmt::format("geometry.parts has {} parts; allowed: {}",
                                                     parts->items.size(), most_parts));
    for (std::size_t i = 0; i < parts->items.size(); ++i)
        scene.surfaces.push_back(
            read_part(parts->keys[i], parts->items[i], "geometry.parts." + parts->keys[i].text, scene));
}

double read_gauge(const Node& node, const Scene& scene) {
    const std::string path = "program.gauge";
    const double place = read_quantity(node, path, "m");
    if (scene.symmetry == Symmetry::radial)
        throw InputError(node.where(), path + ": in radial symmetry nothing varies along a surface, so every "
                                              "place of it measures the same; leave it out");
    if (!scene.program_surface)
        throw InputError(node.where(), path + " is a place on a surface: say on which one with `on:`");
    const SurfaceUse& surface = scene.surfaces[static_cast<std::size_t>(*scene.program_surface)];
    const std::vector<double> knots = knots_of(scene, surface.side);
    const auto cells = surface.cells.value_or(std::array{0, static_cast<int>(knots.size()) - 1});
    const double low = knots[static_cast<std::size_t>(cells[0])],
                 high = knots[static_cast<std::size_t>(cells[1])], slack = rounding * (high - low);
    if (place < low - slack || place > high + slack)
        throw InputError(node.where(), fmt::format("{} is {}; {} lies from {:.12g} m to {:.12g} m", path,
                                                   described(node), surface.name, low, high));
    return std::clamp(place, low, high);
}

} // namespace gault::core::config
