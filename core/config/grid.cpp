#include "core/config/sections.hpp"

#include <cmath>
#include <fmt/format.h>

namespace gault::core::config {
namespace {

constexpr double most_cells_an_axis = 100000;
constexpr std::int64_t most_cells = 10000000;
constexpr double most_graded = 1e6; // largest cell over the smallest

void read_cells(const Fields& fields, Scene& scene) {
    const Node& cells = fields.require("cells", "the number of cells along each axis, [72, 1]");
    const Bounds allowed{.min = 1, .max = most_cells_an_axis};
    const bool radial = scene.symmetry == Symmetry::radial;
    if (radial && cells.kind == NodeKind::scalar) {
        scene.axes[0].cells = static_cast<int>(read_integer(cells, "grid.cells", allowed));
        scene.axes[1].cells = 1;
        return;
    }
    require_kind(cells, NodeKind::list, fields.path("cells"));
    if (cells.items.size() != 2)
        throw InputError(cells.where(),
                         "grid.cells must be two whole numbers; found " + std::to_string(cells.items.size()));
    for (std::size_t i = 0; i < 2; ++i)
        scene.axes[i].cells =
            static_cast<int>(read_integer(cells.items[i], "grid.cells." + std::to_string(i), allowed));
    if (radial && scene.axes[1].cells != 1)
        throw InputError(cells.items[1].where(), "grid.cells: radial symmetry has one row of cells; found " +
                                                     described(cells.items[1]));
    const std::int64_t all = std::int64_t{scene.axes[0].cells} * scene.axes[1].cells;
    if (all > most_cells)
        throw InputError(cells.where(),
                         fmt::format("grid.cells makes {} cells; allowed: {}", all, most_cells));
}

double geometric_ratio(const Location& where, const std::string& path, const Scene& scene, std::size_t axis) {
    const double lower = scene.geometry.lower[axis], upper = scene.geometry.upper[axis];
    if (!(lower > 0.0))
        throw InputError(where, path + " cannot be geometric: the axis begins at " +
                                    fmt::format("{:g}", lower) +
                                    " m, and must begin above 0; write a ratio of neighbouring cells");
    return std::pow(upper / lower, 1.0 / scene.axes[axis].cells);
}

void read_ratio(const Fields* grading, const std::string& name, Scene& scene, std::size_t axis) {
    GridAxis& grid_axis = scene.axes[axis];
    const Node* node = grading ? grading->find(name) : nullptr;
    const std::string path = "grid.grading." + name;
    if (is_auto(node)) {
        const bool ring = axis == 0 && scene.geometry.kind == "annulus";
        grid_axis.ratio = ring ? geometric_ratio(scene.geometry.where, path, scene, axis) : 1.0;
        note_choice(scene, path, ring ? "geometric" : "1",
                    ring ? "strains concentrate at the inner radius" : "equal cells");
        return;
    }
    grid_axis.ratio =
        node->kind == NodeKind::scalar && node->text == "geometric"
            ? geometric_ratio(node->where(), path, scene, axis)
            : read_quantity(*node, path, "1", {.min = 0.0, .min_open = true},
                            "the word geometric, or the ratio of neighbouring cells; 1 is uniform");
    const double spread = std::abs(std::log(grid_axis.ratio)) * (grid_axis.cells - 1);
    if (spread > std::log(most_graded))
        throw InputError(node->where(),
                         fmt::format("{} is {}; over {} cells the largest would be more than {:g} times "
                                     "the smallest",
                                     path, described(*node), grid_axis.cells, most_graded));
}

} // namespace

std::vector<double> cell_centres(const Scene& scene, int axis) {
    const auto i = static_cast<std::size_t>(axis);
    const auto [cells, ratio] = scene.axes[i];
    const double length = scene.geometry.upper[i] - scene.geometry.lower[i];
    const auto node = [&, count = cells, q = ratio](int k) { // as a fraction of the length
        return std::abs(q - 1.0) < 1e-12 ? static_cast<double>(k) / count
                                         : std::expm1(k * std::log(q)) / std::expm1(count * std::log(q));
    };
    std::vector<double> centres;
    for (int k = 0; k < cells; ++k)
        centres.push_back(scene.geometry.lower[i] + length * 0.5 * (node(k) + node(k + 1)));
    return centres;
}

void read_grid(const Source& source, Scene& scene) {
    const auto names = axis_names(scene.geometry);
    const Fields fields(source.root.require("grid", "the background grid: {cells: [72, 1]}"), "grid",
                        {"cells", "grading", "basis"});
    read_cells(fields, scene);
    std::optional<Fields> grading;
    if (const Node* node = fields.find("grading"))
        grading.emplace(*node, "grid.grading", std::vector<std::string>{names[0], names[1]});
    for (std::size_t axis = 0; axis < 2; ++axis)
        read_ratio(grading ? &*grading : nullptr, names[axis], scene, axis);
    scene.basis = Basis::quadratic;
    if (const Node* basis = fields.find("basis"); !is_auto(basis))
        scene.basis = read_choice(*basis, "grid.basis", {"auto", "linear", "quadratic"}) == 1
                          ? Basis::linear
                          : Basis::quadratic;
    else
        note_choice(scene, "grid.basis", "quadratic",
                    "smooth gradients, so no noise where points cross cells");
}

void read_points(const Source& source, Scene& scene) {
    Node nothing;
    nothing.kind = NodeKind::map;
    const Node* node = source.root.find("points");
    const Fields fields(node ? *node : nothing, "points", {"per_cell", "placement"});
    const bool radial = scene.symmetry == Symmetry::radial;
    scene.points_per_cell = radial ? 4 : 16;
    if (const Node* per_cell = fields.find("per_cell"); !is_auto(per_cell)) {
        const auto count = read_integer(*per_cell, "points.per_cell");
        if (radial && (count < 1 || count > 6))
            throw InputError(per_cell->where(),
                             "points.per_cell is " + described(*per_cell) +
                                 "; in radial symmetry, where they lie along the radius: 1 to 6");
        if (!radial && count != 1 && count != 4 && count != 9 && count != 16 && count != 25 && count != 36)
            throw InputError(per_cell->where(), "points.per_cell is " + described(*per_cell) +
                                                    "; allowed: the squares 1, 4, 9, 16, 25, 36");
        scene.points_per_cell = static_cast<int>(count);
    } else {
        note_choice(scene, "points.per_cell", std::to_string(scene.points_per_cell), "four a direction");
    }
    scene.placement = Placement::gauss;
    if (const Node* placement = fields.find("placement"); !is_auto(placement))
        scene.placement = read_choice(*placement, "points.placement", {"auto", "uniform", "gauss"}) == 1
                              ? Placement::uniform
                              : Placement::gauss;
    else
        note_choice(scene, "points.placement", "gauss",
                    "mass and forces are integrated as surface loads are");
}

} // namespace gault::core::config
