// Writes a run's results so that a kill at any moment leaves the last complete state readable.
#pragma once
#include "core/base/error.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gault::core {

struct ColumnInfo {
    std::string name, unit, description; // "force", "N", "Pushing the soil away"
    std::string header() const;          // "force_N"; "force" where the unit is "1"
};

// One dataset of a frame. `fill` writes rows x components doubles, row-major, in the order of point identity,
// so that a point keeps its row in every frame whatever the solver's own order is.
struct Dataset {
    ColumnInfo info;
    int components = 1;
    std::function<void(double*)> fill;
};

struct FrameAttribute {
    std::string name, unit;
    double value;
};

struct Provenance {
    std::string scene_yaml;
    // Program version, command line, threads, instruction set, scene and plugins with their hashes.
    nlohmann::json text;
};

// One folder of results: history.csv, summary.json, results.h5, results.xdmf (docs/results.md says what they
// hold). Numbers that are not finite reach no file: RunError names the column or dataset, and the row. So
// does a failed write, with the file and the reason. [main thread]
class ResultWriter {
  public:
    // Makes the folder and its parents. InputError when it cannot be written, or already holds results and
    // not `replace`: nothing is touched then. Replacing removes only files that a ResultWriter writes.
    ResultWriter(std::filesystem::path folder, bool replace, std::vector<ColumnInfo> history_columns,
                 const Provenance& provenance, std::size_t point_count);
    ~ResultWriter();

    void row(const std::vector<double>& values); // history.csv
    // results.h5, results.xdmf. `time` (s) is among the attributes, `position` (3 components) among the
    // datasets.
    void frame(const std::vector<FrameAttribute>& attributes, const std::vector<Dataset>& datasets);
    void failed_point(const std::string& yaml);  // failed_point.yaml
    void summary(const nlohmann::json& summary); // summary.json; null where a number is not finite
    // The whole history and every frame into one self-contained results.h5. Once; only summary() may follow.
    // A run that was interrupted or failed ends with it too.
    void finish();

    const std::vector<std::vector<double>>& rows() const; // the history so far
    const std::filesystem::path& folder() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

std::string sha256_of_file(const std::filesystem::path& file); // hexadecimal

} // namespace gault::core
