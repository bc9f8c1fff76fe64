#include "core/scheduler/cautions.hpp"
#include "core/grid/axis.hpp"
#include "core/scheduler/poisson_ratio.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gault::core {
namespace {

// A side without a boundary that the initial stress pushes against.
bool is_free_under_stress(const Scene& scene, const SurfaceUse& surface) {
    const InitialStress& initial = scene.initial_stress;
    const bool end = surface.side >= low_y;
    if (surface.cells || surface.name == "axis" || (end && scene.symmetry == Symmetry::radial)) return false;
    const bool pushed =
        end ? initial.vertical != 0.0 || (initial.gravity && (surface.side == low_y || initial.depth > 0.0))
            : initial.k0 * initial.vertical != 0.0 || (initial.gravity && initial.k0 > 0.0);
    return pushed &&
           std::none_of(scene.boundaries.begin(), scene.boundaries.end(), [&](const BoundaryUse& use) {
               return std::any_of(use.surfaces.begin(), use.surfaces.end(), [&](int s) {
                   return scene.surfaces[static_cast<std::size_t>(s)].side == surface.side;
               });
           });
}

// Whether a boundary stands for elastic soil.
bool elastic_behind(const Scene& scene) {
    return std::any_of(scene.boundaries.begin(), scene.boundaries.end(), [](const BoundaryUse& use) {
        return static_cast<const gault_boundary_api*>(use.model.component->declaration->api)->flags &
               GAULT_BOUNDARY_ELASTIC_BEHIND;
    });
}

// Soil that hardly changes its volume, in cells that leave its points no way to.
std::string locking(const Scene& scene) {
    if (scene.volumetric_strain != VolumetricStrain::pointwise) return "";
    const double nu = largest_poisson_ratio(scene);
    const bool linear = scene.basis == Basis::linear;
    const int along = scene.symmetry == Symmetry::radial ? scene.points_per_cell
                                                         : static_cast<int>(std::sqrt(scene.points_per_cell));
    if (along > (linear ? 1 : 2) && nu > (linear ? 0.45 : 0.49))
        return fmt::format("caution: with Poisson's ratio {:.5g} at the start these cells lock: pressures "
                           "come out too high, on "
                           "few cells by far; without inertia take {}, else quadratic cells with {}",
                           nu,
                           scene.symmetry == Symmetry::radial ? "linear cells with one point"
                                                              : "model.volumetric_strain cell_mean",
                           scene.symmetry == Symmetry::radial ? "2 points" : "4 points");
    if (!linear && nu > 0.49)
        return fmt::format(
            "caution: with Poisson's ratio {:.5g} at the start the stresses of points scatter in "
            "quadratic cells{}; pressures do not",
            nu, scene.frame == Frame::updated ? ", in the updated frame by more than they are" : "");
    return "";
}

// Regions take whole cells: where that moves an edge by more than the accuracy's share of the region.
void edges_within_cells(const Scene& scene, std::vector<std::string>& all) {
    for (const Region& region : scene.regions)
        for (std::size_t k = 0; k < 2; ++k) {
            const std::vector<double> knots = Axis::graded(scene.geometry.lower[k], scene.geometry.upper[k],
                                                           scene.axes[k].cells, scene.axes[k].ratio);
            const auto& [low, high] = region.extent[k];
            for (const auto& [edge, taken] :
                 {std::pair{low, knots[static_cast<std::size_t>(region.cells.first[k])]},
                  {high, knots[static_cast<std::size_t>(region.cells.last[k])]}})
                if (std::abs(edge - taken) > scene.accuracy * (high - low))
                    all.push_back(fmt::format("caution: the region '{}' has an edge at {:.4g} m along {}, "
                                              "within a cell; cells are whole, "
                                              "and it is taken to be at {:.4g} m",
                                              region.name, edge,
                                              k == 1                           ? "y"
                                              : scene.geometry.kind == "block" ? "x"
                                                                               : "r",
                                              taken));
        }
}

} // namespace

std::vector<std::string> cautions(const Scene& scene) {
    std::vector<std::string> all;
    if (scene.solver.time_step_factor > 1.0)
        all.push_back(fmt::format("caution: with solver.time_step_factor {:g} the step exceeds the stability "
                                  "limit; the run will likely fail",
                                  scene.solver.time_step_factor));
    if (scene.frame == Frame::updated && scene.basis == Basis::linear)
        all.push_back("caution: with grid.basis linear, forces jump where points cross cells; take "
                      "quadratic, or model.frame total");
    for (const SurfaceUse& surface : scene.surfaces)
        if (is_free_under_stress(scene, surface))
            all.push_back(
                fmt::format("caution: nothing acts on '{}', against which the initial stress pushes; give it "
                            "a boundary",
                            surface.name));
    const bool dynamic = scene.solver.kind == SolverKind::explicit_dynamics;
    if (scene.points_per_cell == 1 && (dynamic || scene.symmetry != Symmetry::radial))
        all.push_back("caution: one point a cell passes no motion whose sign alternates from node to node, "
                      "so forces of that shape are never balanced; take 4 points");
    if (scene.points_per_cell == 1 && scene.basis == Basis::quadratic)
        all.push_back(
            "caution: one point a cell does not integrate quadratic functions: the error falls with the "
            "first power of the cells; take 2 points in radial symmetry, 4 elsewhere");
    if (scene.placement == Placement::uniform && scene.points_per_cell == 4 &&
        scene.basis == Basis::quadratic)
        all.push_back(
            "caution: four uniform points do not integrate quadratic functions, so surface loads and inertia "
            "disagree; take points.placement gauss, or 9 points");
    if (std::string caution = locking(scene); !caution.empty()) all.push_back(std::move(caution));
    if (scene.frame == Frame::updated && elastic_behind(scene))
        all.push_back(
            "caution: in the updated frame it is not watched whether soil yields up to the boundary that "
            "stands for elastic soil; model.frame total says so");
    edges_within_cells(scene, all);
    return all;
}

std::vector<std::string> notes(Simulation& simulation) {
    std::vector<std::string> all;
    for (const Material& material : simulation.model().materials)
        if (simulation.scene().solver.kind == SolverKind::quasi_static && !material.has_tangent())
            all.push_back(
                fmt::format("material {}: its plugin has no tangent, so it is differentiated numerically, "
                            "with four more updates a point",
                            material.name()));
    return all;
}

RunCautions::RunCautions(Simulation& simulation) : simulation_(simulation) {
    if (simulation.scene().frame == Frame::total && elastic_behind(simulation.scene()))
        elasticity_.emplace(simulation.model(), simulation.solver().motion(),
                            simulation.scene().volumetric_strain);
}

std::vector<std::string> RunCautions::now(const std::vector<std::vector<double>>& rows, bool ended) const {
    std::vector<std::string> all;
    for (std::string& caution : std::array{kinetic(rows), yield(), ended ? frames() : ""})
        if (!caution.empty()) all.push_back(std::move(caution));
    return all;
}

// A quasi-static curve of a run that is not quasi-static is the commonest misuse of mass scaling. The pressure of a
// cavity is off by up to six times the ratio (docs/accuracy.md, loading rate): by about half a percent at this limit.
std::string RunCautions::kinetic(const std::vector<std::vector<double>>& rows) const {
    const double ratio = simulation_.largest_kinetic_ratio(rows);
    constexpr double quasi_static = 1e-3;
    if (ratio <= quasi_static) return "";
    return fmt::format(
        "caution: kinetic energy reached {:.2g} % of the strain energy, and was above {:g} % of it until "
        "{:.4g} s: results until then show inertia. Load more slowly{}",
        100.0 * ratio, 100.0 * quasi_static, simulation_.quiet_since(rows, quasi_static),
        simulation_.scene().solver.mass_scaling > 1.0 ? ", or lower solver.mass_scaling" : "");
}

std::string RunCautions::yield() const {
    if (yielding_ == 0.0) return "";
    return fmt::format(
        "caution: the soil yields up to the boundary at {:.4g} m, which stands for elastic soil "
        "beyond; about {:.3g} m would have been enough",
        simulation_.scene().geometry.upper[0], yielding_);
}

std::string RunCautions::frames() const {
    std::vector<double> never;
    for (const Crossing& frame : simulation_.frames())
        if (!frame.done()) never.push_back(frame.target());
    if (never.empty()) return "";
    return fmt::format("caution: {} never reached {:g}, where frames were asked for",
                       simulation_.scene().frames.measure, fmt::join(never, ", "));
}

// Notices soil that yields up to a boundary that stands for elastic soil, and how far it would have.
void RunCautions::look() {
    if (!elasticity_) return;
    const double outer = simulation_.scene().geometry.upper[0];
    const Axis& axis = simulation_.model().grid.axis(0);
    const Motion& motion = simulation_.solver().motion();
    if (elasticity_->largest_inelastic_radius(motion) >= outer - axis.length()[axis.cells() - 1])
        yielding_ = std::max(yielding_, elasticity_->yielding_radius(motion, outer));
}

} // namespace gault::core
