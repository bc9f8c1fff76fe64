#include "apps/command.hpp"
#include "core/scheduler/bench.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace gault::app {
namespace {

struct Arguments {
    SceneArguments scene;
    std::vector<int> threads{1, 2};
    double share = 0.25;
    bool memory = false;
};

void print(const core::BenchReport& report, int threads) {
    fmt::print("{} thread{}: {:.1f} M point-steps/s  ({} points, {} steps, {:.3g} s)\n", threads, threads > 1 ? "s" : "",
               report.point_steps * 1e-6, report.points, report.steps, report.seconds);
    fmt::print("  points whose state changed {:.1f} %", 100.0 * report.changing);
    if (std::isfinite(report.curve_error)) fmt::print(", largest error against the reference curve {:.2f} %", 100.0 * report.curve_error);
    fmt::print(", columns {:.0f} bytes a point\n  time of the first thread:", report.bytes_per_point);
    for (const auto& phase : report.phases)
        if (phase.share > 0.0) fmt::print("  {} {:.0f} %", phase.name, 100.0 * phase.share);
    fmt::print("\n");
}

int bench(const Arguments& arguments) {
    const auto changes = arguments.scene.overrides();
    const core::Registry registry(
        core::plugin_search_path(core::scene_plugins(arguments.scene.file, changes), arguments.scene.plugin_path));
    const core::Scene scene = core::read_scene(arguments.scene.file, changes, registry);
    if (arguments.memory) {
        auto larger = changes;
        larger.push_back({"grid.cells", fmt::format("[{}, {}]", scene.axes[0].cells, 10 * scene.axes[1].cells)});
        const core::Scene big = core::read_scene(arguments.scene.file, larger, registry);
        const auto points = [](const core::Scene& s) {
            return static_cast<double>(s.axes[0].cells) * s.axes[1].cells * s.points_per_cell;
        };
        const double small_bytes = core::peak_memory(scene), big_bytes = core::peak_memory(big);
        fmt::print("peak memory {:.1f} MB with {:.0f} points, {:.1f} MB with {:.0f}: {:.0f} bytes a point\n", small_bytes * 1e-6,
                   points(scene), big_bytes * 1e-6, points(big), (big_bytes - small_bytes) / (points(big) - points(scene)));
        return 0;
    }
    std::vector<double> speeds;
    for (const int threads : arguments.threads) {
        const core::BenchReport report = core::bench_scene(scene, threads, arguments.share);
        print(report, threads);
        speeds.push_back(report.point_steps);
        if (speeds.size() > 1) fmt::print("  {:.2f} times as fast as {} thread(s)\n", speeds.back() / speeds.front(), arguments.threads[0]);
    }
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
    options.add_option("--share", arguments->share, "The last part of the program's time that is timed")
        ->check(CLI::Range(0.001, 1.0))
        ->capture_default_str();
    options.add_flag("--memory", arguments->memory,
                     "Instead: peak memory of a few steps with the scene's rows of cells and with ten times as many");
    options.footer("Runs the code that `run` runs, without results, and prints point-steps a second, the share of each phase and\n"
                   "bytes a point.\n\n"
                   "Examples:\n"
                   "  gault bench configs/bench/rows.yaml\n"
                   "  gault bench configs/bench/rows.yaml -j 1 --set model.frame=updated\n"
                   "  gault bench configs/bench/rows.yaml --memory");
    return [arguments](const std::string&) { return bench(*arguments); };
}

} // namespace gault::app
