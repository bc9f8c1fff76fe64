// A command as a process of its own, waited for.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace gault::core {

struct ChildResult {
    int status;        // exit status; 128 + signal where one ended it
    double seconds;    // from its start to its end
    std::string error; // what it wrote to its standard error
};

// Standard output goes nowhere, standard error through `error_file`. RunError: it cannot be started.
ChildResult run_child(const std::vector<std::string>& command, const std::filesystem::path& error_file);

} // namespace gault::core
