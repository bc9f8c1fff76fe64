#include "core/scheduler/check.hpp"
#include "core/scheduler/cautions.hpp"
#include "core/scheduler/verification.hpp"

#include <fmt/format.h>

#include <numbers>

#include <utility>

namespace gault::core {

namespace {

std::string value_text(const gault_parameter& p, const gault_value& value) {
    if (p.type == GAULT_CHOICE || p.type == GAULT_TEXT_VALUE) return value.text;
    if (p.type != GAULT_REAL) return fmt::format("{}", value.integer);
    const std::string unit = p.unit;
    if (unit == "rad") return fmt::format("{:.6g} deg", value.real * 180.0 / std::numbers::pi);
    return unit == "1" ? fmt::format("{:.6g}", value.real) : fmt::format("{:.6g} {}", value.real, unit);
}

// The model and its parameters as they were understood: "NAME 1.0.0 (FILE): young_modulus 1e+08 Pa, ...".
std::string as_taken(const ComponentUse& use) {
    const gault_component& c = *use.component->declaration;
    std::string text = fmt::format("{} {} ({})", c.name, c.version, use.component->file.string());
    const char* between = ": ";
    for (std::size_t i = 0; i < use.parameters.values.size(); ++i) {
        const gault_parameter& p = *c.parameters[i];
        if (use.parameters.values[i].count == 0 || p.type > GAULT_TEXT_VALUE) continue;
        text += fmt::format("{}{} {}", between, p.name, value_text(p, use.parameters.values[i]));
        between = ", ";
    }
    return text;
}

} // namespace

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
            fmt::format("material {}: {} points, {}", model.materials[m].name(), model.points[m].count(),
                        as_taken(scene.materials[m].model)));
    for (std::string& line : simulation.solver().boundaries().description())
        lines.push_back(std::move(line));
    const double dt = simulation.solver().allowed_step();
    if (const double limit = simulation.solver().stability_limit(); limit > 0.0)
        lines.push_back(fmt::format("stable step {:.4g} s, used {:.4g} s", limit, dt));
    return lines;
}

} // namespace gault::core
