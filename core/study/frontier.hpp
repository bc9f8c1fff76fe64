// Speed against error: every member of a study, each in turn and alone, repeated.
#pragma once
#include "core/config/study.hpp"

#include <nlohmann/json.hpp>

namespace gault::core {

struct FrontierOptions {
    std::filesystem::path folder;       // of the results
    std::filesystem::path program;      // `gault`
    std::vector<std::string> arguments; // of every run: --set, --plugin-path
    int repeat = 0;                     // 0: as the study says
    std::string command_line, program_version;
};

// Runs the study and writes frontier.csv and frontier.json into the folder, anew after every run. Returns what
// frontier.json holds: docs/results.md. A member that fails stays in the table with its message. Throws InputError
// (a run found the scene wrong), RunError (interrupted; what was measured is written).
nlohmann::json run_frontier(const Study& study, const FrontierOptions& options);

// The table as text, a line a member.
std::string frontier_table(const nlohmann::json& frontier);

} // namespace gault::core
