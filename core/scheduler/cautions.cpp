#include "core/scheduler/cautions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

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
    return scene.frame == Frame::total &&
           std::any_of(scene.boundaries.begin(), scene.boundaries.end(), [](const BoundaryUse& use) {
               return static_cast<const gault_boundary_api*>(use.model.component->declaration->api)->flags &
                      GAULT_BOUNDARY_ELASTIC_BEHIND;
           });
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
    if (elastic_behind(simulation.scene()))
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
// cavity is off by three to six times the ratio (docs/accuracy.md, loading rate): by about half a percent at this limit.
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
