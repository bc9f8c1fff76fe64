// Runs a program as the scheduler does: at the end of every step, which ends no later than the program's next
// event.
#pragma once
#include "plugin_fixture.hpp"

#include <algorithm>

namespace plugin_test {

class ProgramRun {
  public:
    explicit ProgramRun(const Component& program) : program_(program), signals_(signals_of(program)) {
        for (uint32_t i = 0; i < signals_.control_count; ++i)
            control.push_back(signals_.controls[i].initial);
        for (uint32_t i = 0; i < signals_.memory_count; ++i)
            memory_.push_back(signals_.memories[i].initial);
        measure.resize(signals_.measure_count, std::nan(""));
        record.resize(signals_.record_count, std::nan(""));
    }
    ProgramRun(const ProgramRun&) = delete;

    // Calls the program; the step that begins now is dt() long. GAULT_RETRY, where `repeatable`: take the last step
    // back, put the measures back, and repeat() the call that began it.
    gault_status advance(double wanted_dt) {
        const Call call{index, time, last_dt_, measure, memory_, control};
        const gault_status status = ask(call, wanted_dt, true);
        if (status == GAULT_OK) {
            last_ = call;
            ++index;
        } else {
            memory_ = call.memory;
            control = call.control;
        }
        return status;
    }
    gault_status repeat(double wanted_dt) {
        time = last_.time;
        measure = last_.measure;
        memory_ = last_.memory;
        control = last_.control;
        return ask(last_, wanted_dt, false);
    }
    // What follows from `rows` and their `times`.
    struct Result {
        double value; // NaN where it is absent
        std::string unit, source, note, reason;
    };
    std::map<std::string, Result> evaluate() {
        std::vector<std::vector<double>> columns{times};
        for (std::size_t k = 0; k < record.size(); ++k) {
            columns.emplace_back();
            for (const std::vector<double>& row : rows)
                columns.back().push_back(row[k]);
        }
        std::vector<const double*> pointers;
        for (const std::vector<double>& column : columns)
            pointers.push_back(column.data());
        gault_history history{};
        history.size = sizeof history;
        history.columns = static_cast<uint32_t>(columns.size());
        history.rows = static_cast<int64_t>(times.size());
        history.column = pointers.data();
        std::map<std::string, Result> results;
        gault_report report{};
        report.size = sizeof report;
        report.host = &results;
        report.result = [](void* host, const char* name, const char* unit, double value, const char* source,
                           const char* note) noexcept {
            (*static_cast<decltype(results)*>(host))[name] = {value, unit, source, note, ""};
        };
        report.absent = [](void* host, const char* name, const char* reason, const char* source) noexcept {
            (*static_cast<decltype(results)*>(host))[name] = {std::nan(""), "", source, "", reason};
        };
        const auto& api = program_.api<gault_program_api>();
        if (api.evaluate(program_.self(), &history, &report, &error) != GAULT_OK)
            throw std::runtime_error(error.text);
        return results;
    }
    double dt() const { return last_dt_; }
    void shorten(double part) { last_dt_ *= part; } // what the host does when a step does not converge
    double& measured(const std::string& name) {
        return measure[index_of(signals_.measures, signals_.measure_count, name)];
    }
    double& commanded(const std::string& name) {
        return control[index_of(signals_.controls, signals_.control_count, name)];
    }
    double recorded(const std::vector<double>& row, const std::string& name) const {
        return row[index_of(signals_.records, signals_.record_count, name)];
    }
    double& recorded(std::vector<double>& row, const std::string& name) {
        return row[index_of(signals_.records, signals_.record_count, name)];
    }

    std::vector<double> measure, control, record;
    std::vector<std::vector<double>> rows;
    std::vector<double> times; // of the rows
    double time = 0.0, next = 0.0, suggest = 0.5;
    int64_t index = 0;
    bool done = false, repeatable = false;
    gault_error error{-1, 0, -1, ""};

  private:
    static const gault_program_signals& signals_of(const Component& program) {
        const auto& api = program.api<gault_program_api>();
        return api.instance_signals ? *api.instance_signals(program.self()) : *api.signals;
    }
    static std::size_t index_of(const gault_signal* list, uint32_t count, const std::string& name) {
        for (uint32_t i = 0; i < count; ++i)
            if (name == list[i].name) return i;
        throw std::runtime_error("no signal " + name);
    }
    struct Call {
        int64_t index;
        double time, dt;
        std::vector<double> measure, memory, control; // before it
    };
    gault_status ask(const Call& call, double wanted_dt, bool may_emit) {
        gault_step step{};
        step.size = sizeof step;
        step.index = call.index;
        step.time = call.time;
        step.dt = call.dt;
        step.next_dt = wanted_dt;
        step.measure = measure.data();
        step.control = control.data();
        step.memory = memory_.data();
        step.record = record.data();
        step.final = repeatable ? 0 : 1;
        const gault_status status = program_.api<gault_program_api>().advance(program_.self(), &step, &error);
        suggest = step.suggest;
        if (status != GAULT_OK) return status;
        done = step.done != 0;
        if (step.emit && may_emit) {
            rows.push_back(record);
            times.push_back(time);
        }
        next = step.next;
        last_dt_ = std::min(wanted_dt, next - time);
        return status;
    }
    const Component& program_;
    const gault_program_signals& signals_;
    Call last_;
    std::vector<double> memory_;
    double last_dt_ = 0.0;
};

} // namespace plugin_test
