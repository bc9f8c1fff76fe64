#include "core/plan/step_length.hpp"
#include "core/plan/pilot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace gault::core {
namespace {

constexpr int finer = 4;
constexpr double shortest = 1e-4;

using Mark = Pilot::Mark;

// The marks of both pilots at the same moments, and their ends. When a phase ends that waits for a pressure depends on
// the steps.
std::vector<std::pair<Mark, Mark>> common(const Pilot& a, const Pilot& b) {
    std::vector<std::pair<Mark, Mark>> pairs;
    const double same = 1e-9 * std::max(a.end, b.end);
    for (std::size_t i = 0, j = 0; i < a.marks.size() && j < b.marks.size();) {
        const double apart = a.marks[i].time - b.marks[j].time;
        if (std::abs(apart) <= same) pairs.emplace_back(a.marks[i], b.marks[j]);
        if (apart <= same) ++i;
        if (apart >= -same) ++j;
    }
    if (a.trouble.empty() && b.trouble.empty() && !a.marks.empty() && !b.marks.empty())
        pairs.emplace_back(a.marks.back(), b.marks.back());
    return pairs;
}

// The largest relative difference; of what is below a tenth of the largest, in that tenth: near zero nothing is relative.
double difference(const std::vector<std::pair<Mark, Mark>>& pairs, double Mark::*value) {
    double largest = 0.0, most = 0.0;
    for (const auto& [a, b] : pairs)
        largest = std::max(largest, std::abs(b.*value));
    for (const auto& [a, b] : pairs)
        if (largest > 0.0)
            most =
                std::max(most, std::abs(a.*value - b.*value) / std::max(std::abs(b.*value), 0.1 * largest));
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
    const auto pairs = common(coarse, fine);
    if (pairs.empty())
        return {usual, trouble.empty() ? "there is no surface whose pilot runs could be compared"
                                       : "not known to be short enough: " + trouble};
    // Of first order: what is left beyond the finer one is a third of the difference, and falls with the step.
    const double error =
        4.0 / 3.0 * std::max(difference(pairs, &Mark::force), difference(pairs, &Mark::displacement));
    const std::string so_far =
        trouble.empty() ? ""
                        : fmt::format(" until {:.4g} s; no further: {}", pairs.back().second.time, trouble);
    if (error <= scene.accuracy)
        return {usual,
                fmt::format("shorter ones would change a pilot run by {:.2g} %{}", 100.0 * error, so_far)};
    return {std::max(shortest, 0.8 * usual * scene.accuracy / error),
            fmt::format("with {:g} a pilot run is off by {:.2g} %{}", usual, 100.0 * error, so_far)};
}

} // namespace gault::core
