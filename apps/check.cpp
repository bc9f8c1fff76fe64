#include "core/scheduler/check.hpp"
#include "apps/command.hpp"

#include <fmt/format.h>

#include <memory>

namespace gault::app {
namespace {

int check(const SceneArguments& arguments) {
    const LoadedScene scene(arguments);
    const std::vector<std::string> taken = core::check_scene(*scene);
    for (const core::Choice& choice : scene.choices())
        fmt::print("{}: {} ({})\n", choice.key, choice.value, choice.reason);
    for (const std::string& line : taken)
        fmt::print("{}\n", line);
    fmt::print("{}: this scene can run\n", arguments.file);
    return 0;
}

} // namespace

Action declare_check(CLI::App& options) {
    const auto arguments = std::make_shared<SceneArguments>();
    arguments->declare(options);
    options.footer("Prints what was left to the program and what it took, how many points, nodes or facets "
                   "each selection took hold of,\nwhich file each soil came from and its parameters in SI units, and the time step. Writes nothing.\n\n"
                   "Examples:\n"
                   "  gault check configs/paper/fahey.yaml\n"
                   "  gault check configs/paper/fahey.yaml --set grid.cells=[36,1]");
    return [arguments](const std::string&) { return check(*arguments); };
}

} // namespace gault::app
