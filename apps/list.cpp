#include "apps/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

namespace gault::app {
namespace {

using Paths = std::vector<std::filesystem::path>;

int list(const Paths& plugin_path) {
    const core::Registry registry(core::plugin_search_path({}, plugin_path));
    std::vector<std::array<std::string, 4>> rows;
    std::array<std::size_t, 3> width{};
    for (const core::Component& c : registry.components()) {
        const gault_component& declared = *c.declaration;
        rows.push_back({core::kind_name(declared.kind), declared.name, declared.version, c.file.string()});
        for (std::size_t k = 0; k < width.size(); ++k)
            width[k] = std::max(width[k], rows.back()[k].size());
    }
    for (const auto& [kind, name, version, file] : rows)
        fmt::print("{:<{}}  {:<{}}  {:<{}}  {}\n", kind, width[0], name, width[1], version, width[2], file);
    return 0;
}

} // namespace

Action declare_list(CLI::App& options) {
    const auto plugin_path = std::make_shared<Paths>();
    declare_plugin_path(options, *plugin_path);
    options.footer("Kind, name, version and file; `gault describe NAME` says more.\n\n"
                   "Examples:\n"
                   "  gault list\n"
                   "  gault list --plugin-path build/my_soil.so");
    return [plugin_path](const std::string&) { return list(*plugin_path); };
}

} // namespace gault::app
