#include "core/solver/quasi_static.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gault::core {
namespace {

constexpr int most_iterations = 20, most_halvings = 5;
constexpr double shortest = 1e-9;     // step, over the longest tried
constexpr double growth = 10.0;       // of a step over the one before
constexpr double least_change = 1e-3; // of forces in a step that counts, over all forces
constexpr double least_forces =
    1e-3; // that count, over the largest in the steps before: below is their rounding

} // namespace

QuasiStaticSolver::QuasiStaticSolver(const Scene& scene, Model& model, int threads)
    : Solver(scene, model, threads), equilibrium_(model, *motion_, scene.volumetric_strain),
      stiffness_(model.grid), du_(model.grid.layout()), du_before_(du_), correction_(du_),
      wanted_(du_), before_{internal_, traction_, fixed_, {}, {}}, still_(du_),
      rate_dependent_(std::any_of(model.materials.begin(), model.materials.end(),
                                  [](const Material& m) { return m.rate_dependent(); })),
      allowed_(std::numeric_limits<double>::infinity()) {}

template <class F>
void QuasiStaticSolver::each_component(F f) const {
    const NodeLayout& layout = model_.grid.layout();
    for (int j = 0; j < layout.ny; ++j)
        for (int i = 0; i < layout.nx; ++i)
            for (int k = 0; k < 2; ++k)
                f(stiffness_.row(i, j, k), k, layout.index(i, j));
}

bool QuasiStaticSolver::step(double dt) {
    if (!std::isfinite(dt))
        throw RunError(
            "the program names no time for its next event, and a quasi-static step has no other length");
    load_first();
    least_ = std::max(least_, shortest * dt);
    if (std::isfinite(allowed_)) usual_ = std::max(usual_, allowed_);
    start_ = motion_->save();
    before_ = {internal_, traction_, fixed_, boundaries_.loads(), energies_};
    boundaries_.constrain(*motion_, time_ + dt, dt, fixed_, value_);
    const double ratio = dt_before_ > 0.0 ? dt / dt_before_ : 0.0; // as the last step went on
    each_component([&](Eigen::Index, int k, std::size_t n) {
        wanted_.c[k][n] = dt * value_.c[k][n];
        du_.c[k][n] = ratio * du_before_.c[k][n];
    });
    time_ += dt;
    const Outcome outcome = iterate({time_, dt});
    const double share = outcome == Outcome::balanced ? even_share(ratio) : 1.0;
    if (share < 0.4) {
        time_ -= dt;
        reason_ = "the soil creeps ever faster";
        return shorten(std::max(share, 0.1), dt);
    }
    if (outcome != Outcome::balanced) {
        time_ -= dt;
        return shorten(outcome == Outcome::strained
                           ? std::clamp(settings_.strain_step / largest_strain_, 1e-6, 0.5)
                           : fraction_,
                       dt);
    }
    each_component([&](Eigen::Index, int k, std::size_t n) { velocity_.c[k][n] = du_.c[k][n] / dt; });
    largest_forces_ = std::max(largest_forces_, unbalanced().forces);
    motion_->arrive(du_, dt);
    account(dt);
    du_before_ = du_;
    dt_before_ = dt;
    way_before_ += way_;
    const double wanted_share = settings_.strain_step / largest_strain_;
    // An event that cut a step short says nothing about the next one.
    allowed_ = std::min(dt * std::min(std::max(wanted_share, 0.5), share), std::max(growth * dt, usual_));
    usual_ = 0.0;
    ++steps_;
    return true;
}

// The length, over that of the step, with which the motion goes on evenly enough for a soil that heeds the rate: the
// step before it, gone on with, misses this one by an amount that falls with the square of the length.
double QuasiStaticSolver::even_share(double ratio) {
    if (!rate_dependent_) return HUGE_VAL;
    double missed = 0.0, way = 0.0;
    each_component([&](Eigen::Index, int k, std::size_t n) {
        missed = std::max(missed, std::abs(du_.c[k][n] - ratio * du_before_.c[k][n]));
        way = std::max(way, std::abs(du_.c[k][n]));
    });
    way_ = way;
    if (dt_before_ == 0.0 || missed == 0.0) return HUGE_VAL;
    return 0.9 * std::sqrt(settings_.uneven * (way_before_ + way) / (0.5 * missed));
}

bool QuasiStaticSolver::shorten(double fraction, double dt) {
    restore();
    allowed_ = fraction * dt;
    usual_ = 0.0;
    if (allowed_ < least_ && failed_) throw PointError(*failed_);
    if (allowed_ < least_)
        throw RunError(
            fmt::format("no equilibrium was found, however short the step{}; the load may exceed what the "
                        "soil can carry: end the program before, or drive the wall instead of the pressure",
                        reason_.empty() ? "" : " (" + reason_ + ")"));
    return false;
}

void QuasiStaticSolver::restore() {
    motion_->restore(*start_);
    internal_ = before_.internal;
    traction_ = before_.traction;
    fixed_ = before_.fixed;
    boundaries_.restore(before_.loads);
    energies_ = before_.energies;
}

void QuasiStaticSolver::undo(double fraction) {
    restore();
    time_ -= dt_before_;
    way_before_ -= way_;
    usual_ = dt_before_;
    allowed_ = fraction * dt_before_;
    --steps_;
}

QuasiStaticSolver::Outcome QuasiStaticSolver::evaluate(const Moment& moment) {
    // Before anything is known of the length of a step, it may be far too long: look, do not stop.
    const double limit = steps_ == 0 && iterations_ == 0 ? HUGE_VAL : 4.0 * settings_.strain_step;
    const Equilibrium::Answer answer =
        equilibrium_.evaluate(*start_, du_, moment, limit, internal_, stiffness_);
    largest_strain_ = answer.largest_strain;
    failed_ = answer.failed;
    if (!answer.found) {
        fraction_ = answer.fraction;
        reason_ = answer.reason;
        return answer.reason.empty() && answer.largest_strain > limit ? Outcome::strained : Outcome::diverged;
    }
    fraction_ = 0.25; // unless something else fails after this
    reason_ = "Newton's method did not converge";
    motion_->attempt(*start_, du_);
    boundaries_.load(*motion_, moment.time, moment.dt, still_, traction_, &stiffness_);
    return Outcome::balanced;
}

// Against the change: where the boundary is far away or the stress high, all forces dwarf those of a loop.
QuasiStaticSolver::Imbalance QuasiStaticSolver::unbalanced() const {
    double free = 0.0, all = 0.0, change = 0.0, left = 0.0, way = 0.0;
    each_component([&](Eigen::Index, int k, std::size_t n) {
        const double own = weight(k, n), force = internal_.c[k][n] + traction_.c[k][n] + own;
        all += internal_.c[k][n] * internal_.c[k][n] + traction_.c[k][n] * traction_.c[k][n] + own * own;
        change += std::pow(internal_.c[k][n] - before_.internal.c[k][n], 2) +
                  std::pow(traction_.c[k][n] - before_.traction.c[k][n], 2);
        way += wanted_.c[k][n] * wanted_.c[k][n] + du_.c[k][n] * du_.c[k][n];
        if (fixed_.c[k][n] == 0.0)
            free += force * force;
        else
            left += std::pow(wanted_.c[k][n] - du_.c[k][n], 2);
    });
    if (!std::isfinite(all + free + way + left)) return {HUGE_VAL, HUGE_VAL, 0.0};
    const double forces = std::max(std::sqrt(all), least_forces * largest_forces_);
    const double moved = std::max(std::sqrt(change), least_change * forces);
    const double missed = left > 0.0 ? std::sqrt(left / way) : 0.0;
    return {std::max(forces > 0.0 ? std::sqrt(free) / forces : 0.0, missed),
            std::max(moved > 0.0 ? std::sqrt(free) / moved : 0.0, missed), forces};
}

QuasiStaticSolver::Outcome QuasiStaticSolver::iterate(const Moment& moment) {
    Outcome outcome = evaluate(moment);
    if (outcome != Outcome::balanced) return outcome;
    Imbalance error = unbalanced();
    residuals_ = {error.of_all};
    for (int n = 0; n < most_iterations && error.of_change > settings_.tolerance; ++n) {
        const bool enough = error.of_all <= settings_.tolerance; // if rounding lets it come no nearer
        if (!correct()) return enough ? Outcome::balanced : Outcome::diverged;
        ++iterations_;
        const double before = error.of_all;
        const VectorField from = du_;
        double share = 1.0;
        for (int halving = 0;; ++halving, share *= 0.5) {
            for (int k = 0; k < 2; ++k)
                for (std::size_t q = 0; q < du_.c[k].size(); ++q)
                    du_.c[k][q] = from.c[k][q] + share * correction_.c[k][q];
            outcome = evaluate(moment);
            error = outcome == Outcome::balanced ? unbalanced() : Imbalance{HUGE_VAL, HUGE_VAL, 0.0};
            if (outcome == Outcome::balanced &&
                (n == 0 || error.of_all < before || error.of_change <= settings_.tolerance))
                break;
            if (enough) {
                du_ = from;
                return evaluate(moment);
            }
            // A first correction that strains too much says that the step is too long.
            if (halving == most_halvings || (n == 0 && outcome == Outcome::strained))
                return outcome == Outcome::balanced ? Outcome::diverged : outcome;
        }
        residuals_.push_back(error.of_all);
        if (steps_ == 0 && n == 0 && largest_strain_ > settings_.strain_step) return Outcome::strained;
    }
    return std::min(error.of_change, error.of_all) <= settings_.tolerance ? Outcome::balanced
                                                                          : Outcome::diverged;
}

// One Newton correction; false where there is none. Fixed components go where they are wanted; what nothing
// supports stays.
bool QuasiStaticSolver::correct() {
    Stiffness::Matrix& matrix = stiffness_.matrix();
    Eigen::VectorXd right(stiffness_.size());
    std::vector<char> held(static_cast<std::size_t>(stiffness_.size()));
    double scale = 0.0;
    each_component([&](Eigen::Index row, int k, std::size_t n) {
        const double diagonal = matrix.coeff(row, row);
        scale = std::max(scale, std::abs(diagonal));
        held[static_cast<std::size_t>(row)] = fixed_.c[k][n] != 0.0 || diagonal == 0.0;
    });
    for (Eigen::Index column = 0; column < matrix.outerSize(); ++column)
        for (Stiffness::Matrix::InnerIterator entry(matrix, column); entry; ++entry)
            if (held[static_cast<std::size_t>(entry.row())])
                entry.valueRef() = entry.row() == column ? scale : 0.0;
    each_component([&](Eigen::Index row, int k, std::size_t n) {
        const bool fixed = fixed_.c[k][n] != 0.0;
        right[row] = fixed ? scale * (wanted_.c[k][n] - du_.c[k][n])
                     : held[static_cast<std::size_t>(row)]
                         ? 0.0
                         : internal_.c[k][n] + traction_.c[k][n] + weight(k, n);
    });
    if (!analysed_) factors_.analyzePattern(matrix);
    analysed_ = true;
    factors_.factorize(matrix);
    const int status = factors_.umfpackFactorizeReturncode();
    if (status != UMFPACK_OK && status != UMFPACK_WARNING_singular_matrix)
        throw RunError(fmt::format("the stiffness matrix was not factorised: UMFPACK status {}", status));
    Eigen::VectorXd solution = Eigen::VectorXd::Constant(right.size(), std::nan(""));
    if (status == UMFPACK_OK) solution = factors_.solve(right); // writes nothing where it fails
    each_component([&](Eigen::Index row, int k, std::size_t n) { correction_.c[k][n] = solution[row]; });
    if (!solution.allFinite()) reason_ = "the stiffness matrix is singular";
    return solution.allFinite();
}

void QuasiStaticSolver::account(double) {
    each_component([&](Eigen::Index, int k, std::size_t n) {
        const double way = du_.c[k][n], inner = 0.5 * (before_.internal.c[k][n] + internal_.c[k][n]);
        // In balance at both ends of the step: what holds a component is the rest.
        const auto outer = [&](const FixedField& fixed, const VectorField& loads, const VectorField& forces) {
            return fixed.c[k][n] == 0.0 ? loads.c[k][n] + weight(k, n) : -forces.c[k][n];
        };
        energies_.internal -= inner * way;
        energies_.straining -= inner * way;
        energies_.external +=
            0.5 * way *
            (outer(before_.fixed, before_.traction, before_.internal) + outer(fixed_, traction_, internal_));
    });
}

} // namespace gault::core
