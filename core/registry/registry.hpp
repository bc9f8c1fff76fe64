// Finds, checks and loads plugins. Files are examined before they are opened, so that a defective one costs
// one sentence and never the process. Modules are never unloaded.
#pragma once
#include "core/base/error.hpp"
#include <gault/gault.h>

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gault::core {

struct Component {
    const gault_component* declaration;
    const gault_module* module;
    std::filesystem::path file; // as loaded: the variant for this processor
};

const char* kind_name(gault_kind kind); // "material", "boundary", "program", "observer"

class Registry {
  public:
    // Loads every plugin found along `search_path` (folders: every *.so in them, sorted; or single files).
    // Symlinks are resolved and a file met twice is loaded once. A folder's glibc-hwcaps/x86-64-v3 and -v4
    // hold variants of the same file names, taken instead where this processor can run them. An entry that
    // does not exist is an error. Throws InputError: one line that names the file, what it wants and what the
    // host offers.
    explicit Registry(const std::vector<std::filesystem::path>& search_path);

    const Component& find(gault_kind kind, std::string_view name,
                          const Location& where = {}) const;              // InputError: nearest name
    std::span<const Component> components() const { return components_; } // sorted by kind, then name

  private:
    std::vector<Component> components_;
};

// `first` (a scene's `plugins:`), then `command_line` (--plugin-path), GAULT_PLUGIN_PATH (colon-separated),
// and the installation's own folder, ../lib/gault/plugins from the executable.
std::vector<std::filesystem::path> plugin_search_path(const std::vector<std::filesystem::path>& first,
                                                      const std::vector<std::filesystem::path>& command_line);

// `gault describe`: parameters, states or signals, reference, from the declarations alone.
std::string describe(const Component& component);

} // namespace gault::core
