#include "core/scheduler/simulation.hpp"
#include "core/scheduler/snapshot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gault::core {
namespace {

constexpr double start_share = 0.05;              // of the rows
constexpr std::size_t kinetic_ratio_from_end = 3; // of the columns: see make_columns()

} // namespace

bool Crossing::reached(double now) {
    const double distance = now - target_, before = std::exchange(before_, now) - target_;
    if (done_) return false;
    done_ = std::abs(distance) <= 1e-9 * std::abs(target_) || before * distance < 0.0;
    return done_;
}

Simulation::Simulation(const Scene& scene, int threads)
    : scene_(scene), model_(build_model(scene)), solver_(make_solver(scene, model_, threads)),
      program_(scene, *solver_), columns_(make_columns()),
      frames_(scene.frames.values.begin(), scene.frames.values.end()) {
    check_states(scene, solver_->motion());
}

bool Simulation::records_water() const {
    return scene_.program_surface &&
           std::any_of(scene_.materials.begin(), scene_.materials.end(),
                       [](const MaterialUse& use) { return use.water.has_value(); });
}

std::vector<ColumnInfo> Simulation::make_columns() const {
    std::vector<ColumnInfo> all{{"time", "s", "Time"}};
    all.insert(all.end(), program_.columns().begin(), program_.columns().end());
    if (records_water())
        all.push_back({"excess_pore_pressure", "Pa", "In undrained soil beside the program's surface"});
    all.push_back({"step", "1", "Steps so far"});
    all.push_back({"kinetic_ratio", "1", "Kinetic energy over strain energy"});
    all.push_back({"energy_error", "1", "Imbalance of energy over its largest part"});
    all.push_back({"largest_velocity", "m/s", "Of the grid nodes"});
    for (std::size_t k = 0; k < all.size(); ++k)
        for (std::size_t other = 0; other < k; ++other)
            if (all[k].name == all[other].name)
                throw InputError(
                    scene_.program.parameters.where,
                    fmt::format("program '{}' records '{}', a column that the history has already",
                                scene_.program.component->declaration->name, all[k].name));
    return all;
}

std::vector<double> Simulation::row() {
    const Energies energies = solver_->energies();
    std::vector<double> values{solver_->time()};
    values.insert(values.end(), program_.record().begin(), program_.record().end());
    if (records_water())
        values.push_back(solver_->measure("excess_pore_pressure", *scene_.program_surface).value());
    values.insert(values.end(), {static_cast<double>(solver_->steps()), energies.ratio(), energies.error(),
                                 solver_->largest_velocity()});
    return values;
}

double Simulation::largest_kinetic_ratio(const std::vector<std::vector<double>>& rows) const {
    const std::size_t column = columns_.size() - kinetic_ratio_from_end;
    double largest = 0.0;
    for (auto k = static_cast<std::size_t>(start_share * static_cast<double>(rows.size())); k < rows.size();
         ++k)
        largest = std::max(largest, rows[k][column]);
    return largest;
}

double Simulation::quiet_since(const std::vector<std::vector<double>>& rows, double ratio) const {
    const std::size_t column = columns_.size() - kinetic_ratio_from_end;
    const auto last = std::find_if(rows.rbegin(), rows.rend(),
                                   [&](const std::vector<double>& row) { return row[column] > ratio; });
    return last == rows.rend() ? 0.0 : (*last)[0];
}

// The record of the program's last call; `since` shifts the time to that of the call before.
double Simulation::measured(const std::string& name, double since) const {
    if (name == "time") return solver_->time() + since;
    return program_.record()[program_.column(name).value()];
}

// Ends exactly at the next event, without a last crumb of a step; where steps are long, at the next frame
// too.
double Simulation::step_length() {
    const double allowed = solver_->allowed_step();
    double left = answer_.next - solver_->time();
    if (solver_->repeatable() && frame_rate_ != 0.0)
        for (const Crossing& frame : frames_) {
            const double ahead = (frame.target() - measured(scene_.frames.measure)) / frame_rate_;
            if (!frame.done() && ahead > 1e-6 * allowed) left = std::min(left, ahead);
        }
    if (left <= 0.0 || left > 2.0 * allowed) return allowed;
    return left > allowed ? 0.5 * left : left;
}

// The share of the last step after which a frame was due, 1 if none was passed.
double Simulation::share_to_frame(double before) const {
    double share = 1.0;
    for (const Crossing& frame : frames_) {
        const double now = measured(scene_.frames.measure), target = frame.target();
        if (frame.done() || (before - target) * (now - target) >= 0.0) continue;
        if (std::abs(now - target) > 1e-7 * std::abs(target))
            share = std::min(share, (target - before) / (now - before));
    }
    return share > 1e-6 ? share : 1.0;
}

void Simulation::start() {
    announced_ = solver_->allowed_step();
    answer_ = program_.advance(0.0, announced_);
}

// Asks the program again how to begin a step of this length at most.
void Simulation::repeat(double dt) {
    announced_ = dt;
    answer_ = program_.repeat(dt);
}

Simulation::Moved Simulation::step() {
    const double dt = step_length();
    // What the program commands is for the end of the step that was announced.
    if (solver_->repeatable() && dt < std::min(announced_, answer_.next - solver_->time()) * (1.0 - 1e-12))
        repeat(dt);
    if (!solver_->step(dt)) {
        repeat(solver_->allowed_step());
        return Moved::no;
    }
    const bool watch = solver_->repeatable() && !frames_.empty();
    const double before = watch ? measured(scene_.frames.measure, -dt) : 0.0;
    announced_ = solver_->allowed_step();
    answer_ = program_.advance(dt, announced_);
    if (!answer_.repeat && watch) {
        frame_rate_ = (measured(scene_.frames.measure) - before) / dt;
        answer_.fraction = share_to_frame(before);
        answer_.repeat = answer_.fraction < 1.0;
        if (answer_.repeat) program_.withdraw();
    }
    if (!answer_.repeat) return Moved::yes;
    solver_->undo(answer_.fraction);
    repeat(solver_->allowed_step());
    return Moved::no;
}

} // namespace gault::core
