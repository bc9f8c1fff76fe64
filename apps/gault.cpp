// gault: simulate soil with the material point method. Sub-commands in, exit status out: 0 done, 2 the scene
// or the command line is wrong, 3 the run failed, 130 interrupted.
#include "apps/command.hpp"
#include "core/base/log.hpp"
#include "core/base/suggest.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <new>
#include <string>
#include <vector>

namespace {

using namespace gault::app;
using gault::core::InputError;
using gault::core::RunError;
using gault::core::suggestion;

constexpr std::array commands{
    Command{"run", "Runs a scene and writes its results", declare_run},
    Command{"plot", "Draws the results of a run", declare_plot},
    Command{"check", "Does everything that `run` does before its first step", declare_check},
    Command{"plan", "Says what is chosen for a scene, why, and what the run will cost", declare_plan},
    Command{"frontier", "Measures error against time over families of settings", declare_frontier},
    Command{"element", "Takes one material point of a soil through laboratory tests", declare_element},
    Command{"certify", "Runs a soil model through the contract and through physics", declare_certify},
    Command{"new", "Writes a project for a component of your own", declare_new},
    Command{"list", "Lists every component with its version and file", declare_list},
    Command{"describe", "Prints a component's parameters, states or signals, and reference",
            declare_describe},
    Command{"bench", "Measures speed and memory with the code that `run` runs", declare_bench},
};

std::string documents() {
    const std::filesystem::path share = installation() / "share", page = share / "doc/gault/docs/index.md";
    if (!std::filesystem::exists(page)) return "Documents: docs/index.md of the sources.";
    return fmt::format("Documents: {}\nScenes, as `configs` in documents and examples: {}", page.string(),
                       (share / "gault/configs").string());
}

bool is_option(const std::string& word) {
    return word.size() > 1 && word[0] == '-';
}

std::vector<std::string> options_of(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    return names;
}

std::string allowed_commands(const std::string& word) {
    std::vector<std::string> names;
    for (const Command& command : commands)
        names.emplace_back(command.name);
    return suggestion(word, names);
}

std::string unknown_option(const std::string& word, const CLI::App& app, const CLI::App& command) {
    const std::string name = word.substr(0, word.find('='));
    if (command.get_option_no_throw(name))
        return fmt::format("option '{}' stands before its command: write `gault {} ... {}`", name,
                           command.get_name(), name);
    std::vector<std::string> names = options_of(command);
    if (&command != &app)
        for (std::string& global : options_of(app))
            if (std::find(names.begin(), names.end(), global) == names.end())
                names.push_back(std::move(global));
    return fmt::format("no option '{}'{}", name, suggestion(name, names));
}

// One line: what is wrong with the command line, and the nearest right word.
std::string explanation(const CLI::App& app, const CLI::ParseError& error) {
    const auto chosen = app.get_subcommands();
    const CLI::App& command = chosen.empty() ? app : *chosen.front();
    const auto unread = app.remaining(true);
    if (chosen.empty() && !unread.empty() && !is_option(unread[0]))
        return fmt::format("no command '{}'{}", unread[0], allowed_commands(unread[0]));
    for (const std::string& word : unread)
        if (is_option(word)) return unknown_option(word, app, command);
    const std::string name = chosen.empty() ? "gault" : "gault " + command.get_name();
    if (!unread.empty()) return fmt::format("unexpected '{}'; see `{} --help`", unread[0], name);
    if (chosen.empty() && dynamic_cast<const CLI::RequiredError*>(&error))
        return "a command is required" + allowed_commands("");
    return fmt::format("{}; see `{} --help`", error.what(), name);
}

int dispatch(int count, char** words) {
    CLI::App app{
        "Simulates soil with the material point method; soils, boundaries and loading programs are plugins.",
        "gault"};
    app.set_version_flag("--version", std::string("gault ") + GAULT_VERSION);
    app.require_subcommand(1);
    app.fallthrough();
    app.footer(
        "Environment:\n"
        "  GAULT_PLUGIN_PATH  folders or files of plugins, colons between; see `gault list`\n"
        "  GAULT_ISA          baseline, x86-64-v3 or x86-64-v4: the widest instruction set to use\n\n"
        "Examples:\n"
        "  gault run configs/paper/fahey.yaml -o out/fahey\n"
        "  gault check configs/paper/fahey.yaml\n"
        "  gault describe mohr_coulomb\n"
        "`gault COMMAND --help` lists the options of a command.\n\n" +
        documents() +
        "\n\n"
        "Exit status: 0 done, 2 wrong scene or command line, 3 the run failed, 130 interrupted.");
    std::string level = "info";
    app.add_option("--log-level", level, "debug, info, warn or error")
        ->check(CLI::IsMember({"debug", "info", "warn", "error"}))
        ->type_name("LEVEL")
        ->capture_default_str();
    Action chosen;
    for (const Command& command : commands) {
        CLI::App& options = *app.add_subcommand(command.name, command.summary);
        options.final_callback([&chosen, action = command.declare(options)] { chosen = action; });
    }
    try {
        app.parse(count, words);
    } catch (const CLI::Success& asked) { // --help, --version
        return app.exit(asked);
    } catch (const CLI::ParseError& error) {
        throw InputError(explanation(app, error));
    }
    spdlog::set_level(spdlog::level::from_str(level));
    std::string command_line = words[0];
    for (int i = 1; i < count; ++i)
        command_line.append(" ").append(words[i]);
    return chosen(command_line);
}

int failed(int status, const std::string& what) {
    fmt::print(stderr, "error: {}\n", what);
    return status;
}

} // namespace

int main(int count, char** words) {
    spdlog::set_default_logger(spdlog::stderr_logger_mt("gault"));
    spdlog::set_pattern("%v");
    try {
        const int status = dispatch(count, words);
        if (std::fflush(stdout) != 0) return failed(3, "the standard output cannot be written");
        return status;
    } catch (const InputError& error) {
        return failed(2, error.what());
    } catch (const RunError& error) {
        return failed(3, error.what());
    } catch (const std::bad_alloc&) {
        return failed(3, "internal error: out of memory");
    } catch (const std::exception& error) {
        return failed(3, fmt::format("internal error: {}", error.what()));
    }
}
