#include "core/scheduler/bench.hpp"
#include "core/scheduler/program.hpp"
#include "core/scheduler/verification.hpp"
#include "core/solver/explicit.hpp"

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

} // namespace

BenchReport bench_scene(const Scene& scene, int threads, double share) {
    Model model = build_model(scene);
    ExplicitSolver solver(scene, model, threads);
    Program program(scene, solver);
    std::vector<ColumnInfo> columns{{"time", "s", "Time"}};
    columns.insert(columns.end(), program.columns().begin(), program.columns().end());
    const Verification verification(scene, columns);
    std::vector<std::vector<double>> rows;
    const auto row = [&] {
        rows.push_back({solver.time()});
        rows.back().insert(rows.back().end(), program.record().begin(), program.record().end());
    };

    BenchReport report{};
    report.points = solver.motion().point_count();
    report.curve_error = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> before;
    std::chrono::steady_clock::time_point start;
    int64_t first = -1;
    Program::Answer answer = program.advance(0.0, solver.allowed_step());
    row();
    while (!answer.done) {
        if (first < 0 && solver.time() >= (1.0 - share) * answer.next) {
            first = solver.steps();
            before = first_state(solver.motion());
            solver.motion().clock() = {};
            solver.motion().clock().on = true;
            start = std::chrono::steady_clock::now();
        }
        const double dt = std::min(solver.allowed_step(), answer.next - solver.time());
        solver.step(dt);
        answer = program.advance(dt, solver.allowed_step());
        if (answer.emit) row();
    }
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    report.steps = solver.steps() - first;
    report.point_steps =
        static_cast<double>(report.steps) * static_cast<double>(report.points) / report.seconds;
    report.changing = changed(before, first_state(solver.motion()), report.points);
    const PhaseClock& clock = solver.motion().clock();
    const double known = clock.strain + clock.material + clock.force + clock.velocity + clock.sort;
    report.phases = {{"strain", clock.strain}, {"material", clock.material},
                     {"force", clock.force},   {"velocity", clock.velocity},
                     {"sort", clock.sort},     {"grid and boundaries", report.seconds - known}};
    for (auto& phase : report.phases)
        phase.share /= report.seconds;
    report.bytes_per_point = column_bytes(solver.motion());
    const nlohmann::json errors = verification.finish(rows);
    if (errors.contains("curves")) report.curve_error = errors["curves"][0]["largest_relative_error"];
    return report;
}

double peak_memory(const Scene& scene) {
    const pid_t child = fork();
    if (child == 0) {
        try {
            Model model = build_model(scene);
            ExplicitSolver solver(scene, model, 1);
            Program program(scene, solver);
            program.advance(0.0, solver.allowed_step());
            for (int i = 0; i < 3; ++i) {
                const double dt = solver.allowed_step();
                solver.step(dt);
                program.advance(dt, dt);
            }
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
