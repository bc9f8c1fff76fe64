// gault: simulate soil with the material point method. Sub-commands in, exit status out: 0 done, 2 the scene or the command
// line is wrong, 3 the run failed, 130 interrupted.
#include "core/base/log.hpp"
#include "core/base/suggest.hpp"
#include "core/config/scene.hpp"
#include "core/registry/registry.hpp"
#include "core/scheduler/run.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace gault::core;
namespace fs = std::filesystem;

struct Arguments {
    std::string scene, output, name, level = "info";
    std::vector<std::string> set;
    std::vector<fs::path> plugin_path;
    bool force = false, quiet = false;
    int threads = 0;
    std::string command_line;
};

std::vector<Override> overrides(const Arguments& arguments) {
    std::vector<Override> all;
    for (const std::string& text : arguments.set) {
        const auto equals = text.find('=');
        if (equals == std::string::npos || equals == 0)
            throw InputError(fmt::format("--set {}: expected KEY=VALUE, e.g. --set materials.sand.friction_angle='46 deg'", text));
        all.push_back({text.substr(0, equals), text.substr(equals + 1)});
    }
    return all;
}

int run(const Arguments& arguments, bool check_only) {
    const auto changes = overrides(arguments);
    const Registry registry(plugin_search_path(scene_plugins(arguments.scene, changes), arguments.plugin_path));
    const Scene scene = read_scene(arguments.scene, changes, registry);
    if (check_only) {
        for (const std::string& line : check_scene(scene)) fmt::print("{}\n", line);
        fmt::print("{}: this scene can run\n", arguments.scene);
        return 0;
    }
    for (const std::string& line : scene.chosen) log::debug("{}", line);
    RunOptions options;
    options.folder = arguments.output.empty() ? fs::path("out") / fs::path(arguments.scene).stem() : fs::path(arguments.output);
    options.replace = arguments.force;
    options.quiet = arguments.quiet;
    options.threads = arguments.threads;
    options.command_line = arguments.command_line;
    options.program_version = GAULT_VERSION;
    return run_scene(scene, options) == gault::core::Outcome::interrupted ? 130 : 0;
}

int list(const Arguments& arguments) {
    const Registry registry(plugin_search_path({}, arguments.plugin_path));
    for (const Component& c : registry.components())
        fmt::print("{:<10} {:<20} {:<10} {}\n", kind_name(c.declaration->kind), c.declaration->name, c.declaration->version, c.file.string());
    return 0;
}

int describe_component(const Arguments& arguments) {
    const Registry registry(plugin_search_path({}, arguments.plugin_path));
    std::vector<std::string> names;
    bool found = false;
    for (const Component& c : registry.components()) {
        names.emplace_back(c.declaration->name);
        if (arguments.name != c.declaration->name) continue;
        fmt::print("{}{}", found ? "\n" : "", describe(c));
        found = true;
    }
    if (!found) throw InputError(fmt::format("no component '{}'{}", arguments.name, suggestion(arguments.name, names)));
    return 0;
}

void scene_options(CLI::App& command, Arguments& arguments) {
    command.add_option("scene", arguments.scene, "The scene, a YAML file")->required();
    command.add_option("--set", arguments.set,
                       "KEY=VALUE: overrides a key of the scene; dots for maps, numbers for list items. May be repeated")
        ->allow_extra_args(false);
}

void plugin_options(CLI::App& command, Arguments& arguments) {
    command.add_option("--plugin-path", arguments.plugin_path,
                       "A folder of plugins or a plugin file, searched before GAULT_PLUGIN_PATH and the installation's own "
                       "folder. May be repeated")
        ->allow_extra_args(false);
}

const std::vector<std::string> command_names = {"run", "check", "list", "describe"};

// A mistyped command gets the nearest one, before CLI11 says something about unexpected arguments.
void check_command(int count, char** words) {
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        if (word.empty() || word[0] == '-') continue;
        if (std::find(command_names.begin(), command_names.end(), word) == command_names.end())
            throw InputError(fmt::format("no command '{}'{}", word, suggestion(word, command_names)));
        return;
    }
}

int dispatch(int count, char** words) {
    Arguments arguments;
    for (int i = 0; i < count; ++i) arguments.command_line += (i ? " " : "") + std::string(words[i]);
    CLI::App app{"Simulates soil with the material point method; soils, boundaries and loading programs are plugins.", "gault"};
    app.set_version_flag("--version", std::string("gault ") + GAULT_VERSION);
    app.require_subcommand(1);
    app.footer("Examples:\n"
               "  gault run configs/paper/fahey.yaml -o out/fahey\n"
               "  gault describe mohr_coulomb\n"
               "Exit status: 0 done, 2 wrong scene or command line, 3 the run failed, 130 interrupted.");
    app.add_option("--log-level", arguments.level, "debug, info, warn or error")
        ->check(CLI::IsMember({"debug", "info", "warn", "error"}))
        ->capture_default_str();

    CLI::App* run_command = app.add_subcommand("run", "Runs a scene and writes its results");
    scene_options(*run_command, arguments);
    run_command->add_option("-o,--output", arguments.output, "Folder of the results (default: out/NAME_OF_SCENE)");
    run_command->add_flag("--force", arguments.force, "Replaces the results that the folder holds");
    run_command->add_flag("-q,--quiet", arguments.quiet, "No progress, no closing lines");
    run_command->add_option("-j,--threads", arguments.threads, "Threads (default: as many as pay for the size of the scene)")
        ->check(CLI::Range(1, 1024));
    plugin_options(*run_command, arguments);
    run_command->footer("Examples:\n"
                        "  gault run configs/paper/fahey.yaml\n"
                        "  gault run configs/paper/fahey.yaml -o out/weaker --set materials.sand.friction_angle='46 deg' \\\n"
                        "      --set boundaries.0.value='150 kPa'\n"
                        "Writes history.csv, summary.json, results.h5 and results.xdmf.");

    CLI::App* check_command_ = app.add_subcommand("check", "Does everything that `run` does before its first step");
    scene_options(*check_command_, arguments);
    plugin_options(*check_command_, arguments);
    check_command_->footer("Example:\n  gault check configs/paper/fahey.yaml --set grid.cells=[36,1]");

    CLI::App* list_command = app.add_subcommand("list", "Lists every component with its version and file");
    plugin_options(*list_command, arguments);
    CLI::App* describe_command = app.add_subcommand("describe", "Prints a component's parameters, states and reference");
    describe_command->add_option("name", arguments.name, "As `gault list` prints it")->required();
    plugin_options(*describe_command, arguments);
    describe_command->footer("Example:\n  gault describe pressuremeter");

    try {
        check_command(count, words);
        app.parse(count, words);
    } catch (const CLI::Success& asked) { // --help, --version
        return app.exit(asked);
    } catch (const CLI::ParseError& error) {
        throw InputError(error.what());
    }
    spdlog::set_level(spdlog::level::from_str(arguments.level));
    if (*run_command) return run(arguments, false);
    if (*check_command_) return run(arguments, true);
    if (*list_command) return list(arguments);
    return describe_component(arguments);
}

} // namespace

int main(int count, char** words) {
    spdlog::set_default_logger(spdlog::stderr_logger_st("gault"));
    spdlog::set_pattern("%v");
    try {
        return dispatch(count, words);
    } catch (const InputError& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return 2;
    } catch (const RunError& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return 3;
    } catch (const std::exception& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return 3;
    }
}
