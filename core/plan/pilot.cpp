#include "core/plan/pilot.hpp"
#include "core/scheduler/elasticity.hpp"
#include "core/scheduler/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

namespace gault::core {
namespace {

constexpr int fewest = 4;        // cells along an axis that has so many
constexpr int radial_cells = 60; // enough for a step to be as long as on a fine grid

Override cells(int x, int y) {
    return {"grid.cells", fmt::format("[{}, {}]", x, y)};
}

std::vector<Override> radial_pilot(const Scene& scene) {
    std::vector<Override> changes{{"model.symmetry", "radial"},
                                  {"grid.basis", "linear"},
                                  {"points", "{per_cell: 1}"},
                                  cells(std::min(scene.axes[0].cells, radial_cells), 1)};
    if (scene.geometry.lower[0] > 0.0) changes.push_back({"grid.grading", "{r: geometric}"});
    return changes;
}

// Every `factor` cells of the scene's own grid become one.
std::vector<Override> coarse_pilot(const Scene& scene, int factor) {
    std::array<int, 2> n{};
    std::array<double, 2> ratio{};
    for (std::size_t k = 0; k < 2; ++k) {
        n[k] = std::max(std::min(scene.axes[k].cells, fewest), scene.axes[k].cells / factor);
        ratio[k] = std::pow(scene.axes[k].ratio, static_cast<double>(scene.axes[k].cells) / n[k]);
    }
    const char* across = scene.geometry.kind == "block" ? "x" : "r";
    return {cells(n[0], n[1]),
            {"model.volumetric_strain", "cell_mean"},
            {"grid.grading", fmt::format("{{{}: {:.17g}, y: {:.17g}}}", across, ratio[0], ratio[1])}};
}

// The pilot's scene: nullopt where no coarse grid fits the scene's parts and regions.
std::optional<Scene> pilot_scene(const Scene& scene, const Reread& reread,
                                 const std::vector<Override>& more) {
    const std::vector<Override> always{
        {"model.solver", "quasi_static"}, {"model.frame", "total"}, {"output", "{}"}, {"reference", "{}"}};
    std::vector<std::vector<Override>> tries;
    if (not_radial(scene).empty()) tries.push_back(radial_pilot(scene));
    for (const int factor : {8, 4, 2})
        tries.push_back(coarse_pilot(scene, factor));
    for (std::vector<Override>& changes : tries) {
        changes.insert(changes.end(), always.begin(), always.end());
        changes.insert(changes.end(), more.begin(), more.end());
        try {
            return reread(changes);
        } catch (const InputError&) { // a part between knots, a region without a cell
        }
    }
    return std::nullopt;
}

} // namespace

Pilot run_pilot(const Scene& scene, const Reread& reread, double seconds, const std::vector<Override>& more) {
    const auto start = std::chrono::steady_clock::now();
    Pilot pilot;
    const std::optional<Scene> coarse = pilot_scene(scene, reread, more);
    if (!coarse) {
        pilot.trouble = "no coarser grid fits the parts and regions";
        return pilot;
    }
    try {
        Simulation simulation(*coarse, 1);
        const Elasticity elasticity(simulation.model(), simulation.solver().motion(),
                                    coarse->volumetric_strain);
        simulation.start();
        Solver& solver = simulation.solver();
        const auto mark = [&] {
            if (!scene.program_surface) return;
            pilot.marks.push_back({solver.time(),
                                   solver.measure("normal_force", *scene.program_surface).value(),
                                   solver.measure("displacement", *scene.program_surface).value()});
        };
        while (!simulation.done()) {
            const double event = simulation.next_event();
            const bool moved = simulation.step() == Simulation::Moved::yes;
            if (moved && (simulation.done() || solver.time() >= (1.0 - 1e-12) * event)) mark();
            if (std::chrono::steady_clock::now() - start > std::chrono::duration<double>(seconds)) {
                pilot.trouble = fmt::format("a pilot on a coarse grid was stopped after {:g} s", seconds);
                break;
            }
        }
        pilot.points = simulation.points();
        pilot.steps = solver.steps();
        pilot.updates = solver.updates();
        pilot.iterations = solver.iterations();
        pilot.end = solver.time();
        pilot.inelastic_radius = elasticity.largest_inelastic_radius(solver.motion());
    } catch (const InputError& error) {
        pilot.trouble = error.what();
        pilot.wrong = std::current_exception();
    } catch (const std::exception& error) { // that a pilot fails is no reason for the run to
        pilot.trouble = fmt::format("a pilot on a coarse grid failed ({})", error.what());
    }
    return pilot;
}

} // namespace gault::core
