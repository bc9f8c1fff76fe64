#include "core/study/frontier.hpp"
#include "apps/command.hpp"
#include "core/base/log.hpp"
#include "core/scheduler/simulation.hpp"

#include <fmt/format.h>

#include <memory>

namespace gault::app {
namespace {

namespace fs = std::filesystem;

struct Arguments {
    SceneArguments scene; // or study
    std::string output;
    bool force = false;
    int repeat = 0;
};

std::string cells(int n, int m) {
    return fmt::format("[{}, {}]", n, m);
}

// Of a scene that has no study: as it is written on finer grids, and as the plan chooses.
core::Study study_of(const LoadedScene& scene, const Arguments& arguments) {
    core::Study study;
    study.title = scene->title;
    study.scene = arguments.scene.file;
    core::Study::Family written{"as written, cells", {}, {}},
        chosen{"as chosen for an accuracy", everything_open(*scene), {}};
    const auto& axes = scene->axes;
    for (const double factor : {0.5, 1.0, 2.0}) {
        const auto finer = [&](int n) { return n == 1 ? 1 : std::max(2, static_cast<int>(n * factor)); };
        const std::string value = cells(finer(axes[0].cells), finer(axes[1].cells));
        written.members.push_back({value, {{"grid.cells", value}}, 0, factor});
    }
    for (const double percent : {3.0, 1.0, 0.3, 0.1, 0.03}) {
        const std::string value = fmt::format("{:g} %", percent);
        chosen.members.push_back({value, {{"accuracy", value}}, 0, percent});
    }
    const core::Simulation simulation(*scene, 1);
    const auto& columns = simulation.columns(); // time, then what the program records
    study.curve = {columns[1].header(), columns[2].header()};
    study.families = {std::move(written), std::move(chosen)};
    return study;
}

std::vector<std::string> passed_on(const SceneArguments& scene) {
    std::vector<std::string> words;
    for (const std::string& set : scene.set)
        words.insert(words.end(), {"--set", set});
    for (const fs::path& path : scene.plugin_path)
        words.insert(words.end(), {"--plugin-path", path.string()});
    return words;
}

int frontier(const Arguments& arguments, const std::string& command_line) {
    core::FrontierOptions options;
    options.folder = arguments.output.empty()
                         ? fs::path("out") / (fs::path(arguments.scene.file).stem().string() + "_frontier")
                         : fs::path(arguments.output);
    if (!arguments.force && fs::exists(options.folder / "frontier.json"))
        throw core::InputError(
            fmt::format("'{}' holds a frontier; --force replaces it", options.folder.string()));
    options.program = fs::read_symlink("/proc/self/exe");
    options.arguments = passed_on(arguments.scene);
    options.repeat = arguments.repeat;
    options.command_line = command_line;
    options.program_version = GAULT_VERSION;
    const core::Study study = core::is_study(arguments.scene.file)
                                  ? core::read_study(arguments.scene.file)
                                  : study_of(LoadedScene(arguments.scene), arguments);
    fmt::print("{}", core::frontier_table(core::run_frontier(study, options)));
    run_script(
        "frontier.py",
        {(options.folder / "frontier.json").string(), "-o", (options.folder / "frontier.png").string()},
        options.folder);
    core::log::info("results in {}", options.folder.string());
    return 0;
}

} // namespace

Action declare_frontier(CLI::App& options) {
    const auto arguments = std::make_shared<Arguments>();
    arguments->scene.declare(options);
    options
        .add_option("-o,--output", arguments->output, "Folder of the results (default: out/NAME_frontier)")
        ->type_name("FOLDER");
    options.add_flag("--force", arguments->force, "Replaces the frontier that the folder holds");
    options
        .add_option("--repeat", arguments->repeat,
                    "Runs of each setting, taking turns (default: as the study says, or 3)")
        ->check(CLI::Range(1, 1000));
    options.footer(
        "Runs a scene with families of settings, each in turn and alone, and writes frontier.csv, "
        "frontier.json "
        "and\nfrontier.png: error against time, with the front that nothing beats in both. The file is a "
        "study "
        "(scene, families;\nsee docs/results.md), or a scene: it is then run as written on coarser and finer "
        "grids, and as `plan` chooses for\naccuracies of 3 to 0.03 %. Errors are those against the scene's "
        "reference, or against a Richardson extrapolation.\n\n"
        "Examples:\n"
        "  gault frontier configs/frontier/fahey.yaml\n"
        "  gault frontier my_scene.yaml --repeat 1");
    return [arguments](const std::string& command_line) { return frontier(*arguments, command_line); };
}

} // namespace gault::app
