#include "core/scheduler/check.hpp"
#include "core/scheduler/cautions.hpp"
#include "core/scheduler/verification.hpp"

#include <fmt/format.h>

#include <utility>

namespace gault::core {

std::vector<std::string> check_scene(const Scene& scene) {
    Simulation simulation(scene, 1);
    Verification verification(scene, simulation.columns());
    const Model& model = simulation.model();
    std::vector<std::string> lines;
    for (const Choice& choice : scene.chosen)
        lines.push_back(fmt::format("{}: {} ({})", choice.key, choice.value, choice.reason));
    for (std::string& caution : cautions(scene))
        lines.push_back(std::move(caution));
    for (std::string& note : notes(simulation))
        lines.push_back(std::move(note));
    lines.insert(lines.end(), model.description.begin(), model.description.end());
    for (std::size_t m = 0; m < model.materials.size(); ++m)
        lines.push_back(
            fmt::format("material {}: {} points", model.materials[m].name(), model.points[m].count()));
    for (std::string& line : simulation.solver().boundaries().description())
        lines.push_back(std::move(line));
    const double dt = simulation.solver().allowed_step();
    if (const double limit = simulation.solver().stability_limit(); limit > 0.0)
        lines.push_back(fmt::format("stable step {:.4g} s, used {:.4g} s", limit, dt));
    return lines;
}

} // namespace gault::core
