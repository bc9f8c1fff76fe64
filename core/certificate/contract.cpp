#include "core/base/units.hpp"
#include "core/certificate/checks.hpp"
#include "core/certificate/cloud.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <thread>

namespace gault::core::checks {
namespace {

bool is_unit(const std::string& unit) {
    try {
        parse_quantity(unit == "1" ? "1" : "1 " + unit, unit);
        return true;
    } catch (const std::invalid_argument&) {
        return false;
    }
}
bool is_sentence(const char* text) {
    const std::size_t length = std::strlen(text);
    return length > 3 && text[length - 1] == '.';
}

// What a point came to: stress, states, moduli.
std::vector<double> outcome(const PointBatch& batch, std::size_t point) {
    std::vector<double> row;
    for (const Column& c : batch.stress)
        row.push_back(c[point]);
    for (const Column& c : batch.state)
        row.push_back(c[point]);
    row.push_back(batch.modulus[point]);
    row.push_back(batch.shear_modulus[point]);
    return row;
}
bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

// Points with increments that the model answers in one call, and that call made.
PointBatch answered(const Material& material, const Tensor& stress, std::size_t count) {
    Random random(1);
    PointBatch batch = scatter(material, stress, count, 12, 2e-3, random);
    std::vector<Tensor> increment(count);
    for (Tensor& e : increment)
        e = random_tensor(random, log_uniform(random, 1e-7, 3e-3));
    for (int halving = 0; halving < 40; ++halving) {
        for (std::size_t i = 0; i < count; ++i)
            batch.set_strain(i, increment[i]);
        batch.pad();
        const UpdateFailure failure = batch.update(1.0);
        if (failure.status == GAULT_OK) return batch;
        const auto halve = [](Tensor& e) {
            for (double& x : e)
                x *= 0.5;
        };
        if (failure.slot)
            halve(increment[*failure.slot]);
        else
            std::for_each(increment.begin(), increment.end(), halve);
    }
    throw RunError("the model answers no batch of increments, however small");
}

} // namespace

Finding declaration(const Subject& subject) {
    const gault_component& c = *subject.use.model.component->declaration;
    std::vector<std::string> wrong;
    int count = 0;
    const auto look = [&](const char* what, const char* name, const char* unit, const char* doc) {
        ++count;
        if (unit && *unit && !is_unit(unit))
            wrong.push_back(fmt::format("{} '{}': no unit '{}'", what, name, unit));
        if (!is_sentence(doc)) wrong.push_back(fmt::format("{} '{}': '{}' is no sentence", what, name, doc));
    };
    if (!is_sentence(c.doc)) wrong.push_back(fmt::format("the model's '{}' is no sentence", c.doc));
    for (const gault_parameter* const* p = c.parameters; *p; ++p)
        look("parameter", (*p)->name, (*p)->unit, (*p)->doc);
    const Material material(subject.use);
    for (const StateInfo& info : material.states())
        look("state", info.declared.name, info.declared.unit, info.declared.doc);
    return judge(wrong.empty(), wrong.empty() ? fmt::format("{} parameters and states", count)
                                              : fmt::format("{}", fmt::join(wrong, "; ")));
}

Finding bounds(const Subject& subject) {
    const gault_component& c = *subject.use.model.component->declaration;
    int tried = 0, refused = 0;
    const std::vector<gault_value>& given = subject.use.model.parameters.values;
    for (std::size_t i = 0; c.parameters[i]; ++i) {
        const gault_parameter& p = *c.parameters[i];
        if ((p.type != GAULT_REAL && p.type != GAULT_INTEGER) || given[i].count == 0) continue;
        const auto at = [&](double bound, bool open, double side) {
            if (!std::isfinite(bound)) return bound;
            return open ? std::nextafter(bound, side) : bound;
        };
        for (const double value : {at(p.min, p.flags & GAULT_MIN_OPEN, HUGE_VAL),
                                   at(p.max, p.flags & GAULT_MAX_OPEN, -HUGE_VAL)}) {
            if (!std::isfinite(value)) continue;
            std::vector<gault_value> values = given;
            values[i].real = value;
            if (p.type == GAULT_INTEGER)
                values[i].integer = static_cast<int64_t>(std::clamp(value, -9e18, 9e18));
            gault_error error{-1, 0, -1, ""};
            void* self = nullptr;
            const gault_status status = c.create(&plugin_host(), values.data(), &self, &error);
            ++tried;
            if (status == GAULT_OK) {
                if (c.destroy) c.destroy(self);
            } else if (status == GAULT_INVALID && error.parameter >= 0 && error.text[0]) {
                ++refused;
            } else {
                return failed(
                    fmt::format("'{}' = {:g}, within its bounds, is answered with status {} and names {}",
                                p.name, value, status, error.parameter < 0 ? "no parameter" : "no reason"));
            }
        }
    }
    return passed(fmt::format("{} bounds tried, {} refused with a parameter and a reason", tried, refused));
}

Finding batches(const Subject& subject) {
    constexpr std::size_t count = 331; // no multiple of a pack
    const Material material(subject.use);
    const PointBatch whole = answered(material, subject.stress, count);
    const auto differs = [&](const std::vector<std::size_t>& points, const char* how, bool strange_padding) {
        PointBatch part(material, points.size());
        for (std::size_t i = 0; i < points.size(); ++i)
            part.take(i, whole, points[i]);
        part.pad();
        if (strange_padding) // other admissible values beyond `count`
            for (std::size_t lane = part.count(); lane < part.strain[0].size(); ++lane)
                part.take(lane, whole, (lane * 37) % count);
        part.time = whole.time;
        if (part.update(1.0).status != GAULT_OK) return fmt::format("{}: no answer", how);
        for (std::size_t i = 0; i < points.size(); ++i)
            if (!same_bits(outcome(part, i), outcome(whole, points[i])))
                return fmt::format("{}: a point comes to another result", how);
        return std::string();
    };
    std::vector<std::size_t> all(count), shuffled;
    std::iota(all.begin(), all.end(), 0);
    shuffled = all;
    std::shuffle(shuffled.begin(), shuffled.end(), Random(2));
    std::string wrong = differs(shuffled, "shuffled", false);
    for (std::size_t i = 0; i < count && wrong.empty(); i += 5)
        wrong = differs({i}, "alone", false);
    for (std::size_t i = 0; i + 11 < count && wrong.empty(); i += 11)
        wrong = differs(
            {all.begin() + static_cast<std::ptrdiff_t>(i), all.begin() + static_cast<std::ptrdiff_t>(i) + 11},
            "split", false);
    if (wrong.empty()) wrong = differs({7, 11, 13}, "padded with other points", true);
    return judge(wrong.empty(), wrong.empty() ? fmt::format("{} points, the same bits", count) : wrong);
}

Finding threads(const Subject& subject) {
    const Material material(subject.use);
    if (material.one_at_a_time()) return left_out("declares that it is called by one thread at a time");
    constexpr std::size_t workers = 4, points = 160;
    constexpr int turns = 40;
    const PointBatch once = answered(material, subject.stress, points);
    std::vector<PointBatch> batches(workers, once);
    std::vector<int> wrong(workers, 0);
    std::vector<std::thread> team;
    for (std::size_t w = 0; w < workers; ++w)
        team.emplace_back([&, w] {
            for (int turn = 0; turn < turns; ++turn) {
                const bool good = batches[w].update(1.0).status == GAULT_OK;
                for (std::size_t i = 0; i < points; ++i)
                    wrong[w] += !good || !same_bits(outcome(batches[w], i), outcome(once, i));
            }
        });
    for (std::thread& t : team)
        t.join();
    const int total = std::accumulate(wrong.begin(), wrong.end(), 0);
    return judge(total == 0, total == 0
                                 ? fmt::format("{} threads, {} calls", workers, workers * turns)
                                 : fmt::format("{} results of {} differ", total, workers * points * turns));
}

Finding increments(const Subject& subject) {
    constexpr std::size_t count = 40, bad = 5;
    const Material material(subject.use);
    PointBatch batch = answered(material, subject.stress, count);
    const PointBatch before = batch;
    const auto all = [&](const char* what, double size) -> std::string {
        Random random(3);
        for (std::size_t i = 0; i < count; ++i)
            batch.set_strain(i, size == 0.0 ? Tensor{} : random_tensor(random, size));
        batch.pad();
        if (batch.update(1.0).status != GAULT_OK)
            return size <= 1e-12 ? fmt::format("{}: no answer", what) : "";
        for (std::size_t i = 0; i < count; ++i) {
            const std::vector<double> row = outcome(batch, i);
            if (!std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); }))
                return fmt::format("{}: an answer that is not finite", what);
            double change = 0.0, scale = 1.0;
            for (std::size_t k = 0; k < 6; ++k) {
                change = std::max(change, std::abs(batch.stress[k][i] - batch.stress_old[k][i]));
                scale = std::max(scale, std::abs(batch.stress_old[k][i]));
            }
            if (size <= 1e-200 && !material.rate_dependent() && change > 1e-8 * scale)
                return fmt::format("{}: the stress changes by {:.2g} of itself", what, change / scale);
        }
        return "";
    };
    for (const auto& [what, size] :
         {std::pair{"no increment", 0.0}, {"1e-300", 1e-300}, {"1", 1.0}, {"1e3", 1e3}, {"1e10", 1e10}})
        if (const std::string wrong = all(what, size); !wrong.empty()) return failed(wrong);
    for (std::size_t i = 0; i < count; ++i)
        batch.take(i, before, i);
    batch.strain[0][bad] = std::nan("");
    batch.pad();
    if (batch.update(1.0).status == GAULT_OK) {
        const Tensor stress = batch.get(batch.stress, bad);
        if (std::all_of(stress.begin(), stress.end(), [](double x) { return std::isfinite(x); }))
            return failed("NaN: a finite stress, as if nothing were wrong");
        for (std::size_t i = 0; i < count; ++i)
            if (i != bad && !same_bits(outcome(batch, i), outcome(before, i)))
                return failed("NaN: spoils the points beside it");
    }
    return passed("0, 1e-300, 1, 1e3, 1e10, NaN");
}

Finding retry(const Subject& subject) {
    const Material material(subject.use);
    Random random(4);
    const PointBatch cloud = scatter(material, subject.stress, 64, 12, 2e-3, random);
    int asked = 0;
    for (std::size_t i = 0; i < cloud.count(); ++i)
        for (const double size : {1e-3, 1e-2, 0.1}) {
            const Tensor increment = random_tensor(random, size);
            PointBatch one(material, 1);
            gault_status status = GAULT_RETRY;
            std::string text;
            for (int pieces = 1; status == GAULT_RETRY && pieces <= 1024; pieces *= 2) {
                one.take(0, cloud, i);
                Tensor part = increment;
                for (double& e : part)
                    e /= pieces;
                status = GAULT_OK;
                for (int piece = 0; piece < pieces && status == GAULT_OK; ++piece) {
                    one.set_strain(0, part);
                    one.pad();
                    status = one.update(1.0 / pieces).status;
                    one.accept();
                }
                if (pieces > 1 || status != GAULT_RETRY) continue;
                ++asked;
                if (!(one.suggested > 0.0 && one.suggested < 1.0))
                    return failed(fmt::format("suggests {:g} of the step; it must be above 0 and below 1",
                                              one.suggested));
            }
            if (status == GAULT_RETRY)
                return failed(fmt::format("an increment of {:g} is not answered in 1024 parts", size));
        }
    return passed(asked ? fmt::format("asked {} times of {}", asked, 3 * cloud.count())
                        : "never asks for less");
}

} // namespace gault::core::checks
