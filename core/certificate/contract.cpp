#include "core/certificate/checks.hpp"
#include "core/certificate/cloud.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <latch>
#include <numeric>
#include <thread>

namespace gault::core::checks {
namespace {

// Of the stress, relative; of a state where the stress is the same.
std::string size_of_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double difference = 0.0, scale = 1e-300;
    for (std::size_t k = 0; k < 6; ++k) {
        difference = std::max(difference, std::abs(a[k] - b[k]));
        scale = std::max({scale, std::abs(a[k]), std::abs(b[k])});
    }
    return difference > 0.0 ? fmt::format("by {:.1g} of the stress", difference / scale)
                            : "in a state or a modulus";
}

} // namespace

Finding batches(const Subject& subject) {
    constexpr std::size_t count = 331; // no multiple of a pack
    const Material material(subject.use);
    const PointBatch whole = answered(material, subject.stress, count);
    std::string wrong;
    using Change = std::function<void(PointBatch&)>;
    const auto expect_same = [&](const std::vector<std::size_t>& points, const char* how,
                                 const Change& change = {}, bool tangent = false) {
        if (!wrong.empty()) return;
        PointBatch part(material, points.size());
        for (std::size_t i = 0; i < points.size(); ++i)
            part.take(i, whole, points[i]);
        part.pad();
        if (change) change(part);
        part.time = whole.time;
        if (part.update(1.0, tangent).status != GAULT_OK) {
            wrong = fmt::format("{}: no answer", how);
            return;
        }
        for (std::size_t i = 0; i < points.size() && wrong.empty(); ++i)
            if (const auto a = outcome(part, i), b = outcome(whole, points[i]); !same_bits(a, b))
                wrong = fmt::format("{}: a point comes to another result, {}", how, size_of_difference(a, b));
    };
    std::vector<std::size_t> all(count), shuffled;
    std::iota(all.begin(), all.end(), 0);
    shuffled = all;
    std::shuffle(shuffled.begin(), shuffled.end(), Random(2));
    expect_same(all, "a second time");
    expect_same(shuffled, "shuffled");
    for (std::size_t i = 0; i < count; i += 5)
        expect_same({i}, "alone");
    for (std::size_t i = 0; i + 11 < count; i += 11)
        expect_same(
            {all.begin() + static_cast<std::ptrdiff_t>(i), all.begin() + static_cast<std::ptrdiff_t>(i) + 11},
            "split");
    expect_same({7, 11, 13}, "padded with other points", [&](PointBatch& part) {
        for (std::size_t lane = part.count(); lane < part.strain[0].size(); ++lane)
            part.take(lane, whole, (lane * 37) % count);
    });
    expect_same(all, "with other values in its outputs before", [](PointBatch& part) {
        for (Column& c : part.stress)
            std::fill(c.begin(), c.end(), std::nan(""));
        for (Column& c : part.state)
            std::fill(c.begin(), c.end(), std::nan(""));
    });
    expect_same(all, "not asked for moduli", [](PointBatch& part) {
        part.modulus.clear();
        part.shear_modulus.clear();
    });
    if (material.api().flags & GAULT_HAS_TANGENT) expect_same(all, "asked for its tangent", {}, true);
    return judge(wrong.empty(), wrong.empty() ? fmt::format("{} points, the same bits", count) : wrong);
}

namespace {

std::vector<const Column*> answers_of(const PointBatch& batch) {
    std::vector<const Column*> columns = {&batch.modulus, &batch.shear_modulus};
    for (const Column& c : batch.stress)
        columns.push_back(&c);
    for (const Column& c : batch.state)
        columns.push_back(&c);
    return columns;
}

bool same_answers(const PointBatch& a, const PointBatch& b) {
    const std::vector<const Column*> left = answers_of(a), right = answers_of(b);
    return std::equal(left.begin(), left.end(), right.begin(), [&](const Column* x, const Column* y) {
        return std::memcmp(x->data(), y->data(), a.count() * sizeof(double)) == 0;
    });
}

} // namespace

Finding threads(const Subject& subject) {
    const Material material(subject.use);
    if (material.one_at_a_time()) return left_out("declares that it is called by one thread at a time");
    constexpr std::size_t workers = 4, points = 160;
    constexpr double seconds = 0.1;
    constexpr int least_turns = 10;
    const PointBatch once = answered(material, subject.stress, points);
    std::vector<PointBatch>
        batches; // each begins with another point, so that no two work on the same one at once
    for (std::size_t w = 0; w < workers; ++w) {
        PointBatch& batch = batches.emplace_back(once);
        for (std::size_t i = 0; i < points; ++i)
            batch.take(i, once, (i + w * points / workers) % points);
        batch.pad();
        if (batch.update(1.0).status != GAULT_OK) return failed("no answer to the points in another order");
    }
    std::vector<int> wrong(workers, 0), turns(workers, 0);
    std::latch together(workers);
    std::vector<std::thread> team;
    for (std::size_t w = 0; w < workers; ++w)
        team.emplace_back([&, w] {
            PointBatch batch = batches[w];
            together.arrive_and_wait();
            const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
            for (; turns[w] < least_turns || std::chrono::steady_clock::now() < end; ++turns[w])
                wrong[w] += batch.update(1.0).status != GAULT_OK || !same_answers(batch, batches[w]);
        });
    for (std::thread& t : team)
        t.join();
    const int total = std::accumulate(wrong.begin(), wrong.end(), 0),
              calls = std::accumulate(turns.begin(), turns.end(), 0);
    return judge(total == 0, total == 0
                                 ? fmt::format("{} threads on different points, the same bits", workers)
                                 : fmt::format("{} calls of {} come to another result", total, calls));
}

namespace {

constexpr int to_rest = 100; // steps without strain
const char* const component_names[] = {"xx", "yy", "zz", "xy", "yz", "zx"};

// A point that is not strained stays as it is, over a step of no length too. What is wrong; empty: nothing.
std::string at_rest(PointBatch batch, double scale) {
    const PointBatch start = batch;
    for (std::size_t i = 0; i < batch.count(); ++i)
        batch.set_strain(i, {});
    batch.pad();
    for (int step = 0; step < to_rest; ++step) {
        const double dt = step == 0 ? 0.0 : 1.0;
        const UpdateFailure failure = batch.update(dt);
        if (failure.status != GAULT_OK)
            return fmt::format("no strain, over {:g} s: no answer: {}", dt,
                               failure.text.empty() ? "RETRY" : failure.text);
        for (std::size_t i = 0; i < batch.count(); ++i)
            if (!all_finite(outcome(batch, i)))
                return fmt::format("no strain, over {:g} s: an answer that is not finite", dt);
        batch.accept();
        batch.time += dt;
        if (batch.material().rate_dependent() && dt > 0.0) continue;
        double change = 0.0;
        for (std::size_t i = 0; i < batch.count(); ++i)
            for (std::size_t k = 0; k < 6; ++k)
                change = std::max(change, std::abs(batch.stress_old[k][i] - start.stress_old[k][i]));
        if (change > 1e-5 * scale)
            return fmt::format("no strain: the stress creeps, by {:.1g} of the largest in {} steps",
                               change / scale, step + 1);
    }
    return "";
}

// Of one point at a time, for one that asks for less would hide the others.
std::string answer_to(const PointBatch& cloud, double size) {
    Random random(3);
    for (std::size_t i = 0; i < cloud.count(); ++i) {
        PointBatch one(cloud.material(), 1);
        one.take(0, cloud, i);
        one.time = cloud.time;
        one.set_strain(0, random_tensor(random, size));
        one.pad();
        const gault_status status = one.update(1.0).status;
        if (status == GAULT_RETRY || status == GAULT_FAILED) {
            if (size < 1e-6) return fmt::format("a strain of {:g}: no answer", size);
            continue;
        }
        if (status != GAULT_OK) return fmt::format("a strain of {:g}: the unknown status {}", size, status);
        if (!all_finite(outcome(one, 0)))
            return fmt::format("a strain of {:g}: an answer that is not finite", size);
    }
    return "";
}

std::string answer_to_nan(const PointBatch& before, std::size_t component) {
    constexpr std::size_t bad = 5;
    PointBatch batch = before;
    batch.strain[component][bad] = std::nan("");
    if (before.material().finite_strain()) batch.F_new[component][bad] = std::nan("");
    batch.pad();
    if (batch.update(1.0).status != GAULT_OK) return "";
    const Tensor stress = batch.get(batch.stress, bad);
    if (std::all_of(stress.begin(), stress.end(), [](double x) { return std::isfinite(x); }))
        return fmt::format("NaN for {}: a finite stress, as if nothing were wrong",
                           component_names[component]);
    for (std::size_t i = 0; i < batch.count(); ++i)
        if (i != bad && !same_bits(outcome(batch, i), outcome(before, i)))
            return fmt::format("NaN for {} spoils the points beside it", component_names[component]);
    return "";
}

} // namespace

Finding increments(const Subject& subject) {
    constexpr std::size_t count = 40;
    const Material material(subject.use);
    const PointBatch before = answered(material, subject.stress, count);
    double scale = 1.0;
    for (const Column& c : before.stress_old)
        for (const double x : c)
            scale = std::max(scale, std::abs(x));
    if (const std::string wrong = at_rest(before, scale); !wrong.empty()) return failed(wrong);
    const bool volume = material.wants(HostField::density) || material.wants(HostField::volume_ratio);
    const std::vector<double> sizes = material.finite_strain() ? std::vector{1e-300, 0.1, 1.0, 3.0}
                                      // det F has digits
                                      : volume ? std::vector{1e-300, 1.0, 10.0, 100.0} // exp() is a number
                                               : std::vector{1e-300, 1.0, 1e3, 1e10};
    for (const double size : sizes)
        if (const std::string wrong = answer_to(before, size); !wrong.empty()) return failed(wrong);
    for (std::size_t component = 0; component < 4; ++component) // what a scene strains
        if (const std::string wrong = answer_to_nan(before, component); !wrong.empty()) return failed(wrong);
    return passed(fmt::format("0, {:g}, NaN", fmt::join(sizes, ", ")));
}

Finding retry(const Subject& subject) {
    const Material material(subject.use);
    Random random(4);
    const PointBatch cloud =
        scatter(material, subject.stress, 64, 12, strain_to_yield(material, subject.stress).size, random);
    int asked = 0, tried = 0;
    for (std::size_t i = 0; i < cloud.count(); ++i)
        for (const double size : {1e-3, 1e-2, 0.1}) {
            const int most_pieces = size < 0.1 ? 1024 : 1; // so long a step may never be answered
            const Tensor increment = random_tensor(random, size);
            PointBatch one(material, 1);
            gault_status status = GAULT_RETRY;
            ++tried;
            for (int pieces = 1; status == GAULT_RETRY && pieces <= most_pieces; pieces *= 2) {
                one.take(0, cloud, i);
                one.time = cloud.time;
                status = GAULT_OK;
                for (int piece = 0; piece < pieces && status == GAULT_OK; ++piece) {
                    one.set_strain(0, scaled(increment, 1.0 / pieces));
                    one.pad();
                    status = one.update(1.0 / pieces).status;
                    one.accept();
                    one.time += 1.0 / pieces;
                }
                if (status != GAULT_RETRY) continue;
                asked += pieces == 1;
                if (!(one.suggested > 0.0 && one.suggested < 1.0))
                    return failed(fmt::format("suggests {:g} of the step; it must be above 0 and below 1",
                                              one.suggested));
            }
            if (status == GAULT_RETRY && size < 0.1)
                return failed(fmt::format("an increment of {:g} is not answered in 1024 parts", size));
        }
    return passed(asked ? fmt::format("asked {} times of {}", asked, tried) : "never asks for less");
}

// The same strains in a thousandth of the time, earlier.
Finding rate(const Subject& subject) {
    constexpr double rounding = 1e-9;
    const Material material(subject.use);
    const PointBatch slow = answered(material, subject.stress, 40);
    PointBatch fast = slow;
    fast.time = 0.5 * slow.time;
    if (fast.update(1e-3).status != GAULT_OK && !material.rate_dependent())
        return failed("a faster step is not answered, and no dependence on the rate is declared");
    int differ = 0;
    double most = 0.0;
    for (std::size_t i = 0; i < slow.count(); ++i) {
        Tensor difference = fast.get(fast.stress, i);
        for (std::size_t k = 0; k < 6; ++k)
            difference[k] -= slow.stress[k][i];
        const double taking_part =
            std::max({largest(slow.get(slow.stress, i)), largest(slow.get(slow.stress_old, i)), 1e-300});
        differ += largest(difference) > rounding * taking_part;
        most = std::max(most, largest(difference) / taking_part);
    }
    const std::string found = fmt::format(
        "{} of {} points differ in a thousandth of the time, by {:.1g} at most", differ, slow.count(), most);
    if (material.rate_dependent()) return passed("declared; " + found);
    return judge(differ == 0, differ == 0 ? "none" : "not declared; " + found);
}

} // namespace gault::core::checks
