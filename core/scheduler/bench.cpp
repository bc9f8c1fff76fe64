#include "core/scheduler/bench.hpp"
#include "core/scheduler/simulation.hpp"
#include "core/scheduler/verification.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gault::core {
namespace {

std::vector<double> first_state(const Motion& motion) {
    std::vector<double> values;
    for (const Points& points : motion.points())
        if (!points.columns().state.empty())
            points.each_point([&](std::size_t slot) {
                const std::size_t id = points.identity(slot);
                if (values.size() <= id) values.resize(id + 1);
                values[id] = points.columns().state[0][slot];
            });
    return values;
}

double changed(const std::vector<double>& before, const std::vector<double>& after, std::size_t points) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < after.size(); ++i)
        n += after[i] != before[i];
    return static_cast<double>(n) / static_cast<double>(points);
}

double column_bytes(const Motion& motion) {
    double bytes = 0.0;
    for (const Points& points : motion.points()) {
        points.columns().each(
            [&](const Column& c) { bytes += static_cast<double>(c.size() * sizeof(double)); });
        bytes += static_cast<double>(points.slots() * sizeof(uint32_t));
    }
    return bytes / static_cast<double>(motion.point_count());
}

std::vector<BenchReport::Phase> phases(const PhaseClock& clock, double seconds) {
    const double known = clock.strain + clock.material + clock.force + clock.velocity + clock.sort;
    std::vector<BenchReport::Phase> all{{"strain", clock.strain}, {"material", clock.material},
                                        {"force", clock.force},   {"velocity", clock.velocity},
                                        {"sort", clock.sort},     {"grid and boundaries", seconds - known}};
    for (auto& phase : all)
        phase.share /= seconds;
    return all;
}

struct Timed { // steps: all of them, until the last part of the program's time begins
    int64_t first = 0;
    std::vector<double> before; // first state of the points then
    std::chrono::steady_clock::time_point start;

    void begin(Solver& solver) {
        first = solver.steps();
        before = first_state(solver.motion());
        solver.motion().clock() = {};
        solver.motion().clock().on = true;
        start = std::chrono::steady_clock::now();
    }
};

} // namespace

BenchReport bench_scene(const Scene& scene, int threads, double share) {
    Simulation simulation(scene, threads);
    Solver& solver = simulation.solver();
    const Verification verification(scene, simulation.columns());
    std::vector<std::vector<double>> rows;

    BenchReport report{};
    report.points = simulation.points();
    report.curve_error = std::numeric_limits<double>::quiet_NaN();
    Timed timed;
    simulation.start();
    rows.push_back(simulation.row());
    timed.begin(solver);
    bool last_part = false;
    while (!simulation.done()) {
        if (!last_part && solver.time() >= (1.0 - share) * simulation.next_event()) {
            timed.begin(solver);
            last_part = true;
        }
        if (simulation.step() == Simulation::Moved::yes && simulation.row_due())
            rows.push_back(simulation.row());
    }
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - timed.start).count();
    report.steps = solver.steps() - timed.first;
    report.point_steps =
        static_cast<double>(report.steps) * static_cast<double>(report.points) / report.seconds;
    report.changing = changed(timed.before, first_state(solver.motion()), report.points);
    report.phases = phases(solver.motion().clock(), report.seconds);
    report.bytes_per_point = column_bytes(solver.motion());
    const nlohmann::json errors = verification.finish(rows);
    if (errors.contains("curves"))
        report.curve_error = errors["curves"][0].value("largest_relative_error", report.curve_error);
    return report;
}

double peak_memory(const Scene& scene) {
    const pid_t child = fork();
    if (child == 0) {
        try {
            Simulation simulation(scene, 1);
            simulation.start();
            for (int i = 0; i < 3; ++i)
                simulation.step();
        } catch (...) {
            _exit(1);
        }
        _exit(0);
    }
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    if (child < 0 || status != 0) throw RunError("the process that measures memory did not finish");
    return static_cast<double>(usage.ru_maxrss) * 1024.0;
}

} // namespace gault::core
