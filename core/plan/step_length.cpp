#include "core/plan/step_length.hpp"
#include "core/plan/pilot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gault::core {
namespace {

constexpr int finer = 4;
constexpr double shortest = 1e-4;

double difference(double a, double b) {
    return b == 0.0 ? 0.0 : std::abs(a / b - 1.0);
}

} // namespace

StepLength longest_step(const Scene& scene, const Reread& reread, double patience) {
    const double usual = SolverSettings().strain_step;
    const auto pilot = [&](double strain_step) {
        return run_pilot(scene, reread, patience, {{"solver.strain_step", fmt::format("{:g}", strain_step)}});
    };
    const Pilot coarse = pilot(usual), fine = pilot(usual / finer);
    if (!coarse.trouble.empty() || !fine.trouble.empty())
        return {usual, "no pilot run asks for shorter ones"};
    // Of first order: what is left beyond the finer one is a third of the difference, and falls with the step.
    const double error =
        4.0 / 3.0 *
        std::max(difference(coarse.force, fine.force), difference(coarse.displacement, fine.displacement));
    if (error <= scene.accuracy)
        return {usual, fmt::format("shorter ones would change a pilot run by {:.2g} %", 100.0 * error)};
    return {std::max(shortest, 0.8 * usual * scene.accuracy / error),
            fmt::format("with {:g} a pilot run is off by {:.2g} %", usual, 100.0 * error)};
}

} // namespace gault::core
