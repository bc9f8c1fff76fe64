#include "core/certificate/checks.hpp"
#include "core/certificate/rotation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

namespace gault::core::checks {
namespace {

constexpr std::size_t points = 200;
constexpr double rounding = 1e-6; // of the stress, and of what an iteration leaves

struct Deviation {
    double stress = 0.0;                         // largest, of the stresses that take part
    std::vector<std::vector<double>> difference; // of every state, a point each
    std::vector<double> scale;                   // of every state
    int answered = 0, compared = 0;              // points; where the rotated step is answered as well

    // At 98 % of the points: a state that counts may be another where rounding decides between two branches.
    double of_state(std::size_t k) const {
        std::vector<double> all = difference[k];
        if (all.empty()) return 0.0;
        std::sort(all.begin(), all.end());
        return all[(98 * (all.size() - 1)) / 100] / scale[k];
    }
    double worst() const {
        double most = stress;
        for (std::size_t k = 0; k < difference.size(); ++k)
            most = std::max(most, of_state(k));
        return most;
    }
    bool none() const { return worst() <= rounding; }
    // "0.4", or "0.4 (state 'fabric')" where the stress is right.
    std::string text(const Material& material) const {
        for (std::size_t k = 0; k < difference.size() && stress <= rounding; ++k)
            if (of_state(k) > rounding && of_state(k) == worst())
                return fmt::format("{:.1g} (state '{}')", worst(), material.states()[k].declared.name);
        return fmt::format("{:.1g}", worst());
    }
};

void turn_gradient(const Eigen::Matrix3d& left, const Eigen::Matrix3d& right,
                   const std::array<Column, 9>& from, std::array<Column, 9>& to) {
    Eigen::Matrix3d f;
    for (Eigen::Index k = 0; k < 9; ++k)
        f(k / 3, k % 3) = from[static_cast<std::size_t>(k)][0];
    f = (left * f * right.transpose()).eval();
    for (Eigen::Index k = 0; k < 9; ++k)
        to[static_cast<std::size_t>(k)][0] = f(k / 3, k % 3);
}

// The call with all that it starts from rotated, in which the soil is not told from another direction.
PointBatch seen_from_elsewhere(const PointBatch& call, const Eigen::Matrix3d& q) {
    PointBatch turned = call;
    turned.set(turned.strain, 0, rotated(q, call.get(call.strain, 0)));
    turned.set(turned.stress_old, 0, rotated(q, call.get(call.stress_old, 0)));
    rotate_states(call.material(), q, call.state_old, turned.state_old);
    if (call.material().finite_strain()) {
        turn_gradient(q, q, call.F_old, turned.F_old);
        turn_gradient(q, q, call.F_new, turned.F_new);
    }
    turned.pad();
    return turned;
}

// Where the soil is given F: the call that ends with a rotation of the body.
PointBatch turned_at_the_end(const PointBatch& call, const Eigen::Matrix3d& q) {
    PointBatch turned = call;
    turned.set(turned.strain, 0, rotated(q, call.get(call.strain, 0)));
    turn_gradient(q, Eigen::Matrix3d::Identity(), call.F_new, turned.F_new);
    turned.pad();
    return turned;
}

void compare(const PointBatch& call, const PointBatch& turned, const Eigen::Matrix3d& q, bool scalars_alone,
             Deviation& found) {
    const Tensor expected = rotated(q, call.get(call.stress, 0));
    Tensor difference = turned.get(turned.stress, 0);
    for (std::size_t k = 0; k < 6; ++k)
        difference[k] -= expected[k];
    const double taking_part =
        std::max({largest(expected), largest(call.get(call.stress_old, 0)),
                  std::abs(call.modulus[0]) * largest(call.get(call.strain, 0)), 1e-300});
    found.stress = std::max(found.stress, largest(difference) / taking_part);
    if (!std::isfinite(found.stress)) found.stress = HUGE_VAL;
    std::vector<Column> state = turned.state;
    rotate_states(call.material(), q, call.state, state);
    for (std::size_t i = 0; i < call.material().states().size(); ++i) {
        const StateInfo& info = call.material().states()[i];
        if (scalars_alone && info.declared.shape != GAULT_SCALAR) continue;
        const double least = std::strcmp(info.declared.unit, "Pa") == 0 ? taking_part : 1e-6;
        double most = 0.0;
        for (std::size_t k = 0; k < info.declared.shape; ++k) {
            const double a = state[static_cast<std::size_t>(info.first) + k][0],
                         b = turned.state[static_cast<std::size_t>(info.first) + k][0];
            most = std::max(most, std::abs(a - b));
            found.scale[i] = std::max({found.scale[i], std::abs(a), std::abs(b), least});
        }
        found.difference[i].push_back(most);
    }
}

using Rotation = std::function<Eigen::Matrix3d(Random&)>;
using Turn = PointBatch (*)(const PointBatch&, const Eigen::Matrix3d&);

Deviation deviation(const Subject& subject, const Material& material, const Rotation& rotation, Turn turn) {
    Random random(6);
    const PointBatch cloud =
        scatter(material, subject.stress, points, 12, strain_to_yield(material, subject.stress).size, random);
    Deviation found;
    found.difference.resize(material.states().size());
    found.scale.resize(material.states().size());
    for (std::size_t i = 0; i < cloud.count(); ++i) {
        const std::optional<PointBatch> one = answered_one(cloud, i, 1e-6, 3e-3, random);
        if (!one) continue;
        ++found.answered;
        const Eigen::Matrix3d q = rotation(random);
        PointBatch turned = turn(*one, q);
        if (turned.update(1.0).status != GAULT_OK) continue; // a step at the edge of what is answered
        ++found.compared;
        compare(*one, turned, q, turn == turned_at_the_end, found);
    }
    return found;
}

} // namespace

// What no rotation changes is isotropic. A soil with a fixed axis is another one once it turns; along y, the vertical,
// it has its uses, and no verdict.
Finding objectivity(const Subject& subject) {
    const Material material(subject.use);
    const Deviation any = deviation(subject, material, random_rotation, seen_from_elsewhere);
    if (any.compared < 0.9 * any.answered || any.answered == 0)
        return failed(fmt::format("of {} steps that are answered, {} are when seen from another direction",
                                  any.answered, any.compared));
    if (material.finite_strain()) {
        const Deviation spun = deviation(subject, material, random_rotation, turned_at_the_end);
        if (!spun.none())
            return failed(
                fmt::format("off by {} when the body turns in the step, F = R F", spun.text(material)));
    }
    if (any.none())
        return passed(
            fmt::format("off by {} at most, {} points and rotations", any.text(material), any.compared));
    std::array<Deviation, 3> about;
    for (int axis = 0; axis < 3; ++axis)
        about[static_cast<std::size_t>(axis)] = deviation(
            subject, material, [axis](Random& random) { return random_rotation_about(axis, random); },
            seen_from_elsewhere);
    if (about[1].none())
        return left_out(fmt::format("has a fixed axis, y: off by {} where that turns, by {} about it",
                                    any.text(material), about[1].text(material)));
    return failed(fmt::format("off by {}; about x {:.1g}, about y {:.1g}, about z {:.1g}", any.text(material),
                              about[0].worst(), about[1].worst(), about[2].worst()));
}

} // namespace gault::core::checks
