#include "apps/command.hpp"
#include "core/base/log.hpp"
#include "core/laboratory/element_results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <memory>

namespace gault::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t batch = 512; // points, of a throughput

struct Arguments {
    SceneArguments test;
    std::string output;
    bool force = false, quiet = false, no_figure = false;
};

// A replayed call answers at once, and writes nothing.
int print_replay(const core::ElementTest& test) {
    const core::Material soil(test.material);
    fmt::print("{}\n{:>10}  {:<8} stress xx yy zz xy yz zx (Pa, tension positive), states, or the reason\n",
               test.title, "increment", "answer");
    for (const core::ReplayAnswer& answer : core::replay(test)) {
        const char* status[] = {"OK", "RETRY", "INVALID", "FAILED"};
        const auto& failure = answer.failure;
        fmt::print("{:>8.4g} %  {:<8} ", 100.0 * answer.fraction, status[std::min(failure.status, 3u)]);
        if (failure.status == GAULT_OK) {
            fmt::print("{:.6g}", fmt::join(answer.stress, " "));
            for (const core::StateInfo& info : soil.states())
                for (int k = 0; k < static_cast<int>(info.declared.shape); ++k)
                    fmt::print("{} {:.6g}", k ? "" : fmt::format("; {}", info.declared.name),
                               answer.state[static_cast<std::size_t>(info.first + k)]);
        } else if (failure.status == GAULT_RETRY) {
            fmt::print("asks for {:.3g} of it", failure.fraction);
        } else {
            fmt::print("{}", failure.text);
        }
        fmt::print("\n");
    }
    return 0;
}

void draw(const core::ElementTest& test, const fs::path& folder, bool over_time) {
    std::vector<std::string> words = {(folder / "history.csv").string(), "--title=" + test.title,
                                      "--output=" + (folder / "element.png").string()};
    if (over_time) words.emplace_back("--time");
    run_script("element.py", words, folder);
}

int element(const Arguments& arguments, const std::string& command_line) {
    const LoadedElementTest loaded(arguments.test);
    const core::ElementTest& test = *loaded;
    if (test.replay) return print_replay(test);
    const fs::path folder =
        arguments.output.empty() ? fs::path("out") / test.file.stem() : fs::path(arguments.output);
    core::ElementRun run(test);
    core::ElementResults results(folder, arguments.force, run.columns());
    core::ElementResults::End end{"", std::string("gault ") + GAULT_VERSION, command_line, 0.0, {}};
    const auto start = std::chrono::steady_clock::now();
    const auto conclude = [&] {
        results.finish(test, run, end);
        if (!arguments.no_figure) draw(test, folder, run.point().material().rate_dependent());
    };
    const auto stop_the_clock = [&] {
        end.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    try {
        run.go([&](const std::vector<double>& row) { results.row(row); });
    } catch (const core::RunError& error) {
        stop_the_clock();
        end.message = error.what();
        conclude();
        throw;
    }
    stop_the_clock();
    end.seconds_per_update = core::seconds_per_update(run.point(), batch);
    conclude();
    if (arguments.quiet) return 0;
    core::log::info("{} stages, {} steps, {} iterations", test.stages.size(), run.steps(), run.iterations());
    if (end.seconds_per_update)
        core::log::info(
            "the soil alone: {:.1f} ns a point, {:.1f} M points/s on one thread (the last step, by "
            "{} points at once)",
            1e9 * *end.seconds_per_update, 1e-6 / *end.seconds_per_update, batch);
    core::log::info("results in {}", folder.string());
    return 0;
}

} // namespace

Action declare_element(CLI::App& options) {
    const auto arguments = std::make_shared<Arguments>();
    arguments->test.declare(options, "test");
    options.add_option("-o,--output", arguments->output, "Folder of the results (default: out/NAME_OF_TEST)")
        ->type_name("FOLDER");
    options.add_flag("--force", arguments->force, "Replaces the results that the folder holds");
    options.add_flag("--no-figure", arguments->no_figure, "Draws nothing");
    options.add_flag("-q,--quiet", arguments->quiet, "No closing lines");
    options.footer(
        "Takes one material point through laboratory tests (isotropic, triaxial, oedometer, plane_strain, "
        "simple_shear,\ntrue_triaxial, mixed; cycles) and writes history.csv, summary.json and element.png; "
        "docs/element.md has every key.\nA failed_point.yaml that a run left behind is asked again.\n\n"
        "Examples:\n"
        "  gault element configs/element/sand_triaxial.yaml\n"
        "  gault element my_test.yaml --set material.friction_angle='40 deg' --plugin-path build/my_soil.so\n"
        "  gault element out/my_scene/failed_point.yaml");
    return [arguments](const std::string& command_line) { return element(*arguments, command_line); };
}

} // namespace gault::app
