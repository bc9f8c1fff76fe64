// The sub-commands of gault. Each is a file of its own and a line of the table in gault.cpp.
#pragma once
#include "core/config/element.hpp"
#include "core/plan/plan.hpp"
#include "core/registry/registry.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace gault::app {

// Runs a command whose options are read. `command_line`: as typed, for the provenance. Returns the exit
// status.
using Action = std::function<int(const std::string& command_line)>;

struct Command {
    const char* name;
    const char* summary;
    Action (*declare)(CLI::App& options); // adds the command's options, which its action holds
};

Action declare_run(CLI::App& options);
Action declare_check(CLI::App& options);
Action declare_list(CLI::App& options);
Action declare_describe(CLI::App& options);
Action declare_bench(CLI::App& options);
Action declare_plan(CLI::App& options);
Action declare_frontier(CLI::App& options);
Action declare_element(CLI::App& options);
Action declare_certify(CLI::App& options);
Action declare_new(CLI::App& options);
Action declare_plot(CLI::App& options);

// KEY=VALUE of --set. InputError.
std::vector<core::Override> overrides(const std::vector<std::string>& set);

// A scene on the command line: the file, --set, --plugin-path.
struct SceneArguments {
    std::string file;
    std::vector<std::string> set;
    std::vector<std::filesystem::path> plugin_path;

    void declare(CLI::App& options, const std::string& what = "scene");
};

// A scene as read, with the plugins that it needs.
class LoadedScene {
  public:
    // What the scene leaves open is chosen. `more`: overrides beyond those of the command line. Throws InputError.
    explicit LoadedScene(const SceneArguments& arguments, const std::vector<core::Override>& more = {});
    const core::Scene& operator*() const { return scene_; }
    const core::Scene* operator->() const { return &scene_; }

    const std::vector<core::Choice>& choices() const { return choices_; }
    core::Scene read(const std::vector<core::Override>& more) const; // anew, with nothing chosen but `more`
    core::Scene
    reread(const std::vector<core::Override>& more) const; // anew, with what was chosen and `more`

  private:
    std::filesystem::path file_;
    std::vector<core::Override> changes_;
    core::Registry registry_;
    std::vector<core::Choice> choices_;
    core::Scene scene_;
};

// A test of one point as read, with the plugins that it needs.
class LoadedElementTest {
  public:
    explicit LoadedElementTest(const SceneArguments& arguments); // InputError
    const core::ElementTest& operator*() const { return test_; }

  private:
    core::Registry registry_;
    core::ElementTest test_;
};

// Leaves all that a plan may choose open; but a radial scene stays one: it need not say what holds its ends.
std::vector<core::Override> everything_open(const core::Scene& scene);

// The folder of bin, lib and share that this program runs in: of an installation, or a build tree.
std::filesystem::path installation();
std::filesystem::path shared_file(const std::string& name); // in its share/gault

// A script of share/gault with /usr/bin/python3. Where that fails: a warning, and what it said in FOLDER/SCRIPT.log.
void run_script(const std::string& script, std::vector<std::string> arguments,
                const std::filesystem::path& folder);

void declare_plugin_path(CLI::App& options, std::vector<std::filesystem::path>& plugin_path);

} // namespace gault::app
