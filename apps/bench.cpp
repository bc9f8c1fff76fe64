#include "core/scheduler/bench.hpp"
#include "apps/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace gault::app {
namespace {

struct Arguments {
    SceneArguments scene;
    std::vector<int> threads{1, 2};
    int repeat = 3;
    double share = 0.25;
    bool memory = false;
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

// All runs with one number of threads; the run of median speed stands for them.
void print(std::vector<core::BenchReport> runs, int threads) {
    std::sort(runs.begin(), runs.end(),
              [](const auto& a, const auto& b) { return a.point_steps < b.point_steps; });
    const core::BenchReport& middle = runs[runs.size() / 2];
    fmt::print("{} thread{}: {:.1f} M point-steps/s, {:.1f} to {:.1f} in {} run{}  ({} points, {} steps, "
               "{:.3g} s)\n",
               threads, threads > 1 ? "s" : "", middle.point_steps * 1e-6, runs.front().point_steps * 1e-6,
               runs.back().point_steps * 1e-6, runs.size(), runs.size() > 1 ? "s" : "", middle.points,
               middle.steps, middle.seconds);
    fmt::print("  points whose state changed {:.1f} %", 100.0 * middle.changing);
    if (std::isfinite(middle.curve_error))
        fmt::print(", largest error against the reference curve {:.2f} %", 100.0 * middle.curve_error);
    fmt::print(", columns {:.0f} bytes a point\n  time of the first thread:", middle.bytes_per_point);
    for (const auto& phase : middle.phases)
        if (phase.share > 0.0) fmt::print("  {} {:.0f} %", phase.name, 100.0 * phase.share);
    fmt::print("\n");
}

// The numbers of threads take turns, so that a machine whose speed drifts gives all of them the same share.
void throughput(const core::Scene& scene, const Arguments& arguments) {
    std::vector<std::vector<core::BenchReport>> runs(arguments.threads.size());
    for (int turn = 0; turn < arguments.repeat; ++turn)
        for (std::size_t t = 0; t < runs.size(); ++t)
            runs[t].push_back(core::bench_scene(scene, arguments.threads[t], arguments.share));
    for (std::size_t t = 0; t < runs.size(); ++t) {
        print(runs[t], arguments.threads[t]);
        if (t == 0) continue;
        std::vector<double> ratios;
        for (int turn = 0; turn < arguments.repeat; ++turn)
            ratios.push_back(runs[t][turn].point_steps / runs[0][turn].point_steps);
        const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
        fmt::print("  {:.2f} times as fast as {} thread(s), {:.2f} to {:.2f}\n", median(ratios),
                   arguments.threads[0], *least, *most);
    }
}

// From the difference of two sizes, so that what every process has does not count.
void memory(const core::Scene& scene, const SceneArguments& arguments) {
    const LoadedScene larger(
        arguments, {{"grid.cells", fmt::format("[{}, {}]", scene.axes[0].cells, 10 * scene.axes[1].cells)}});
    const auto points = [](const core::Scene& s) {
        return static_cast<double>(s.axes[0].cells) * s.axes[1].cells * s.points_per_cell;
    };
    const double bytes = core::peak_memory(scene), more_bytes = core::peak_memory(*larger);
    fmt::print("peak memory {:.1f} MB with {:.0f} points, {:.1f} MB with {:.0f}: {:.0f} bytes a point\n",
               bytes * 1e-6, points(scene), more_bytes * 1e-6, points(*larger),
               (more_bytes - bytes) / (points(*larger) - points(scene)));
}

int bench(const Arguments& arguments) {
    const LoadedScene scene(arguments.scene);
    if (arguments.memory)
        memory(*scene, arguments.scene);
    else
        throughput(*scene, arguments);
    return 0;
}

} // namespace

Action declare_bench(CLI::App& options) {
    const auto arguments = std::make_shared<Arguments>();
    arguments->scene.declare(options);
    options.add_option("-j,--threads", arguments->threads, "Numbers of threads, one run each")
        ->delimiter(',')
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    options.add_option("--repeat", arguments->repeat, "Runs with each number of threads, taking turns")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    options.add_option("--share", arguments->share, "The last part of the program's time that is timed")
        ->check(CLI::Range(0.001, 1.0))
        ->capture_default_str();
    options.add_flag(
        "--memory", arguments->memory,
        "Instead: peak memory of a few steps with the scene's rows of cells and with ten times as many");
    options.footer(
        "Runs the code that `run` runs, without results, and prints point-steps a second (the median\n"
        "run, and the range), the share of each phase and bytes a point.\n\n"
        "Examples:\n"
        "  gault bench configs/bench/rows.yaml\n"
        "  gault bench configs/bench/rows.yaml -j 1 --set model.frame=updated\n"
        "  gault bench configs/bench/rows.yaml --memory");
    return [arguments](const std::string&) { return bench(*arguments); };
}

} // namespace gault::app
