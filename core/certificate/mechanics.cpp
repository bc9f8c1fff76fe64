#include "core/certificate/checks.hpp"
#include "core/certificate/cloud.hpp"
#include "core/laboratory/soil_point.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gault::core::checks {
namespace {

constexpr int row_of[] = {0, 1, 2, 0, 1, 2}, column_of[] = {0, 1, 2, 1, 2, 0};

Eigen::Matrix3d matrix(const Tensor& t) {
    Eigen::Matrix3d m;
    m << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
    return m;
}
Tensor tensor(const Eigen::Matrix3d& m) {
    return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(2, 0)};
}
double largest(const Tensor& t) {
    double most = 0.0;
    for (const double x : t)
        most = std::max(most, std::abs(x));
    return most;
}

// One point of the cloud in a batch of its own, with a random increment that the model answers in one call.
std::optional<PointBatch> answered_one(const PointBatch& cloud, std::size_t point, double low, double high,
                                       Random& random) {
    PointBatch one(cloud.material(), 1);
    one.take(0, cloud, point);
    one.time = cloud.time;
    Tensor increment = random_tensor(random, log_uniform(random, low, high));
    for (int halving = 0; halving < 12; ++halving) {
        one.set_strain(0, increment);
        one.pad();
        if (one.update(1.0).status == GAULT_OK) return one;
        for (double& e : increment)
            e *= 0.5;
    }
    return std::nullopt;
}

// d stress / d strain of the call in hand by central differences; columns as in gault.h.
std::optional<Matrix6> differences(const PointBatch& call, double shift) {
    PointBatch moved = call;
    Matrix6 d;
    const Tensor increment = call.get(call.strain, 0);
    for (std::size_t column = 0; column < 6; ++column) {
        Tensor stress[2];
        for (const int side : {0, 1}) {
            Tensor e = increment;
            e[column] += side ? shift : -shift;
            moved.set_strain(0, e);
            moved.pad();
            if (moved.update(1.0).status != GAULT_OK) return std::nullopt;
            stress[side] = moved.get(moved.stress, 0);
        }
        for (std::size_t row = 0; row < 6; ++row)
            d(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
                (stress[1][row] - stress[0][row]) / (2.0 * shift);
    }
    return d;
}

double at_share(std::vector<double> values, double share) { // a quantile
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

} // namespace

Finding tangent(const Subject& subject) {
    const Material material(subject.use);
    if (!material.has_tangent()) return left_out("declares none: the host takes differences");
    Random random(5);
    const PointBatch cloud = scatter(material, subject.stress, 400, 12, 2e-3, random);
    std::vector<double> errors;
    for (std::size_t i = 0; i < cloud.count(); ++i) {
        std::optional<PointBatch> one = answered_one(cloud, i, 1e-6, 1e-2, random);
        if (!one || one->update(1.0, true).status != GAULT_OK) continue;
        Matrix6 own;
        for (std::size_t k = 0; k < 36; ++k)
            own(static_cast<Eigen::Index>(k / 6), static_cast<Eigen::Index>(k % 6)) = one->tangent[k][0];
        double error = HUGE_VAL; // of two shifts the better: rounding for one, curvature for the other
        for (const double shift : {1e-7, 1e-9})
            if (const auto d = differences(*one, shift))
                error = std::min(error, (own - *d).cwiseAbs().maxCoeff() / one->modulus[0]);
        if (std::isfinite(error) || !own.allFinite()) errors.push_back(error);
    }
    if (errors.empty()) return failed("no point gave both");
    // A step that ends where two branches meet has two tangents: a few points may.
    const double most = at_share(errors, 0.98), half = at_share(errors, 0.5);
    return judge(most <= 1e-5, fmt::format("off by {:.1g} in the median, {:.1g} at 98 % of {} points", half,
                                           most, errors.size()));
}

// A path that bends, of 1 % in all, and a way back of a quarter.
Finding step_size(const Subject& subject) {
    const Material material(subject.use);
    const auto end = [&](int steps) {
        SoilPoint point(material, subject.stress);
        constexpr Tensor a = {-1.0, 0.0, 1.0, 0.0, 0.0, 0.0}, b = {0.0, -0.5, 0.3, 0.6, 0.0, 0.0};
        const auto turn = [&](double share) { // strain at this share of the way
            const double s = std::min(share, 2.0 - share), angle = 0.5 * std::numbers::pi * s;
            Tensor e;
            for (std::size_t k = 0; k < 6; ++k)
                e[k] = 0.01 * (std::sin(angle) * a[k] + (1.0 - std::cos(angle)) * b[k]);
            return e;
        };
        for (int i = 0; i < steps; ++i) {
            Tensor from = turn(1.25 * i / steps), to = turn(1.25 * (i + 1) / steps);
            for (std::size_t k = 0; k < 6; ++k)
                to[k] -= from[k];
            point.strain(to, 1.0 / steps);
        }
        return point.stress();
    };
    const Tensor exact = end(5 * 4096);
    const auto error = [&](int steps) {
        Tensor s = end(steps);
        for (std::size_t k = 0; k < 6; ++k)
            s[k] -= exact[k];
        return largest(s) / largest(exact);
    };
    std::vector<double> errors;
    for (const int steps : {40, 80, 160, 320})
        errors.push_back(error(steps));
    const double order = std::log2(errors.front() / errors.back()) / 3.0;
    const bool exactly = errors.front() < 1e-7;
    return judge(exactly || order >= 0.9, exactly
                                              ? fmt::format("no error: {:.1g} in 40 steps", errors.front())
                                              : fmt::format("{:.1g} in 40 steps, {:.1g} in 320: order {:.2f}",
                                                            errors.front(), errors.back(), order));
}

Finding objectivity(const Subject& subject) {
    const Material material(subject.use);
    Random random(6);
    const PointBatch cloud = scatter(material, subject.stress, 200, 12, 2e-3, random);
    double worst = 0.0;
    int compared = 0;
    for (std::size_t i = 0; i < cloud.count(); ++i) {
        const std::optional<PointBatch> one = answered_one(cloud, i, 1e-6, 3e-3, random);
        if (!one) continue;
        const Eigen::Matrix3d q = Eigen::Quaterniond(uniform(random, -1, 1), uniform(random, -1, 1),
                                                     uniform(random, -1, 1), uniform(random, -1, 1))
                                      .normalized()
                                      .toRotationMatrix();
        const auto rotated = [&](const Tensor& t) { return tensor(q * matrix(t) * q.transpose()); };
        PointBatch turned = *one;
        turned.set(turned.strain, 0, rotated(one->get(one->strain, 0)));
        turned.set(turned.stress_old, 0, rotated(one->get(one->stress_old, 0)));
        const auto turn_states = [&](const std::vector<Column>& from, std::vector<Column>& to) {
            for (const StateInfo& info : material.states()) {
                const auto first = static_cast<std::size_t>(info.first);
                if (info.declared.shape == GAULT_SCALAR) to[first][0] = from[first][0];
                if (info.declared.shape == GAULT_VECTOR) {
                    const Eigen::Vector3d v =
                        q * Eigen::Vector3d(from[first][0], from[first + 1][0], from[first + 2][0]);
                    for (std::size_t k = 0; k < 3; ++k)
                        to[first + k][0] = v[static_cast<Eigen::Index>(k)];
                }
                if (info.declared.shape == GAULT_SYMMETRIC) {
                    Tensor t;
                    for (std::size_t k = 0; k < 6; ++k)
                        t[k] = from[first + k][0];
                    t = rotated(t);
                    for (std::size_t k = 0; k < 6; ++k)
                        to[first + k][0] = t[k];
                }
            }
        };
        turn_states(one->state_old, turned.state_old);
        for (auto [from, to] : {std::pair{&one->F_old, &turned.F_old}, {&one->F_new, &turned.F_new}}) {
            if (!material.finite_strain()) break;
            Eigen::Matrix3d f;
            for (Eigen::Index k = 0; k < 9; ++k)
                f(k / 3, k % 3) = (*from)[static_cast<std::size_t>(k)][0];
            f = q * f * q.transpose();
            for (Eigen::Index k = 0; k < 9; ++k)
                (*to)[static_cast<std::size_t>(k)][0] = f(k / 3, k % 3);
        }
        turned.pad();
        if (turned.update(1.0).status != GAULT_OK) continue; // a step at the edge of what is answered
        ++compared;
        const Tensor expected = rotated(one->get(one->stress, 0));
        Tensor difference = turned.get(turned.stress, 0);
        for (std::size_t k = 0; k < 6; ++k)
            difference[k] -= expected[k];
        worst = std::max(worst, largest(difference) / std::max(largest(expected), 1.0));
        std::vector<Column> state = turned.state;
        turn_states(one->state, state);
        for (std::size_t k = 0; k < state.size(); ++k) {
            const double scale = std::max({std::abs(state[k][0]), std::abs(turned.state_old[k][0]), 1e-3});
            worst = std::max(worst, std::abs(state[k][0] - turned.state[k][0]) / scale);
        }
    }
    if (compared == 0) return failed("no point was answered");
    return judge(worst <= 1e-8,
                 fmt::format("off by {:.1g} at most, {} points and rotations", worst, compared));
}

namespace {

// Work of a square in strain, a then b, over P-wave modulus times the square of the amplitude. Nothing: a side of it
// finds no answer.
std::optional<double> work_around(const PointBatch& cloud, std::size_t point, const Tensor& a,
                                  const Tensor& b) {
    PointBatch one(cloud.material(), 1);
    one.take(0, cloud, point);
    const Tensor start = one.get(one.stress_old, 0);
    double work = 0.0, scale = 0.0;
    for (int side = 0; side < 4; ++side) {
        Tensor e = side % 2 ? b : a;
        for (double& x : e)
            x *= side < 2 ? 1.0 : -1.0;
        one.set_strain(0, e);
        one.pad();
        if (one.update(1e-3).status != GAULT_OK) return std::nullopt;
        for (std::size_t k = 0; k < 6; ++k) { // the constant part does none around a closed path
            work += (k < 3 ? 1.0 : 2.0) * (0.5 * (one.stress[k][0] + one.stress_old[k][0]) - start[k]) * e[k];
            if (side == 0) scale += (k < 3 ? 1.0 : 2.0) * one.modulus[0] * e[k] * e[k];
        }
        one.accept();
    }
    return work / scale;
}

} // namespace

// Where the way round and the way back give the same work but for its sign, the soil is elastic there, and the work is
// to be none. Soil that yields around the cycle says nothing: it may give work back where flow is not associated.
Finding elastic_cycles(const Subject& subject) {
    constexpr double amplitude = 1e-7;
    const Material material(subject.use);
    if (material.rate_dependent()) return left_out("no cycle is elastic where the rate matters");
    Random random(7);
    double most = 0.0;
    int elastic = 0, cycles = 0;
    for (const double strained : {2e-5, 1e-3}) {
        const PointBatch cloud = scatter(material, subject.stress, 200, 12, strained, random);
        for (std::size_t i = 0; i < cloud.count(); ++i) {
            const Tensor a = random_tensor(random, amplitude), b = random_tensor(random, amplitude);
            const std::optional<double> there = work_around(cloud, i, a, b),
                                        back = work_around(cloud, i, b, a);
            if (!there || !back) continue;
            ++cycles;
            if (std::abs(*there + *back) > 1e-5) continue;
            ++elastic;
            most = std::max(most, std::abs(*there));
        }
    }
    if (elastic == 0) return left_out(fmt::format("none of {} cycles is elastic", cycles));
    return judge(most <= 1e-3,
                 fmt::format("work at most {:.1g} of modulus x amplitude^2, {} elastic cycles of {}", most,
                             elastic, cycles));
}

Finding random_walk(const Subject& subject) {
    constexpr std::size_t count = 64;
    constexpr int steps = 15625;
    const Material material(subject.use);
    Random random(8);
    PointBatch batch = scatter(material, subject.stress, count, 0, 0.0, random);
    std::vector<Tensor> total(count);
    std::size_t refused = 0;
    for (int step = 0; step < steps; ++step) {
        for (std::size_t i = 0; i < count; ++i) {
            Tensor e = random_tensor(random, log_uniform(random, 1e-9, 1e-2));
            for (std::size_t k = 0; k < 6; ++k) // so that the soil stays about where it was
                e[k] -= 0.05 * largest(e) / (0.02 + largest(total[i])) * total[i][k];
            batch.set_strain(i, e);
        }
        refused += step_each(batch, 1.0);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t k = 0; k < 6; ++k) {
                total[i][k] += batch.strain[k][i];
                if (!std::isfinite(batch.stress[k][i]))
                    return failed(
                        fmt::format("step {}: a stress that is not finite", step * static_cast<int>(count)));
            }
            for (const StateInfo& info : material.states())
                for (int k = 0; k < static_cast<int>(info.declared.shape); ++k)
                    if (const double x = batch.state[static_cast<std::size_t>(info.first + k)][i];
                        !(x >= info.declared.min && x <= info.declared.max))
                        return failed(fmt::format("step {}: state '{}' is {:.17g}, beyond {:g} to {:g}",
                                                  step * static_cast<int>(count), info.declared.name, x,
                                                  info.declared.min, info.declared.max));
        }
        batch.accept();
        batch.time += 1.0;
    }
    const double share = static_cast<double>(refused) / (static_cast<double>(steps) * count);
    return judge(share < 0.5, fmt::format("{} steps, {:.2g} % without a result in 64 parts", steps * count,
                                          100.0 * share));
}

namespace {

// The largest eigenvalue of n . C . n over random directions n.
double fastest_wave(const Matrix6& d, Random& random) {
    double most = 0.0;
    for (int direction = 0; direction < 60; ++direction) {
        const double z = uniform(random, -1.0, 1.0), angle = uniform(random, 0.0, 2.0 * std::numbers::pi);
        const double n[3] = {std::sqrt(1.0 - z * z) * std::cos(angle),
                             std::sqrt(1.0 - z * z) * std::sin(angle), z};
        Eigen::MatrixXd q = Eigen::MatrixXd::Zero(3, 3);
        for (int a = 0; a < 6; ++a)
            for (int b = 0; b < 6; ++b) {
                const double c = d(a, b) * (b < 3 ? 1.0 : 0.5); // C_ijkl
                for (int left = 0; left < (a < 3 ? 1 : 2); ++left)
                    for (int right = 0; right < (b < 3 ? 1 : 2); ++right) {
                        const int i = left ? column_of[a] : row_of[a], j = left ? row_of[a] : column_of[a];
                        const int k = right ? column_of[b] : row_of[b], l = right ? row_of[b] : column_of[b];
                        q(i, k) += n[j] * c * n[l];
                    }
            }
        most = std::max(most, Eigen::EigenSolver<Eigen::MatrixXd>(q, false).eigenvalues().real().maxCoeff());
    }
    return most;
}

// Half as much again of the increment, and all of it taken back: is the point where it was?
bool is_elastic(const PointBatch& call) {
    PointBatch there = call;
    const Tensor start = call.get(call.stress_old, 0);
    const auto step = [&](double factor) {
        Tensor e = call.get(call.strain, 0);
        for (double& x : e)
            x *= factor;
        there.set_strain(0, e);
        there.pad();
        const bool answered = there.update(1.0).status == GAULT_OK;
        there.accept();
        return answered;
    };
    if (!step(1.5)) return false;
    Tensor change = there.get(there.stress, 0);
    if (!step(-1.5)) return false;
    Tensor rest = there.get(there.stress, 0);
    for (std::size_t k = 0; k < 6; ++k) {
        rest[k] -= start[k];
        change[k] -= start[k];
    }
    return largest(rest) <= 1e-7 * largest(change) + 1e-13 * largest(start);
}

} // namespace

// Elastic waves are bounded strictly. While soil yields, flow that is not associated may make one faster, which the
// host's step, at most 0.9 of the stable one, bears up to 1 / 0.9^2.
Finding modulus(const Subject& subject) {
    constexpr double borne = 1.0 / (0.9 * 0.9);
    const Material material(subject.use);
    Random random(9);
    double most[2] = {0.0, 0.0};
    int points[2] = {0, 0};
    for (const double strained : {2e-5, 2e-3}) {
        const PointBatch cloud = scatter(material, subject.stress, 150, 12, strained, random);
        for (std::size_t i = 0; i < cloud.count(); ++i) {
            const std::optional<PointBatch> one = answered_one(cloud, i, 1e-7, strained, random);
            if (!one) continue;
            const double bound = one->modulus[0], shear = one->shear_modulus[0];
            if (!(bound > 0.0) || !std::isfinite(bound) || !(shear >= 0.0) || !std::isfinite(shear))
                return failed(
                    fmt::format("reports a modulus of {:g} Pa and a shear modulus of {:g} Pa", bound, shear));
            const std::optional<Matrix6> d = differences(*one, 1e-8), closer = differences(*one, 5e-9);
            // Not where differences reach from one branch into another.
            if (!d || !closer || (*d - *closer).cwiseAbs().maxCoeff() > 1e-3 * bound) continue;
            const int kind = is_elastic(*one) ? 0 : 1;
            ++points[kind];
            most[kind] = std::max(most[kind], fastest_wave(*d, random) / bound);
        }
    }
    if (points[0] + points[1] == 0) return failed("no point was answered");
    return judge(
        most[0] <= 1.0 + 1e-4 && most[1] <= borne,
        fmt::format("of it, the fastest wave needs {:.5f} in {} elastic points, {:.3f} in {} that yield",
                    most[0], points[0], most[1], points[1]));
}

} // namespace gault::core::checks
