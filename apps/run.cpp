#include "core/scheduler/run.hpp"
#include "apps/command.hpp"
#include "core/base/log.hpp"

#include <memory>

namespace gault::app {
namespace {

namespace fs = std::filesystem;

struct Arguments {
    SceneArguments scene;
    std::string output;
    bool force = false, quiet = false;
    int threads = 0;
};

int run(const Arguments& arguments, const std::string& command_line) {
    const LoadedScene scene(arguments.scene);
    for (const auto* choices : {&scene.choices(), &scene->chosen})
        for (const core::Choice& choice : *choices)
            core::log::debug("{}: {} ({})", choice.key, choice.value, choice.reason);
    core::RunOptions options;
    options.folder = arguments.output.empty() ? fs::path("out") / fs::path(arguments.scene.file).stem()
                                              : fs::path(arguments.output);
    options.replace = arguments.force;
    options.quiet = arguments.quiet;
    options.threads = arguments.threads;
    options.command_line = command_line;
    options.program_version = GAULT_VERSION;
    options.plan =
        core::to_json(scene.choices(),
                      core::estimate_cost(
                          *scene, [&](const std::vector<core::Override>& more) { return scene.reread(more); },
                          core::threads_that_pay(scene->points(), arguments.threads), 1.0));
    return core::run_scene(*scene, options) == core::Outcome::interrupted ? 130 : 0;
}

} // namespace

Action declare_run(CLI::App& options) {
    const auto arguments = std::make_shared<Arguments>();
    arguments->scene.declare(options);
    options
        .add_option("-o,--output", arguments->output, "Folder of the results (default: out/NAME_OF_SCENE)")
        ->type_name("FOLDER");
    options.add_flag("--force", arguments->force,
                     "Replaces the results that the folder holds; without it such a folder is refused");
    options.add_flag("-q,--quiet", arguments->quiet, "No progress, no closing lines");
    options
        .add_option("-j,--threads", arguments->threads,
                    "Threads (default: as many as pay for the size of the scene)")
        ->check(CLI::Range(1, 1024))
        ->type_name("COUNT");
    options.footer(
        "Writes history.csv, summary.json, results.h5 and results.xdmf. Ctrl-C ends the run after its "
        "present step,\nwith results so far.\n\n"
        "Examples:\n"
        "  gault run configs/paper/fahey.yaml\n"
        "  gault run configs/paper/fahey.yaml -o out/weaker --set materials.sand.friction_angle='46 deg' \\\n"
        "      --set boundaries.0.value='150 kPa'\n"
        "  gault run my_scene.yaml --plugin-path build/my_soil.so --force");
    return [arguments](const std::string& command_line) { return run(*arguments, command_line); };
}

} // namespace gault::app
