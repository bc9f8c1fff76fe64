#include "apps/command.hpp"
#include "core/base/log.hpp"
#include "core/laboratory/element_test.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/history.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

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

nlohmann::json provenance(const core::ElementTest& test, const std::string& command_line) {
    const core::Component& soil = *test.material.model.component;
    return {{"program", std::string("gault ") + GAULT_VERSION},
            {"command", command_line},
            {"test", fs::absolute(test.file).string()},
            {"test_sha256", core::sha256_of_file(test.file)},
            {"soil", soil.declaration->name},
            {"version", soil.declaration->version},
            {"file", soil.file.string()},
            {"sha256", core::sha256_of_file(soil.file)}};
}

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

int element(const Arguments& arguments, const std::string& command_line) {
    const LoadedElementTest loaded(arguments.test);
    const core::ElementTest& test = *loaded;
    if (test.replay) return print_replay(test);
    const fs::path folder =
        arguments.output.empty() ? fs::path("out") / test.file.stem() : fs::path(arguments.output);
    if (!arguments.force && fs::exists(folder / "summary.json"))
        throw core::InputError(fmt::format("'{}' holds results; --force replaces them", folder.string()));
    core::ElementRun run(test);
    fs::create_directories(folder);
    core::HistoryFile history(folder / "history.csv", run.columns());
    nlohmann::json summary = {{"status", "done"},
                              {"title", test.title},
                              {"provenance", provenance(test, command_line)},
                              {"test", test.yaml}};
    const auto start = std::chrono::steady_clock::now();
    const auto conclude = [&] {
        history.sync();
        summary["counts"] = {{"stages", test.stages.size()},
                             {"steps", run.steps()},
                             {"newton_iterations", run.iterations()},
                             {"constitutive_updates", run.point().updates()}};
        summary["wall_seconds"] =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        core::write_atomically(folder / "summary.json", summary.dump(2) + "\n");
        if (!arguments.no_figure)
            run_script("element.py",
                       {(folder / "history.csv").string(), "-t", test.title, "-o",
                        (folder / "element.png").string()},
                       folder);
    };
    try {
        run.go([&](const std::vector<double>& row) { history.append(row); });
    } catch (const core::RunError& error) {
        summary["status"] = "failed";
        summary["message"] = error.what();
        conclude();
        throw;
    }
    const double seconds = core::seconds_per_update(run.point(), run.last_increment(), batch);
    summary["nanoseconds_per_update"] = 1e9 * seconds;
    conclude();
    if (arguments.quiet) return 0;
    core::log::info("{} stages, {} steps, {} iterations", test.stages.size(), run.steps(), run.iterations());
    core::log::info(
        "the soil by itself: {:.1f} ns a point in batches of {}, {:.1f} M updates/s on one thread",
        1e9 * seconds, batch, 1e-6 / seconds);
    core::log::info("results in {}", folder.string());
    return 0;
}

} // namespace

Action declare_element(CLI::App& options) {
    const auto arguments = std::make_shared<Arguments>();
    arguments->test.declare(options);
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
