// Runs a scene: program -> controls -> boundaries -> step -> measures -> results, until the program is done.
#pragma once
#include "core/config/scene.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace gault::core {

struct RunOptions {
    std::filesystem::path folder; // of the results
    bool replace = false;         // results of an earlier run
    bool quiet = false;           // no progress
    int threads = 0;              // 0: as many as pay
    std::string command_line, program_version;
    nlohmann::json plan = nlohmann::json::object(); // {choices, estimate}, for the summary
};

enum class Outcome { done, interrupted };

// Writes history.csv, summary.json, results.h5, results.xdmf into the folder. Throws InputError before
// anything is written, RunError after the summary says `failed`. SIGINT and SIGTERM end the run after the
// current step.
Outcome run_scene(const Scene& scene, const RunOptions& options);

// `wanted` 0: as many as pay for so many points.
int threads_that_pay(std::size_t points, int wanted);

} // namespace gault::core
