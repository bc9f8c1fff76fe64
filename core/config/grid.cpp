#include "core/config/sections.hpp"
#include "core/grid/axis.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace gault::core::config {
namespace {

constexpr double most_cells_an_axis = 100000;
constexpr std::int64_t most_cells = 10000000;
constexpr double most_graded = 1e6; // largest cell over the smallest

void read_cells(const Fields& fields, Scene& scene) {
    if (is_auto(fields.find("cells"))) {
        scene.axes[0].cells = 32;
        scene.axes[1].cells = scene.symmetry == Symmetry::radial ? 1 : 8;
        note_choice(scene, "grid.cells", fmt::format("[{}, {}]", scene.axes[0].cells, scene.axes[1].cells),
                    "a few");
        return;
    }
    const Node& cells = fields.require("cells");
    const Bounds allowed{.min = 1, .max = most_cells_an_axis};
    const bool radial = scene.symmetry == Symmetry::radial;
    if (cells.kind == NodeKind::scalar) { // one row
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

void read_ratio(const Fields& grading, const std::string& name, Scene& scene, std::size_t axis) {
    GridAxis& grid_axis = scene.axes[axis];
    const Node* node = grading.find(name);
    const std::string path = grading.path(name);
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

void read_per_cell(const Fields& fields, Scene& scene) {
    const bool radial = scene.symmetry == Symmetry::radial;
    const Node* node = fields.find("per_cell");
    if (is_auto(node)) {
        scene.points_per_cell = radial ? 4 : 16;
        note_choice(scene, "points.per_cell", std::to_string(scene.points_per_cell), "four a direction");
        return;
    }
    const auto count = read_integer(*node, "points.per_cell");
    const std::vector<std::int64_t> allowed =
        radial ? std::vector<std::int64_t>{1, 2, 3, 4, 5, 6} : std::vector<std::int64_t>{1, 4, 9, 16, 25, 36};
    const bool may_be_radial = scene.symmetry_open && count >= 1 && count <= 6;
    if (!may_be_radial && std::find(allowed.begin(), allowed.end(), count) == allowed.end())
        throw InputError(node->where(), fmt::format("points.per_cell is {}; allowed{} {}", described(*node),
                                                    radial ? " along the radius:" : ": the squares",
                                                    fmt::join(allowed, ", ")));
    scene.points_per_cell = static_cast<int>(count);
}

} // namespace

std::vector<double> knots_along(const Scene& scene, int axis) {
    const auto i = static_cast<std::size_t>(axis);
    return Axis::graded(scene.geometry.lower[i], scene.geometry.upper[i], scene.axes[i].cells,
                        scene.axes[i].ratio);
}

std::vector<double> cell_centres(const Scene& scene, int axis) {
    const std::vector<double> knots = knots_along(scene, axis);
    std::vector<double> centres;
    for (std::size_t k = 1; k < knots.size(); ++k)
        centres.push_back(0.5 * (knots[k - 1] + knots[k]));
    return centres;
}

void read_grid(const Source& source, Scene& scene) {
    const auto names = axis_names(scene.geometry);
    const Fields fields = source.root.section("grid", {"cells", "grading", "basis"});
    read_cells(fields, scene);
    const Fields grading = fields.section("grading", {names[0], names[1]});
    for (std::size_t axis = 0; axis < 2; ++axis)
        read_ratio(grading, names[axis], scene, axis);
    scene.basis = choose(scene, fields, "basis", {"linear", "quadratic"}, Basis::quadratic,
                         "smooth gradients, so no noise where points cross cells");
}

void read_points(const Source& source, Scene& scene) {
    const Fields fields = source.root.section("points", {"per_cell", "placement"});
    read_per_cell(fields, scene);
    scene.placement = choose(scene, fields, "placement", {"uniform", "gauss"}, Placement::gauss,
                             "mass and forces are integrated as surface loads are");
}

} // namespace gault::core::config
