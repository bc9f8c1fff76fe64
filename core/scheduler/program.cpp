#include "core/scheduler/program.hpp"
#include "core/base/suggest.hpp"
#include "core/registry/answer.hpp"
#include "core/registry/declared.hpp"
#include "core/registry/module_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gault::core {
namespace {

// Takes what a program reports. What is wrong is remembered: nothing may be thrown through the program.
class Reported {
  public:
    gault_report report() {
        gault_report r{};
        r.size = sizeof r;
        r.host = this;
        r.result = [](void* host, const char* name, const char* unit, double value, const char* source,
                      const char* note) noexcept {
            nlohmann::json j = {{"source", text(source)}};
            if (std::isfinite(value))
                j.update({{"value", value}, {"unit", text(unit)}, {"note", text(note)}});
            else
                j["absent"] = "not a finite number";
            static_cast<Reported*>(host)->take(name, std::move(j));
        };
        r.absent = [](void* host, const char* name, const char* reason, const char* source) noexcept {
            static_cast<Reported*>(host)->take(name, {{"absent", text(reason)}, {"source", text(source)}});
        };
        return r;
    }
    const nlohmann::json& all() const { return all_; }
    const std::string& wrong() const { return wrong_; }

  private:
    static std::string text(const char* words) { return plain_text(words, 4096); }
    void take(const char* name, nlohmann::json result) noexcept try {
        check_name(name, "a result");
        check_that(!all_.contains(name), fmt::format("result '{}'", name), "is reported twice");
        all_[name] = std::move(result);
    } catch (const std::exception& error) {
        wrong_ = error.what();
    }

    nlohmann::json all_ = nlohmann::json::object();
    std::string wrong_;
};

} // namespace

void check_measure(const Location& where, const char* owner, const std::string& name, bool has_surface) {
    const auto& known = Solver::measure_names();
    if (std::find(known.begin(), known.end(), name) == known.end())
        throw InputError(where,
                         fmt::format("'{}' asks for the measure '{}', which this host does not offer{}",
                                     owner, name, suggestion(name, known)));
    if (Solver::measures_surface(name) && !has_surface)
        throw InputError(
            where, fmt::format("'{}' measures '{}' of a surface: say which one with `on:`", owner, name));
}

Program::Program(const Scene& scene, Solver& solver)
    : instance_(*scene.program.component, scene.program.parameters), solver_(solver),
      where_(scene.program.parameters.where), surface_(scene.program_surface) {
    if (scene.program_gauge)
        gauge_ = Surface::at(solver.motion(), solver.boundaries().surface(surface_.value()).side(),
                             *scene.program_gauge);
    const gault_program_signals& signals = program_signals(instance_);
    for (uint32_t k = 0; k < signals.measure_count; ++k) {
        measures_.emplace_back(signals.measures[k].name);
        check_measure(where_, instance_.declaration().name, measures_.back(), surface_.has_value());
    }
    for (uint32_t k = 0; k < signals.memory_count; ++k)
        memory_.push_back(signals.memories[k].initial);
    for (uint32_t k = 0; k < signals.record_count; ++k) {
        record_.push_back(signals.records[k].initial);
        columns_.push_back({signals.records[k].name, signals.records[k].unit, signals.records[k].doc});
    }
    measure_.resize(measures_.size());
    bind(scene, signals);
}

void Program::bind(const Scene& scene, const gault_program_signals& signals) {
    for (uint32_t k = 0; k < signals.control_count; ++k) {
        const gault_signal& signal = signals.controls[k];
        std::string unit;
        Control control{signal.name, solver_.boundaries().listeners(signal.name, surface_, unit)};
        const std::string place =
            surface_ ? fmt::format("on '{}'", scene.surfaces[static_cast<std::size_t>(*surface_)].name)
                     : "in the scene";
        const bool needs_listener = !(signal.flags & GAULT_SIGNAL_OPTIONAL);
        if (control.listeners.empty() && needs_listener) {
            const auto names = solver_.boundaries().control_names(surface_);
            throw InputError(where_,
                             fmt::format("program '{}' commands '{}', but no boundary {} listens to it{}",
                                         instance_.declaration().name, signal.name, place,
                                         names.empty() ? "; none there listens to a program"
                                                       : suggestion(signal.name, names)));
        }
        if (!control.listeners.empty() && unit != signal.unit)
            throw InputError(
                where_, fmt::format("program '{}' commands '{}' in {}, the boundary {} expects {}",
                                    instance_.declaration().name, signal.name, signal.unit, place, unit));
        control_.push_back(signal.initial);
        for (double* listener : control.listeners)
            *listener = signal.initial;
        controls_.push_back(std::move(control));
    }
}

Program::Answer Program::advance(double dt, double next_dt) {
    const Call call{solver_.steps(), dt, memory_, control_};
    const Answer answer = ask(call, next_dt);
    if (answer.repeat) {
        memory_ = call.memory;
        control_ = call.control;
    } else {
        before_last_ = std::exchange(last_, call);
    }
    return answer;
}

Program::Answer Program::repeat(double next_dt) {
    memory_ = last_.memory;
    control_ = last_.control;
    return ask(last_, next_dt);
}

Program::Answer Program::ask(const Call& call, double next_dt) {
    for (std::size_t k = 0; k < measures_.size(); ++k)
        measure_[k] =
            solver_.measure(measures_[k], surface_.value_or(0), gauge_ ? &*gauge_ : nullptr).value();
    gault_step step{};
    step.size = sizeof step;
    step.index = call.index;
    step.time = solver_.time();
    step.dt = call.dt;
    step.next_dt = next_dt;
    step.measure = measure_.data();
    step.control = control_.data();
    step.memory = memory_.data();
    step.record = record_.data();
    step.final = solver_.repeatable() ? 0 : 1;
    step.next = std::numeric_limits<double>::infinity();
    step.suggest = 0.5;
    gault_error error{-1, 0, -1, ""};
    const gault_status status = instance_.api<gault_program_api>().advance(instance_.self(), &step, &error);
    if (status == GAULT_RETRY && solver_.repeatable())
        return {false, false, step.next, true, step_fraction(step.suggest, 1e-3, 0.999)};
    if (status != GAULT_OK)
        throw RunError(fmt::format(
            "program '{}': {}{}", instance_.declaration().name, error_text(error),
            status == GAULT_RETRY ? " (it asked to repeat a step, which an explicit solver cannot)" : ""));
    for (std::size_t k = 0; k < controls_.size(); ++k)
        for (double* listener : controls_[k].listeners)
            *listener = control_[k];
    return {step.done != 0, step.emit != 0, step.next};
}

nlohmann::json Program::evaluate(const std::vector<std::vector<double>>& rows) const {
    const auto& api = instance_.api<gault_program_api>();
    if (!api.evaluate) return nlohmann::json::object();
    std::vector<std::vector<double>> columns(1 + columns_.size());
    std::vector<const double*> pointers;
    for (std::size_t k = 0; k < columns.size(); ++k) {
        for (const std::vector<double>& row : rows)
            columns[k].push_back(row[k]);
        pointers.push_back(columns[k].data());
    }
    gault_history history{};
    history.size = sizeof history;
    history.columns = static_cast<uint32_t>(columns.size());
    history.rows = static_cast<int64_t>(rows.size());
    history.column = pointers.data();
    Reported reported;
    gault_report report = reported.report();
    gault_error error{-1, 0, -1, ""};
    const gault_status status = api.evaluate(instance_.self(), &history, &report, &error);
    const std::string wrong = status != GAULT_OK ? error_text(error) : reported.wrong();
    if (status != GAULT_OK || !wrong.empty())
        throw RunError(fmt::format("program '{}': results: {}", instance_.declaration().name,
                                   wrong.empty() ? "no reason was given" : wrong));
    return reported.all();
}

std::optional<int> Program::column(const std::string& name) const {
    for (std::size_t k = 0; k < columns_.size(); ++k)
        if (columns_[k].name == name) return static_cast<int>(k);
    return std::nullopt;
}

} // namespace gault::core
