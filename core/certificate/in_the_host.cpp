#include "core/certificate/checks.hpp"
#include "core/laboratory/element_test.hpp"
#include "core/plan/plan.hpp"
#include "core/scheduler/palmer.hpp"
#include "core/scheduler/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gault::core::checks {
namespace {

// A cylinder of it that cannot change its volume, under the mean of its initial stress.
Scene cavity_scene(const Subject& subject) {
    const double pressure = -(subject.stress[0] + subject.stress[1] + subject.stress[2]) / 3.0;
    const Material material(subject.use);
    SoilPoint point(material, {-pressure, -pressure, -pressure, 0.0, 0.0, 0.0});
    const double stiffness = 1e3 * point.answer({}, 0.0, true).tangent.cwiseAbs().maxCoeff();
    const std::vector<Override> soil = {
        {"materials.soil", subject.use.yaml},
        {"initial.stress.isotropic", fmt::format("{} Pa", pressure)},
        {"boundaries.0.value", fmt::format("{} Pa", pressure)},
        {"materials.soil.density", fmt::format("{} kg/m^3", subject.use.density)},
        {"materials.soil.pore_water", fmt::format("{{bulk_modulus: {} Pa, porosity: 1}}", stiffness)}};
    const Reread read = [&](const std::vector<Override>& more) {
        std::vector<Override> all = soil;
        all.insert(all.end(), more.begin(), more.end());
        return read_scene(subject.cavity, all, subject.registry);
    };
    return read(overrides_of(choose_least(read({}), read)));
}

} // namespace

Finding cavity(const Subject& subject) {
    if (Material(subject.use).rate_dependent())
        return left_out("Palmer's integral is for soils that no rate matters to");
    if (subject.cavity.empty()) return left_out("no scene of a cavity");
    const Scene scene = cavity_scene(subject);
    const double from = scene.palmer->from, to = scene.palmer->to;
    const PalmerSolution exact(scene, to);
    Simulation simulation(scene, 1);
    std::size_t x = 0, y = 0;
    for (std::size_t k = 0; k < simulation.columns().size(); ++k) {
        if (simulation.columns()[k].name == scene.palmer->x) x = k;
        if (simulation.columns()[k].name == scene.palmer->y) y = k;
    }
    simulation.start();
    double worst = 0.0;
    while (!simulation.done()) {
        if (simulation.step() == Simulation::Moved::no || !simulation.row_due()) continue;
        const std::vector<double> row = simulation.row();
        if (row[x] < from) continue;
        const double expected = exact.pressure(row[x]);
        worst = std::max(worst, std::abs(row[y] / expected - 1.0));
    }
    return judge(worst <= 5e-3,
                 fmt::format("{:.4g} kPa at {:g} %, off by {:.2g} % at most of the way ({} points, {} steps)",
                             1e-3 * exact.pressure(to), 100.0 * to, 100.0 * worst, simulation.points(),
                             simulation.solver().steps()));
}

Finding speed(const Subject& subject) {
    constexpr std::size_t batch = 512;
    constexpr Tensor increment = {-1e-4, 0.0, 1e-4, 0.0, 0.0, 0.0};
    const auto nanoseconds = [&](const MaterialUse& use) {
        const Material material(use);
        SoilPoint point(material, subject.stress);
        for (int step = 0; step < 100; ++step) // until it yields, if it does
            point.strain(increment, 1.0);
        return 1e9 * seconds_per_update(point, batch).value_or(HUGE_VAL);
    };
    const double own = nanoseconds(subject.use);
    if (!std::isfinite(own)) return left_out("it does not take its last step once more");
    const std::string cost = fmt::format("{:.1f} ns a point in batches of {}", own, batch);
    if (!subject.yardstick) return passed(cost);
    return passed(
        fmt::format("{}, {:.1f} times linear elasticity", cost, own / nanoseconds(*subject.yardstick)));
}

} // namespace gault::core::checks
