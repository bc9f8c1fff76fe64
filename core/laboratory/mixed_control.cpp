#include "core/laboratory/mixed_control.hpp"

#include <Eigen/QR>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gault::core {
namespace {

constexpr int most_iterations = 30, most_halvings = 8;
constexpr double least_share = 1e-9; // of a stage
constexpr double precision = 1e-9;   // of the increment; what a difference tangent can still reach
constexpr double rounding = 1e-15;   // of strains, and of stresses over their stiffness
constexpr double longest = 1.0;      // increment: what is longer runs away

double largest(const Tensor& t) {
    double most = 0.0;
    for (const double x : t)
        most = std::max(most, std::abs(x));
    return most;
}
double norm(const Tensor& t) {
    double sum = 0.0;
    for (const double x : t)
        sum += x * x;
    return std::sqrt(sum);
}

bool is_of_stress(const Constraint& c) {
    return largest(c.stress) > 0.0;
}

} // namespace

MixedControl::MixedControl(SoilPoint& point, const ElementStage& stage)
    : point_(point), stage_(stage), begin_(point.strain()) {
    const SoilPoint::Answer elastic = point_.answer({}, 0.0, true);
    if (elastic.failure.status != GAULT_OK)
        throw RunError(fmt::format("material '{}': {}", point_.material().name(), elastic.failure.text));
    stiffness_ = elastic.tangent.cwiseAbs().maxCoeff();
    if (!(stiffness_ > 0.0) || !std::isfinite(stiffness_))
        throw RunError(fmt::format("material '{}' has no stiffness here", point_.material().name()));
    for (std::size_t k = 0; k < 6; ++k)
        start_[k] = value(stage.constraints[k], begin_, point.stress());
}

double MixedControl::value(const Constraint& c, const Tensor& strain, const Tensor& stress) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < 6; ++k)
        sum += c.strain[k] * (strain[k] - begin_[k]) + c.stress[k] * stress[k];
    return sum;
}

bool MixedControl::prescribes_stress() const {
    for (std::size_t k = 0; k < 6; ++k) {
        const Constraint& c = stage_.constraints[k];
        if (is_of_stress(c) && c.end && *c.end != start_[k]) return true;
    }
    return false;
}

MixedControl::Vector6 MixedControl::misfit(double share, const Tensor& increment,
                                           const Tensor& stress) const {
    Tensor strain = point_.strain();
    for (std::size_t k = 0; k < 6; ++k)
        strain[k] += increment[k];
    Vector6 r;
    for (std::size_t k = 0; k < 6; ++k) {
        const Constraint& c = stage_.constraints[k];
        const double wanted = start_[k] + share * (c.end.value_or(start_[k]) - start_[k]);
        r[static_cast<Eigen::Index>(k)] =
            (wanted - value(c, strain, stress)) / (is_of_stress(c) ? stiffness_ : 1.0);
    }
    return r;
}

Matrix6 MixedControl::jacobian(const Matrix6& tangent) const {
    Matrix6 j;
    for (Eigen::Index row = 0; row < 6; ++row) {
        const Constraint& c = stage_.constraints[static_cast<std::size_t>(row)];
        const Eigen::Map<const Vector6> strain(c.strain.data()), stress(c.stress.data());
        j.row(row) = strain.transpose() + stress.transpose() * tangent;
        if (is_of_stress(c)) j.row(row) /= stiffness_;
    }
    return j;
}

// False, and the reason: the soil has no answer.
bool MixedControl::ask(double share, double dt, const Tensor& increment, Trial& trial) {
    const std::string& name = point_.material().name();
    if (norm(increment) > longest) {
        reason_ = "the strain grows without bound";
        return false;
    }
    trial.answer = point_.answer(increment, dt, true);
    const UpdateFailure& failure = trial.answer.failure;
    if (failure.status != GAULT_OK) {
        reason_ = failure.status == GAULT_RETRY
                      ? fmt::format("material '{}' asks for ever smaller steps", name)
                      : fmt::format("material '{}': {}", name, failure.text);
        return false;
    }
    trial.misfit = misfit(share, increment, trial.answer.stress);
    if (!trial.misfit.allFinite() || !trial.answer.tangent.allFinite()) {
        reason_ = fmt::format("material '{}' answered with a number that is not finite", name);
        return false;
    }
    reason_.clear();
    return true;
}

bool MixedControl::is_met(const Tensor& increment, const Trial& trial) const {
    const double size = 1.0 + largest(point_.strain()) + largest(trial.answer.stress) / stiffness_;
    return trial.misfit.norm() <= precision * norm(increment) + rounding * size;
}

// Newton's method; a correction that does not bring the constraints nearer is halved. At the limit of a soil the
// increments are not unique: the least correction is taken.
bool MixedControl::solve(double share, double dt, Tensor& increment) {
    Trial trial;
    if (!ask(share, dt, increment, trial)) return false;
    for (int iteration = 0; !is_met(increment, trial); ++iteration) {
        if (iteration == most_iterations) {
            reason_ = fmt::format("{} iterations did not find the strain", most_iterations);
            return false;
        }
        ++iterations_;
        Vector6 correction = Eigen::CompleteOrthogonalDecomposition<Matrix6>(jacobian(trial.answer.tangent))
                                 .solve(trial.misfit);
        const Tensor before = increment;
        const double far = trial.misfit.norm();
        bool nearer = false;
        for (int halving = 0; halving < most_halvings && !nearer; ++halving, correction *= 0.5) {
            for (std::size_t k = 0; k < 6; ++k)
                increment[k] = before[k] + correction[static_cast<Eigen::Index>(k)];
            nearer = ask(share, dt, increment, trial) && trial.misfit.norm() < far;
        }
        if (!nearer) {
            if (reason_.empty()) reason_ = "no strain gives the stress that is prescribed";
            return false;
        }
    }
    return true;
}

void MixedControl::go_to(double share) {
    double step = share - share_;
    while (share_ < share) {
        step = std::min(step, share - share_);
        const double next = step == share - share_ ? share : share_ + step;
        Tensor increment{};
        for (std::size_t k = 0; k < 6 && last_ > 0.0; ++k)
            increment[k] = increment_[k] * (step / last_);
        bool made = solve(next, step * stage_.duration, increment);
        if (!made && last_ > 0.0) made = solve(next, step * stage_.duration, increment = {}); // from rest
        if (made) {
            point_.accept();
            increment_ = increment;
            last_ = step;
            share_ = next;
            step *= 2.0;
            continue;
        }
        step *= 0.5;
        if (step < least_share)
            throw RunError(fmt::format(
                "stage {} ({}), {:.4g} % done: {}{}", stage_.label, stage_.kind, 100.0 * share_, reason_,
                prescribes_stress() ? "; a soil at its limit bears no more stress: prescribe a strain instead"
                                    : ""));
    }
}

} // namespace gault::core
