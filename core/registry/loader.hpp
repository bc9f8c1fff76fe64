// Opens one plugin file: the only place that calls dlopen.
#pragma once
#include <gault/gault.h>

#include <filesystem>

namespace gault::core {

// Examines the file, opens it, checks what it declares. Throws InputError: one line that names the file, what
// it has or wants and what the host expects or offers. Never closes what it opened. [main]
const gault_module& load_module(const std::filesystem::path& file);

} // namespace gault::core
