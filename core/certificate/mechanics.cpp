#include "core/certificate/checks.hpp"
#include "core/certificate/rotation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

namespace gault::core::checks {

// Where the stress bends within the shifts (a step that ends where two branches meet, or at a tip), there is no one
// derivative, and nothing is judged.
Finding tangent(const Subject& subject) {
    constexpr double right = 1e-4; // of the modulus: Newton's method then gains four digits an iteration
    const Material material(subject.use);
    if (!(material.api().flags & GAULT_HAS_TANGENT))
        return left_out("declares none: the host takes differences");
    Random random(5);
    const PointBatch cloud =
        scatter(material, subject.stress, 400, 12, strain_to_yield(material, subject.stress).size, random);
    std::vector<double> errors;
    int bent = 0, yielding = 0;
    for (std::size_t i = 0; i < cloud.count(); ++i) {
        std::optional<PointBatch> one = answered_one(cloud, i, 1e-6, 1e-2, random);
        if (!one || one->update(1.0, true).status != GAULT_OK) continue;
        yielding += is_elastic(*one) ? 0 : 1;
        Matrix6 own;
        for (std::size_t k = 0; k < 36; ++k)
            own(static_cast<Eigen::Index>(k / 6), static_cast<Eigen::Index>(k % 6)) = one->tangent[k][0];
        if (!own.allFinite()) return failed("an entry that is not finite");
        const std::optional<Differences> d = differences(*one, 1.0);
        if (!d) continue;
        if (d->bend <= right * one->modulus[0])
            errors.push_back((own - d->central).cwiseAbs().maxCoeff() / one->modulus[0]);
        else
            ++bent;
    }
    if (errors.empty()) return left_out(fmt::format("the stress bends at all of {} points", bent));
    std::sort(errors.begin(), errors.end());
    return judge(errors.back() <= right,
                 fmt::format("off by {:.1g} of the modulus in the median, {:.1g} at most of {} points; "
                             "the stress bends at {} more; {} yield",
                             errors[errors.size() / 2], errors.back(), errors.size(), bent, yielding));
}

namespace {

constexpr std::size_t paths = 8;

// Paths that bend, of 1 % in all, and a quarter of the way back, each turned at random; their ends. The turn is the end
// of a step where `steps` is a multiple of 5.
std::array<Tensor, paths> ends_of_paths(const Material& material, const Tensor& stress, int steps) {
    Random random(10);
    PointBatch batch = scatter(material, stress, paths, 0, 0.0, random);
    constexpr Tensor a = {-1.0, 0.0, 1.0, 0.0, 0.0, 0.0}, b = {0.0, -0.5, 0.3, 0.6, 0.0, 0.0};
    std::array<Eigen::Matrix3d, paths> turn;
    for (Eigen::Matrix3d& q : turn)
        q = random_rotation(random);
    const auto strain = [&](double share, std::size_t path) {
        const double angle = 0.5 * std::numbers::pi * std::min(share, 2.0 - share);
        Tensor e;
        for (std::size_t k = 0; k < 6; ++k)
            e[k] = 0.01 * (std::sin(angle) * a[k] + (1.0 - std::cos(angle)) * b[k]);
        return rotated(turn[path], e);
    };
    for (int i = 0; i < steps; ++i) {
        for (std::size_t path = 0; path < paths; ++path) {
            Tensor to = strain(1.25 * (i + 1) / steps, path);
            const Tensor from = strain(1.25 * i / steps, path);
            for (std::size_t k = 0; k < 6; ++k)
                to[k] -= from[k];
            batch.set_strain(path, to);
        }
        if (step_each(batch, 1.0 / steps) > 0)
            throw RunError(fmt::format("step {} of {} along a path finds no result", i + 1, steps));
        batch.accept();
        batch.time += 1.0 / steps;
    }
    std::array<Tensor, paths> ends;
    for (std::size_t path = 0; path < paths; ++path)
        ends[path] = batch.get(batch.stress_old, path);
    return ends;
}

} // namespace

// Eightfold steps: an eighth of the error at first order. What has fallen to a quarter converges, and so does what is
// within the tolerance of an adaptive integration from the start.
Finding step_size(const Subject& subject) {
    constexpr double adaptive = 1e-4;
    const Material material(subject.use);
    const std::array<Tensor, paths> exact = ends_of_paths(material, subject.stress, 5 * 4096);
    const auto error = [&](int steps) { // of the path that is worst
        const std::array<Tensor, paths> ends = ends_of_paths(material, subject.stress, steps);
        double worst = 0.0;
        for (std::size_t path = 0; path < paths; ++path) {
            Tensor difference = ends[path];
            for (std::size_t k = 0; k < 6; ++k)
                difference[k] -= exact[path][k];
            worst = std::max(worst, largest(difference) / std::max(largest(exact[path]), 1.0));
        }
        return worst;
    };
    const double coarse = error(40), fine = error(320);
    return judge(coarse <= adaptive || fine <= 0.25 * coarse,
                 coarse <= adaptive ? fmt::format("off by {:.1g} in 40 steps", coarse)
                                    : fmt::format("off by {:.1g} in 40 steps, {:.1g} in 320: order {:.2f}",
                                                  coarse, fine, std::log2(coarse / fine) / 3.0));
}

namespace {

// Work of a square in strain, a then b, over P-wave modulus times the square of the amplitude. Nothing: a side of it
// finds no answer. Small strain has no change of volume that the work of its stress would know.
std::optional<double> work_around(const PointBatch& cloud, std::size_t point, const Tensor& a,
                                  const Tensor& b) {
    PointBatch one(cloud.material(), 1);
    one.take(0, cloud, point);
    double work = 0.0, scale = 0.0, volume = 1.0;
    for (int side = 0; side < 4; ++side) {
        const Tensor e = scaled(side % 2 ? b : a, side < 2 ? 1.0 : -1.0);
        one.set_strain(0, e);
        one.pad();
        if (one.update(1e-3).status != GAULT_OK) return std::nullopt;
        const double before = volume;
        if (cloud.material().finite_strain()) volume *= std::exp(e[0] + e[1] + e[2]);
        for (std::size_t k = 0; k < 6; ++k) {
            const double twice = k < 3 ? 1.0 : 2.0;
            work += twice * 0.5 * (volume * one.stress[k][0] + before * one.stress_old[k][0]) * e[k];
            if (side == 0) scale += twice * one.modulus[0] * e[k] * e[k];
        }
        one.accept();
    }
    return work / scale;
}

} // namespace

// Where the way round and the way back give the same work but for its sign, the soil is elastic there, and the work is
// to be none. Soil that yields around the cycle says nothing: it may give work back where flow is not associated. Of
// stiffness that follows the stress but comes from no potential the work grows with the cube of the amplitude, which is
// measured and borne.
Finding elastic_cycles(const Subject& subject) {
    constexpr double small = 1e-7;
    const Material material(subject.use);
    if (material.rate_dependent()) return left_out("no cycle is elastic where the rate matters");
    Random random(7);
    double most = 0.0, most_of_larger = 0.0;
    int elastic = 0, larger = 0, cycles = 0;
    for (const double strained : {2e-5, 1e-3}) {
        const PointBatch cloud = scatter(material, subject.stress, 200, 12, strained, random);
        for (std::size_t i = 0; i < cloud.count(); ++i) {
            const Tensor a = random_tensor(random, small), b = random_tensor(random, small);
            const auto elastic_work = [&](double factor) -> std::optional<double> {
                const std::optional<double> there =
                                                work_around(cloud, i, scaled(a, factor), scaled(b, factor)),
                                            back =
                                                work_around(cloud, i, scaled(b, factor), scaled(a, factor));
                const bool is_elastic = there && back && std::abs(*there + *back) <= 1e-5;
                return is_elastic ? there : std::nullopt;
            };
            ++cycles;
            const std::optional<double> work = elastic_work(1.0);
            if (!work) continue;
            ++elastic;
            most = std::max(most, std::abs(*work));
            const std::optional<double> of_larger = elastic_work(10.0);
            larger += of_larger ? 1 : 0;
            most_of_larger = std::max(most_of_larger, std::abs(of_larger.value_or(0.0)));
        }
    }
    if (elastic == 0) return left_out(fmt::format("none of {} cycles is elastic", cycles));
    const std::string of_larger =
        larger > 0 ? fmt::format(", {:.1g} at {:g}", most_of_larger, 10.0 * small) : "";
    return judge(
        most <= 1e-3,
        fmt::format("work at most {:.1g} of modulus x amplitude^2 at an amplitude of {:g}{}; {} elastic "
                    "cycles of {}",
                    most, small, of_larger, elastic, cycles));
}

namespace {

// What is wrong with the answer of a point; empty: nothing.
std::string out_of_bounds(const PointBatch& batch, std::size_t point) {
    for (std::size_t k = 0; k < 6; ++k)
        if (!std::isfinite(batch.stress[k][point])) return "a stress that is not finite";
    for (const StateInfo& info : batch.material().states())
        for (int k = 0; k < static_cast<int>(info.declared.shape); ++k)
            if (const double x = batch.state[static_cast<std::size_t>(info.first + k)][point];
                !(x >= info.declared.min && x <= info.declared.max))
                return fmt::format("state '{}' is {:.17g}, beyond {:g} to {:g}", info.declared.name, x,
                                   info.declared.min, info.declared.max);
    return "";
}

} // namespace

Finding random_walk(const Subject& subject) {
    constexpr std::size_t count = 64;
    constexpr int most_steps = 15625; // of every point
    const auto end = std::chrono::steady_clock::now() +
                     std::chrono::duration<double>(std::min(60.0, 0.5 * subject.time_limit));
    const Material material(subject.use);
    Random random(8);
    PointBatch batch = scatter(material, subject.stress, count, 0, 0.0, random);
    std::vector<Tensor> total(count);
    std::size_t refused = 0, steps = 0;
    for (int step = 0; step < most_steps && std::chrono::steady_clock::now() < end; ++step) {
        for (std::size_t i = 0; i < count; ++i) {
            Tensor e = random_tensor(random, log_uniform(random, 1e-9, 1e-2));
            const double pull = 0.05 * largest(e) / (0.02 + largest(total[i]));
            for (std::size_t k = 0; k < 6; ++k) // so that the soil stays about where it was
                e[k] -= pull * total[i][k];
            batch.set_strain(i, e);
        }
        refused += step_each(batch, 1.0);
        for (std::size_t i = 0; i < count; ++i) {
            if (const std::string wrong = out_of_bounds(batch, i); !wrong.empty())
                return failed(fmt::format("step {}: {}", steps + i + 1, wrong));
            for (std::size_t k = 0; k < 6; ++k)
                total[i][k] += batch.strain[k][i];
        }
        steps += count;
        batch.accept();
        batch.time += 1.0;
    }
    const double share = static_cast<double>(refused) / static_cast<double>(std::max<std::size_t>(steps, 1));
    return judge(steps > 0 && share < 0.5,
                 fmt::format("{} steps, {:.2g} % without a result in 64 parts", steps, 100.0 * share));
}

} // namespace gault::core::checks
