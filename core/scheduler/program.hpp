// Runs a loading program: measures in, controls out to the boundaries that listen, rows of the history.
#pragma once
#include "core/output/results.hpp"
#include "core/registry/instance.hpp"
#include "core/solver/solver.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gault::core {

// InputError unless the host offers the measure `name` to `owner`.
void check_measure(const Location& where, const char* owner, const std::string& name, bool has_surface);

class Program {
  public:
    // Throws InputError when a measure is unknown or nobody listens to a control.
    Program(const Scene& scene, Solver& solver);

    struct Answer {
        bool done, emit;
        double next;           // time of the next event, s; infinity if none
        bool repeat = false;   // an event was overshot: repeat the step
        double fraction = 1.0; // of its length
    };
    // At the end of a step of length dt, before one of next_dt. Where the answer is `repeat`, undo the step
    // and call repeat().
    Answer advance(double dt, double next_dt);
    // Asks once more at the start of a step that is repeated with another length. `emit` was answered before.
    Answer repeat(double next_dt);
    void withdraw() { last_ = before_last_; } // the step that the last advance() ended is taken back

    // What follows from the rows of a finished run, which begin with time and the records: for every name
    // {value, unit, source, note} or {absent, source}. RunError where the program fails or reports nonsense.
    nlohmann::json evaluate(const std::vector<std::vector<double>>& rows) const;

    const std::vector<ColumnInfo>& columns() const { return columns_; } // of its records
    const std::vector<double>& record() const { return record_; }
    std::optional<int> column(const std::string& name) const;

  private:
    struct Control {
        std::string name;
        std::vector<double*> listeners;
    };
    struct Call { // that began a step
        int64_t index = 0;
        double dt = 0.0;
        std::vector<double> memory, control; // before it
    };
    Answer ask(const Call& call, double next_dt);
    void bind(const Scene& scene, const gault_program_signals& signals);

    Instance instance_;
    Solver& solver_;
    Location where_;
    std::optional<int> surface_;
    std::optional<Surface> gauge_;
    std::vector<std::string> measures_;
    std::vector<Control> controls_;
    std::vector<double> measure_, control_, memory_, record_;
    std::vector<ColumnInfo> columns_;
    Call last_, before_last_;
};

} // namespace gault::core
