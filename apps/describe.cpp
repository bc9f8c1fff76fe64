#include "apps/command.hpp"
#include "core/base/suggest.hpp"

#include <fmt/format.h>

#include <memory>

namespace gault::app {
namespace {

struct Arguments {
    std::string name;
    std::vector<std::filesystem::path> plugin_path;
};

int describe(const Arguments& arguments) {
    const core::Registry registry(core::plugin_search_path({}, arguments.plugin_path));
    std::vector<std::string> names;
    bool found = false;
    for (const core::Component& c : registry.components()) { // a name may exist in several kinds
        names.emplace_back(c.declaration->name);
        if (arguments.name != c.declaration->name) continue;
        fmt::print("{}{}", found ? "\n" : "", core::describe(c));
        found = true;
    }
    if (!found)
        throw core::InputError(
            fmt::format("no component '{}'{}", arguments.name, core::suggestion(arguments.name, names)) +
                               "; plugins of your own are found with --plugin-path or GAULT_PLUGIN_PATH");
    return 0;
}

} // namespace

Action declare_describe(CLI::App& options) {
    const auto arguments = std::make_shared<Arguments>();
    options.add_option("name", arguments->name, "As `gault list` prints it")->required()->type_name("NAME");
    declare_plugin_path(options, arguments->plugin_path);
    options.footer("Parameters with units, defaults and bounds; states or signals; the reference.\n\n"
                   "Examples:\n"
                   "  gault describe mohr_coulomb\n"
                   "  gault describe my_soil --plugin-path build/my_soil.so");
    return [arguments](const std::string&) { return describe(*arguments); };
}

} // namespace gault::app
