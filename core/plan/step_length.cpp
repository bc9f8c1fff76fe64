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

// The largest difference at the marks that both came to.
double difference(const Pilot& a, const Pilot& b) {
    double most = 0.0;
    for (std::size_t k = 0; k < std::min(a.marks.size(), b.marks.size()); ++k)
        most = std::max({most, difference(a.marks[k].force, b.marks[k].force),
                         difference(a.marks[k].displacement, b.marks[k].displacement)});
    return most;
}

} // namespace

StepLength longest_step(const Scene& scene, const Reread& reread, double patience) {
    const double usual = SolverSettings().strain_step;
    const auto pilot = [&](double strain_step) {
        return run_pilot(scene, reread, patience, {{"solver.strain_step", fmt::format("{:g}", strain_step)}});
    };
    const Pilot coarse = pilot(usual), fine = pilot(usual / finer);
    const std::string& trouble = coarse.trouble.empty() ? fine.trouble : coarse.trouble;
    if (coarse.marks.empty() || fine.marks.empty())
        return {usual, trouble.empty() ? "there is no surface whose pilot runs could be compared"
                                       : "not known to be short enough: " + trouble};
    // Of first order: what is left beyond the finer one is a third of the difference, and falls with the step.
    const double error = 4.0 / 3.0 * difference(coarse, fine);
    const std::string so_far = trouble.empty() ? "" : "; no further: " + trouble;
    if (error <= scene.accuracy)
        return {usual,
                fmt::format("shorter ones would change a pilot run by {:.2g} %{}", 100.0 * error, so_far)};
    return {std::max(shortest, 0.8 * usual * scene.accuracy / error),
            fmt::format("with {:g} a pilot run is off by {:.2g} %{}", usual, 100.0 * error, so_far)};
}

} // namespace gault::core
