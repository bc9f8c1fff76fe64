// The folder of a test of one point: history.csv, a row as it comes, and summary.json (docs/element.md).
#pragma once
#include "core/laboratory/element_test.hpp"
#include "core/output/history.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace gault::core {

class ElementResults {
  public:
    // Makes the folder. InputError when it cannot be written, or already holds results and not `replace`.
    ElementResults(const std::filesystem::path& folder, bool replace, const std::vector<ColumnInfo>& columns);

    void row(const std::vector<double>& values); // history.csv
    struct End {
        std::string message; // why it failed; "": it is done
        std::string program, command_line;
        double wall_seconds = 0.0;
        std::optional<double> seconds_per_update;
    };
    void finish(const ElementTest& test, const ElementRun& run, const End& end); // summary.json

  private:
    std::filesystem::path folder_;
    std::vector<ColumnInfo> columns_;
    HistoryFile history_;
    std::vector<double> peak_, end_; // rows: of the largest deviator stress, and the last
};

} // namespace gault::core
