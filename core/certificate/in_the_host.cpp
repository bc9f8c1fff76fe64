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

// A cylinder of it that cannot change its volume, under the mean of its initial stress, in steps of this strain.
Scene cavity_scene(const Subject& subject, double strain_step) {
    const double pressure = -(subject.stress[0] + subject.stress[1] + subject.stress[2]) / 3.0;
    const Material material(subject.use);
    SoilPoint point(material, {-pressure, -pressure, -pressure, 0.0, 0.0, 0.0});
    const double skeleton = point.answer({}, 0.0, true).tangent.cwiseAbs().maxCoeff();
    if (!(skeleton > 0.0) || !std::isfinite(skeleton))
        throw RunError("the stiffness at rest is no positive number");
    // So stiff that the skeleton takes no part, and not so that the rounding of strains outweighs the pressure.
    const double water = pressure > 0.0 ? std::min(1e5 * skeleton, 1e8 * pressure) : 1e5 * skeleton;
    const std::vector<Override> soil = {
        {"materials.soil", subject.use.yaml},
        {"initial.stress.isotropic", fmt::format("{} Pa", pressure)},
        {"boundaries.0.value", fmt::format("{} Pa", pressure)},
        {"solver.strain_step", fmt::format("{}", strain_step)},
        {"materials.soil.density", fmt::format("{} kg/m^3", subject.use.density)},
        {"materials.soil.pore_water", fmt::format("{{bulk_modulus: {} Pa, porosity: 1}}", water)}};
    const Reread read = [&](const std::vector<Override>& more) {
        std::vector<Override> all = soil;
        all.insert(all.end(), more.begin(), more.end());
        return read_scene(subject.cavity, all, subject.registry);
    };
    return read(overrides_of(choose_least(read({}), read)));
}

struct Errors { // of the pressure, relative, over cavity strain
    std::vector<double> strain, error;

    double at(double x) const { // linear between two steps
        const auto after = std::clamp(std::upper_bound(strain.begin(), strain.end(), x), strain.begin() + 1,
                                      strain.end() - 1);
        const auto k = static_cast<std::size_t>(after - strain.begin());
        return std::lerp(error[k - 1], error[k], (x - strain[k - 1]) / (strain[k] - strain[k - 1]));
    }
};

Errors errors_of(const Scene& scene, const PalmerSolution& exact) {
    Simulation simulation(scene, 1);
    std::size_t x = 0, y = 0;
    for (std::size_t k = 0; k < simulation.columns().size(); ++k) {
        if (simulation.columns()[k].name == scene.palmer->x) x = k;
        if (simulation.columns()[k].name == scene.palmer->y) y = k;
    }
    simulation.start();
    Errors errors;
    while (!simulation.done()) {
        if (simulation.step() == Simulation::Moved::no || !simulation.row_due()) continue;
        const std::vector<double> row = simulation.row();
        errors.strain.push_back(row[x]);
        errors.error.push_back(row[y] / exact.pressure(row[x]) - 1.0);
        if (!std::isfinite(errors.error.back())) throw RunError("a pressure that is not finite");
    }
    if (errors.strain.size() < 2) throw RunError("the cavity makes fewer than two steps");
    return errors;
}

bool depends_on_cells(const Material& material, const Tensor& stress) {
    if (!material.wants(HostField::characteristic_length)) return false;
    const auto end = [&](double length) {
        SoilPoint point(material, stress, {}, length);
        for (int step = 0; step < 100; ++step)
            point.strain({-5e-4, 0.0, 5e-4, 0.0, 0.0, 0.0}, 1.0);
        return point.stress();
    };
    return end(1e-3) != end(0.1);
}

struct Extrapolated {
    double worst = 0.0, of_steps = 0.0; // error without that of the shorter steps, and that
};

Extrapolated extrapolated(const Errors& coarse, const Errors& fine, double from) {
    Extrapolated e;
    for (std::size_t k = 0; k < coarse.strain.size(); ++k) {
        if (coarse.strain[k] < from) continue;
        const double of_fine = fine.at(coarse.strain[k]), of_steps = coarse.error[k] - of_fine;
        e.worst = std::max(e.worst, std::abs(of_fine - of_steps));
        e.of_steps = std::max(e.of_steps, std::abs(of_steps));
    }
    return e;
}

} // namespace

// Steps are halved until they add little, and the little is extrapolated, of first order: what is left is the soil's,
// or the grid's, which is chosen for 0.1 %.
Finding cavity(const Subject& subject) {
    constexpr double little = 5e-3, right = 2e-3;
    const Material material(subject.use);
    if (material.rate_dependent()) return left_out("Palmer's integral is for soils that no rate matters to");
    if (depends_on_cells(material, subject.stress))
        return left_out("the soil answers differently in cells of another size");
    if (subject.cavity.empty()) return left_out("no scene of a cavity");
    double step = 2e-3;
    const Scene first = cavity_scene(subject, step);
    const double from = first.palmer->from, to = first.palmer->to;
    const PalmerSolution exact(first, to);
    Errors coarse = errors_of(first, exact);
    Extrapolated found{HUGE_VAL, HUGE_VAL};
    for (int halving = 0; halving < 6 && found.of_steps > little; ++halving) {
        step *= 0.5;
        Errors fine = errors_of(cavity_scene(subject, step), exact);
        found = extrapolated(coarse, fine, from);
        coarse = std::move(fine);
    }
    return judge(
        found.worst <= right,
        fmt::format("{:.4g} kPa at {:g} %, off by {:.2g} % at most of the way; steps of {:.2g} % add "
                    "{:.2g} %",
                    1e-3 * exact.pressure(to), 100.0 * to, 100.0 * found.worst, 100.0 * step,
                    100.0 * found.of_steps));
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
