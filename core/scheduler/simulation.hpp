// A scene in motion: program -> controls -> boundaries -> step -> measures. What is written of it is the
// business of others.
#pragma once
#include "core/config/scene.hpp"
#include "core/scheduler/crossing.hpp"
#include "core/scheduler/program.hpp"
#include "core/solver/solver.hpp"

#include <memory>
#include <string>
#include <vector>

namespace gault::core {

class Simulation {
  public:
    // Throws InputError. The scene must live as long.
    Simulation(const Scene& scene, int threads);

    // Asks the program for the first time.
    void start();
    // Makes one step, or none where it has to be repeated with another length. Throws RunError.
    enum class Moved { no, yes };
    Moved step();
    bool done() const { return answer_.done; }
    bool row_due() const { return answer_.emit; } // the program wants the state that is now to be recorded
    double next_event() const { return answer_.next; }

    // A row of the history: time, the program's records, and what the host adds.
    const std::vector<ColumnInfo>& columns() const { return columns_; }
    std::vector<double> row();
    // Of the rows after the first 5 % of them, in which no load sets in gently. (Of the time: a hold would be most of it.)
    double largest_kinetic_ratio(const std::vector<std::vector<double>>& rows) const;
    // The time of the last of all rows whose kinetic ratio is above this; s. 0: none is.
    double quiet_since(const std::vector<std::vector<double>>& rows, double ratio) const;
    double measured(const std::string& name) const { return measured(name, 0.0); } // "time" or a record

    std::size_t points() const { return solver_->motion().point_count(); }
    const Scene& scene() const { return scene_; }
    Model& model() { return model_; }
    Solver& solver() { return *solver_; }
    Program& program() { return program_; }
    std::vector<Crossing>& frames() {
        return frames_;
    } // values of the scene's frame measure that are awaited

  private:
    std::vector<ColumnInfo> make_columns() const;
    bool records_water() const;
    double step_length();
    double share_to_frame(double before) const;
    double measured(const std::string& name, double since) const;
    void repeat(double dt);

    const Scene& scene_;
    Model model_;
    std::unique_ptr<Solver> solver_;
    Program program_;
    std::vector<ColumnInfo> columns_;
    std::vector<Crossing> frames_;
    double frame_rate_ = 0.0; // of the measure that frames wait for, a second
    double announced_ = 0.0;  // length of the coming step that the program was told, s
    Program::Answer answer_{};
};

} // namespace gault::core
