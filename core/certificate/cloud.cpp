#include "core/certificate/cloud.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace gault::core {
namespace {

constexpr int most_pieces = 64;

// A point by itself. False: no result in most_pieces parts.
bool step_one(PointBatch& batch, std::size_t point, double dt) {
    const Tensor whole = batch.get(batch.strain, point);
    for (int pieces = 1; pieces <= most_pieces; pieces *= 2) {
        PointBatch one(batch.material(), 1);
        one.take(0, batch, point);
        one.time = batch.time;
        const Tensor part = scaled(whole, 1.0 / pieces);
        int made = 0;
        for (; made < pieces; ++made) {
            one.set_strain(0, part);
            one.pad();
            if (one.update(dt / pieces).status != GAULT_OK) break;
            one.accept();
            one.time += dt / pieces;
        }
        if (made < pieces) continue;
        batch.set(batch.stress, point, one.get(one.stress, 0));
        for (std::size_t k = 0; k < batch.state.size(); ++k)
            batch.state[k][point] = one.state[k][0];
        return true;
    }
    batch.set(batch.stress, point, batch.get(batch.stress_old, point));
    for (std::size_t k = 0; k < batch.state.size(); ++k)
        batch.state[k][point] = batch.state_old[k][point];
    batch.set_strain(point, {});
    return false;
}

} // namespace

double uniform(Random& random, double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}
double log_uniform(Random& random, double low, double high) {
    return low * std::pow(high / low, uniform(random, 0.0, 1.0));
}

Tensor random_tensor(Random& random, double norm) {
    Tensor t;
    double square = 0.0;
    do {
        square = 0.0;
        for (std::size_t k = 0; k < 6; ++k) {
            t[k] = uniform(random, -1.0, 1.0);
            square += (k < 3 ? 1.0 : 2.0) * t[k] * t[k];
        }
    } while (square > 3.0 || square < 1e-3);
    return scaled(t, norm / std::sqrt(square));
}

Tensor scaled(Tensor t, double factor) {
    for (double& x : t)
        x *= factor;
    return t;
}
double largest(const Tensor& t) {
    double most = 0.0;
    for (const double x : t)
        most = std::max(most, std::abs(x));
    return most;
}

std::size_t step_each(PointBatch& batch, double dt) {
    batch.pad();
    if (batch.update(dt).status == GAULT_OK) return 0;
    std::size_t refused = 0;
    for (std::size_t i = 0; i < batch.count(); ++i)
        refused += step_one(batch, i, dt) ? 0 : 1;
    return refused;
}

PointBatch scatter(const Material& material, const Tensor& stress, std::size_t count, int steps,
                   double largest, Random& random) {
    PointBatch batch(material, count);
    for (std::size_t i = 0; i < count; ++i)
        batch.set(batch.stress_old, i, stress);
    batch.pad();
    if (const UpdateFailure failure = batch.start(); failure.status != GAULT_OK)
        throw RunError(fmt::format("refuses the initial stress: {}", failure.text));
    for (int step = 0; step < steps; ++step) {
        for (std::size_t i = 0; i < count; ++i)
            batch.set_strain(i, random_tensor(random, log_uniform(random, 1e-6, largest)));
        step_each(batch, 1.0);
        batch.accept();
        batch.time += 1.0;
    }
    return batch;
}

std::optional<PointBatch> answered_one(const PointBatch& cloud, std::size_t point, double low, double high,
                                       Random& random, double dt) {
    PointBatch one(cloud.material(), 1);
    one.take(0, cloud, point);
    one.time = cloud.time;
    Tensor increment = random_tensor(random, log_uniform(random, low, high));
    for (int halving = 0; halving < 20; ++halving, increment = scaled(increment, 0.5)) {
        one.set_strain(0, increment);
        one.pad();
        if (one.update(dt).status == GAULT_OK) return one;
    }
    return std::nullopt;
}

PointBatch answered(const Material& material, const Tensor& stress, std::size_t count) {
    Random random(1);
    const PointBatch cloud =
        scatter(material, stress, count, 12, strain_to_yield(material, stress).size, random);
    PointBatch batch = cloud;
    for (std::size_t i = 0; i < count; ++i) {
        const std::optional<PointBatch> one = answered_one(cloud, i, 1e-7, 3e-3, random);
        if (!one) throw RunError("a point answers no increment, however small");
        batch.set_strain(i, one->get(one->strain, 0));
    }
    batch.pad();
    if (const UpdateFailure failure = batch.update(1.0); failure.status != GAULT_OK)
        throw RunError(fmt::format("points that are answered one by one are not as a batch: {}",
                                   failure.text.empty() ? "RETRY" : failure.text));
    return batch;
}

std::vector<double> outcome(const PointBatch& batch, std::size_t point) {
    std::vector<double> row;
    for (const Column& c : batch.stress)
        row.push_back(c[point]);
    for (const Column& c : batch.state)
        row.push_back(c[point]);
    for (const Column* c : {&batch.modulus, &batch.shear_modulus})
        if (!c->empty()) row.push_back((*c)[point]);
    return row;
}
bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return std::memcmp(a.data(), b.data(), std::min(a.size(), b.size()) * sizeof(double)) == 0;
}
bool all_finite(const std::vector<double>& outcome) {
    return std::all_of(outcome.begin(), outcome.end(), [](double x) { return std::isfinite(x); });
}

bool is_elastic(const PointBatch& call) {
    PointBatch there = call;
    const Tensor start = call.get(call.stress_old, 0);
    const auto change_after = [&](double factor) -> std::optional<Tensor> {
        there.set_strain(0, scaled(call.get(call.strain, 0), factor));
        there.pad();
        if (there.update(quick).status != GAULT_OK) return std::nullopt;
        there.accept();
        Tensor change = there.get(there.stress, 0);
        for (std::size_t k = 0; k < 6; ++k)
            change[k] -= start[k];
        return change;
    };
    const std::optional<Tensor> change = change_after(1.5), rest = change ? change_after(-1.5) : change;
    return rest && largest(*rest) <= 1e-4 * largest(*change) + 1e-13 * largest(start);
}

YieldStrain strain_to_yield(const Material& material, const Tensor& stress) {
    constexpr std::size_t count = 60;
    for (double strain = YieldStrain{}.size; strain <= 0.064; strain *= 2.0) {
        Random random(3);
        const PointBatch cloud = scatter(material, stress, count, 12, strain, random);
        std::size_t yielding = 0;
        for (std::size_t i = 0; i < count; ++i)
            if (const auto one = answered_one(cloud, i, 1e-8, 1e-7, random, quick))
                yielding += is_elastic(*one) ? 0 : 1;
        if (10 * yielding >= count) return {strain, true};
    }
    return {};
}

namespace {

// The call once more with one component of the strain shifted; a deformation gradient F_new becomes exp(e) F_new.
std::optional<Tensor> shifted(const PointBatch& call, std::size_t column, double shift, double dt) {
    PointBatch moved = call;
    Tensor e{};
    e[column] = shift;
    Tensor increment = call.get(call.strain, 0);
    increment[column] += shift;
    moved.set_strain(0, increment);
    const Matrix stretch = deformation_gradient(e);
    for (std::size_t k = 0; k < 9 && call.material().finite_strain(); ++k) {
        double sum = 0.0;
        for (std::size_t j = 0; j < 3; ++j)
            sum += stretch[3 * (k / 3) + j] * call.F_new[3 * j + k % 3][0];
        moved.F_new[k][0] = sum;
    }
    moved.pad();
    if (moved.update(dt).status != GAULT_OK) return std::nullopt;
    return moved.get(moved.stress, 0);
}

std::optional<Differences> differences_at(const PointBatch& call, double shift, double dt) {
    Differences d{Matrix6::Zero(), 0.0};
    for (std::size_t column = 0; column < 6; ++column) {
        const std::optional<Tensor> above = shifted(call, column, shift, dt),
                                    below = shifted(call, column, -shift, dt);
        if (!above || !below) return std::nullopt;
        for (std::size_t row = 0; row < 6; ++row) {
            const double here = call.stress[row][0], up = ((*above)[row] - here) / shift,
                         down = (here - (*below)[row]) / shift;
            d.central(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = 0.5 * (up + down);
            d.bend = std::max(d.bend, std::abs(up - down));
        }
    }
    return d;
}

} // namespace

std::optional<Differences> differences(const PointBatch& call, double dt) {
    std::optional<Differences> best;
    for (const double shift : {1e-7, 1e-8, 1e-9})
        if (const auto d = differences_at(call, shift, dt); d && (!best || d->bend < best->bend)) best = d;
    return best;
}

} // namespace gault::core
