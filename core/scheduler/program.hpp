// Runs a loading program: measures in, controls out to the boundaries that listen, rows of the history.
#pragma once
#include "core/output/results.hpp"
#include "core/registry/instance.hpp"
#include "core/solver/explicit.hpp"

#include <optional>
#include <string>
#include <vector>

namespace gault::core {

// InputError unless the host offers the measure `name` to `owner`.
void check_measure(const Location& where, const char* owner, const std::string& name, bool has_surface);

class Program {
  public:
    // Throws InputError when a measure is unknown or nobody listens to a control.
    Program(const Scene& scene, ExplicitSolver& solver);

    struct Answer {
        bool done, emit;
        double next; // time of the next event, s; infinity if none
    };
    Answer advance(double dt, double next_dt);

    const std::vector<ColumnInfo>& columns() const { return columns_; } // of its records
    const std::vector<double>& record() const { return record_; }
    std::optional<int> column(const std::string& name) const;

  private:
    struct Control {
        std::string name;
        std::vector<double*> listeners;
    };
    void bind(const Scene& scene, const gault_program_signals& signals);

    Instance instance_;
    ExplicitSolver& solver_;
    Location where_;
    std::optional<int> side_;
    std::vector<std::string> measures_;
    std::vector<Control> controls_;
    std::vector<double> measure_, control_, memory_, record_;
    std::vector<ColumnInfo> columns_;
};

} // namespace gault::core
