#include "core/base/units.hpp"
#include "core/certificate/checks.hpp"
#include "core/certificate/cloud.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>

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

class Declarations {
  public:
    void look(const std::string& what, const char* unit, const char* doc) {
        ++count;
        if (unit && *unit && !is_unit(unit)) wrong.push_back(fmt::format("{}: no unit '{}'", what, unit));
        if (!is_sentence(doc)) wrong.push_back(fmt::format("{}: '{}' is no sentence", what, doc));
    }
    void look(const gault_parameter* const* parameters, const std::string& owner) {
        for (; *parameters; ++parameters) {
            const gault_parameter& p = **parameters;
            const std::string what = fmt::format("{}parameter '{}'", owner, p.name);
            look(what, p.unit, p.doc);
            if (p.type == GAULT_TABLE && !is_unit(p.x_unit))
                wrong.push_back(fmt::format("{}: no unit '{}'", what, p.x_unit));
            for (const gault_record_kind* const* kind = p.kinds; p.type == GAULT_RECORDS && *kind; ++kind)
                look((*kind)->parameters, fmt::format("{}, {}, ", what, (*kind)->name));
        }
    }

    int count = 0;
    std::vector<std::string> wrong;
};

} // namespace

Finding declaration(const Subject& subject) {
    const gault_component& c = *subject.use.model.component->declaration;
    Declarations all;
    if (!is_sentence(c.doc)) all.wrong.push_back(fmt::format("the model's '{}' is no sentence", c.doc));
    all.look(c.parameters, "");
    const Material material(subject.use);
    for (const StateInfo& info : material.states())
        all.look(fmt::format("state '{}'", info.declared.name), info.declared.unit, info.declared.doc);
    return judge(all.wrong.empty(), all.wrong.empty() ? fmt::format("{} parameters and states", all.count)
                                                      : fmt::format("{}", fmt::join(all.wrong, "; ")));
}

namespace {

struct Trial { // of one parameter
    gault_value value;
    bool allowed; // itself: a bound that is open stands for its neighbour, which nobody writes
};

std::vector<Trial> trials_of(const gault_parameter& p, const gault_value& given) {
    std::vector<Trial> trials;
    const auto add = [&](double value, bool allowed, const char* text = "") {
        gault_value v = given;
        v.real = value;
        v.text = text;
        if (p.type != GAULT_REAL) v.integer = static_cast<int64_t>(std::clamp(value, -9e18, 9e18));
        trials.push_back({v, allowed});
    };
    if (p.type == GAULT_BOOLEAN) add(0.0, true), add(1.0, true);
    for (std::size_t k = 0; p.type == GAULT_CHOICE && p.choices[k]; ++k)
        add(static_cast<double>(k), true, p.choices[k]);
    if (p.type != GAULT_REAL && p.type != GAULT_INTEGER) return trials;
    for (const auto& [bound, open, inside] :
         {std::tuple{p.min, GAULT_MIN_OPEN, HUGE_VAL}, {p.max, GAULT_MAX_OPEN, -HUGE_VAL}}) {
        if (!std::isfinite(bound)) continue;
        const bool excluded = p.flags & static_cast<uint32_t>(open);
        const double neighbour =
            p.type == GAULT_INTEGER ? bound + std::copysign(1.0, inside) : std::nextafter(bound, inside);
        add(excluded ? neighbour : bound, !excluded || p.type == GAULT_INTEGER);
    }
    return trials;
}

MaterialUse with_value(const MaterialUse& use, std::size_t parameter, const gault_value& value) {
    Parameters parameters; // what its values point at stays the subject's
    parameters.values = use.model.parameters.values;
    parameters.values[parameter] = value;
    parameters.locations = use.model.parameters.locations;
    parameters.where = use.model.parameters.where;
    return {use.name, {use.model.component, std::move(parameters)}, use.density, {}, use.yaml};
}

// Where a path of random strains leads: stresses and states of all points, one after another.
std::vector<double> end_of_path(const Material& material, const Tensor& stress, double strain) {
    Random random(4);
    const PointBatch cloud = scatter(material, stress, 64, 24, strain, random);
    std::vector<double> end;
    for (std::size_t i = 0; i < cloud.count(); ++i) {
        for (const Column& c : cloud.stress_old)
            end.push_back(c[i]);
        for (const Column& c : cloud.state_old)
            end.push_back(c[i]);
    }
    return end;
}

// Does another value of this number lead elsewhere? A soil that refuses the values, or the stress with them, heeds them.
bool matters(const Subject& subject, std::size_t parameter, double strain, const std::vector<double>& end) {
    const gault_value& given = subject.use.model.parameters.values[parameter];
    const gault_parameter& p = *subject.use.model.component->declaration->parameters[parameter];
    for (const double factor : {1.01, 0.99}) {
        gault_value other = given;
        other.real = given.real != 0.0 ? factor * given.real : factor - 1.0;
        if (!(other.real > p.min && other.real < p.max)) continue;
        try {
            if (end_of_path(Material(with_value(subject.use, parameter, other)), subject.stress, strain) !=
                end)
                return true;
        } catch (const std::runtime_error&) {
            return true;
        }
    }
    return false;
}

// Some first steps of a soil with an unusual parameter: it may refuse them. What is wrong; empty: nothing.
std::string first_steps(const Material& material, const Tensor& stress) {
    Random random(11);
    PointBatch one(material, 1);
    one.set(one.stress_old, 0, stress);
    one.pad();
    if (one.start().status != GAULT_OK) return "";
    for (const double size : {0.0, 1e-6, 1e-4, 1e-3}) {
        one.set_strain(0, random_tensor(random, size));
        one.pad();
        if (one.update(size > 0.0 ? 1.0 : 0.0).status == GAULT_OK && !all_finite(outcome(one, 0)))
            return fmt::format("a strain of {:g} is answered, and not with numbers", size);
    }
    return "";
}

} // namespace

// A state that stays where it started while soil yields was forgotten. What a UMAT has in reserve is its own matter.
Finding effect(const Subject& subject) {
    const Material material(subject.use);
    const auto [strain, yields] = strain_to_yield(material, subject.stress);
    Random random(4);
    const PointBatch start = scatter(material, subject.stress, 1, 0, 0.0, random);
    const std::vector<double> end = end_of_path(material, subject.stress, strain);
    const std::size_t row = 6 + start.state_old.size();
    std::vector<std::string> still, idle;
    for (const StateInfo& info : material.states()) {
        bool moves = false;
        for (int k = 0; k < static_cast<int>(info.declared.shape); ++k) {
            const auto component = static_cast<std::size_t>(info.first + k);
            const double first = start.state_old[component][0];
            moves |= first != info.declared.initial;
            for (std::size_t i = 0; i < end.size() / row; ++i)
                moves |= end[i * row + 6 + component] != first;
        }
        if (!moves) still.push_back(fmt::format("state '{}' never changes", info.declared.name));
    }
    const std::vector<gault_value>& given = subject.use.model.parameters.values;
    for (std::size_t i = 0; i < given.size(); ++i) {
        const gault_parameter& p = *subject.use.model.component->declaration->parameters[i];
        if (p.type == GAULT_REAL && given[i].count > 0 && !matters(subject, i, strain, end))
            idle.push_back(fmt::format("'{}' changes nothing", p.name));
    }
    const bool declared = material.api().instance_states == nullptr;
    std::string figure =
        yields ? fmt::format("it yields in steps of up to {:.2g} %", 100.0 * strain) : "nothing yields";
    for (const auto* list : {&still, &idle})
        for (const std::string& text : *list)
            figure += "; " + text;
    if (!yields && !(still.empty() && idle.empty())) return left_out(figure);
    return judge(still.empty() || !declared, figure);
}

Finding bounds(const Subject& subject) {
    const gault_component& c = *subject.use.model.component->declaration;
    const Material material(subject.use);
    PointBatch own = answered(material, subject.stress, 40);
    const PointBatch before = own;
    int tried = 0, refused = 0;
    const std::vector<gault_value>& given = subject.use.model.parameters.values;
    for (std::size_t i = 0; i < given.size(); ++i) {
        const gault_parameter& p = *c.parameters[i];
        if (given[i].count == 0) continue;
        for (const Trial& trial : trials_of(p, given[i])) {
            const std::string what = fmt::format("'{}' = {:g}", p.name, trial.value.real);
            const MaterialUse use = with_value(subject.use, i, trial.value);
            gault_error error{-1, 0, -1, ""};
            void* self = nullptr;
            const gault_status status =
                c.create(&plugin_host(), use.model.parameters.values.data(), &self, &error);
            ++tried;
            if (status == GAULT_OK) {
                c.destroy(self);
                const std::string wrong = first_steps(Material(use), subject.stress);
                if (!wrong.empty() && trial.allowed) return failed(fmt::format("{}: {}", what, wrong));
            } else if (status == GAULT_INVALID && error.parameter >= 0 &&
                       static_cast<std::size_t>(error.parameter) < given.size() && error.text[0]) {
                ++refused;
            } else {
                return failed(fmt::format(
                    "{}, within its bounds, is answered with status {} and names {}", what, status,
                    error.parameter < 0 || !error.text[0] ? "no parameter or no reason" : "its reason"));
            }
        }
    }
    own.update(1.0);
    for (std::size_t k = 0; k < own.count(); ++k)
        if (!same_bits(outcome(own, k), outcome(before, k)))
            return failed("an instance with other values changes the results of this one");
    return passed(fmt::format("{} values tried, {} refused with a parameter and a reason", tried, refused));
}

} // namespace gault::core::checks
