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
constexpr double rounding = 1e-15;   // of strain: stresses over their stiffness are not known better

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

namespace {

bool is_of_stress(const Constraint& c) {
    return std::any_of(c.stress.begin(), c.stress.end(), [](double x) { return x != 0.0; });
}

} // namespace

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

// Newton's method; a correction that does not bring the constraints nearer is halved. At the limit of a soil the
// increments are not unique: the least of them is taken.
bool MixedControl::solve(double share, double dt, Tensor& increment) {
    const auto answers = [&](const Tensor& e, SoilPoint::Answer& answer, Vector6& r) {
        answer = point_.answer(e, dt, true);
        if (answer.failure.status != GAULT_OK) {
            reason_ = answer.failure.status == GAULT_RETRY ? "the soil asks for ever smaller steps"
                                                           : answer.failure.text;
            return false;
        }
        r = misfit(share, e, answer.stress);
        if (!r.allFinite() || !answer.tangent.allFinite()) {
            reason_ = "the soil answered with a stress that is not finite";
            return false;
        }
        return true;
    };
    SoilPoint::Answer answer;
    Vector6 r;
    if (!answers(increment, answer, r)) return false;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        ++iterations_;
        const double length = Eigen::Map<const Vector6>(increment.data()).norm();
        double size = 0.0;
        for (const double s : answer.stress)
            size = std::max(size, std::abs(s));
        if (r.norm() <= precision * length + rounding * (1.0 + size / stiffness_)) return true;
        Vector6 correction =
            Eigen::CompleteOrthogonalDecomposition<Matrix6>(jacobian(answer.tangent)).solve(r);
        const Tensor before = increment;
        const double norm = r.norm();
        bool nearer = false;
        for (int halving = 0; halving < most_halvings && !nearer; ++halving, correction *= 0.5) {
            for (std::size_t k = 0; k < 6; ++k)
                increment[k] = before[k] + correction[static_cast<Eigen::Index>(k)];
            nearer = answers(increment, answer, r) && r.norm() < norm;
        }
        if (!nearer) {
            if (reason_.empty()) reason_ = "no strain brings the stress nearer to what is prescribed";
            return false;
        }
    }
    reason_ = fmt::format("{} iterations were not enough", most_iterations);
    return false;
}

void MixedControl::go_to(double share) {
    double step = share - share_;
    while (share_ < share) {
        step = std::min(step, share - share_);
        const double next = step == share - share_ ? share : share_ + step;
        Tensor increment{};
        if (last_ > 0.0)
            for (std::size_t k = 0; k < 6; ++k)
                increment[k] = increment_[k] * (step / last_);
        reason_.clear();
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
            throw RunError(fmt::format("stage {} ({}), {:.4g} % of it done: no strain meets what is "
                                       "prescribed: {}; a soil at its limit "
                                       "cannot bear more stress: prescribe a strain instead",
                                       stage_.label, stage_.kind, 100.0 * share_, reason_));
    }
}

} // namespace gault::core
