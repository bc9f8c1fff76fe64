#include "core/laboratory/element_results.hpp"
#include "core/output/atomic_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace gault::core {
namespace {

namespace fs = std::filesystem;

fs::path cleared(const fs::path& folder, bool replace) {
    fs::create_directories(folder);
    for (const char* name : {"summary.json", "history.csv", "element.png"}) {
        if (!fs::exists(folder / name)) continue;
        if (!replace)
            throw InputError(
                fmt::format("'{}' already holds results ({}): choose another folder, or --force to "
                            "replace them",
                            folder.string(), name));
        fs::remove(folder / name);
    }
    return folder;
}

nlohmann::json by_name(const std::vector<ColumnInfo>& columns, const std::vector<double>& row) {
    nlohmann::json all = nlohmann::json::object();
    for (std::size_t k = 0; k < row.size(); ++k)
        all[columns[k].header()] = row[k];
    return all;
}

nlohmann::json provenance(const ElementTest& test, const ElementResults::End& end) {
    const Component& soil = *test.material.model.component;
    return {{"program", end.program},
            {"command", end.command_line},
            {"test", fs::absolute(test.file).string()},
            {"test_sha256", sha256_of_file(test.file)},
            {"soil", soil.declaration->name},
            {"version", soil.declaration->version},
            {"file", soil.file.string()},
            {"sha256", sha256_of_file(soil.file)}};
}

} // namespace

ElementResults::ElementResults(const fs::path& folder, bool replace,
                               const std::vector<ColumnInfo>& columns) try
    : folder_(cleared(folder, replace)), columns_(columns), history_(folder / "history.csv", columns) {
} catch (const fs::filesystem_error& error) {
    throw InputError(
        fmt::format("cannot write results in '{}': {}", folder.string(), error.code().message()));
} catch (const RunError& error) {
    throw InputError(error.what());
}

void ElementResults::row(const std::vector<double>& values) {
    history_.append(values);
    const auto deviator = static_cast<std::size_t>(
        std::find_if(columns_.begin(), columns_.end(),
                     [](const ColumnInfo& column) { return column.name == "deviator_stress"; }) -
        columns_.begin());
    if (peak_.empty() || values[deviator] > peak_[deviator]) peak_ = values;
    end_ = values;
}

void ElementResults::finish(const ElementTest& test, const ElementRun& run, const End& end) {
    history_.sync();
    nlohmann::json summary = {{"status", end.message.empty() ? "done" : "failed"},
                              {"title", test.title},
                              {"peak", by_name(columns_, peak_)},
                              {"end", by_name(columns_, end_)},
                              {"counts",
                               {{"stages", test.stages.size()},
                                {"steps", run.steps()},
                                {"newton_iterations", run.iterations()},
                                {"constitutive_updates", run.point().updates()}}},
                              {"wall_seconds", end.wall_seconds},
                              {"provenance", provenance(test, end)},
                              {"test", test.yaml}};
    if (!end.message.empty()) summary["message"] = end.message;
    if (run.undrained_strength()) summary["undrained_strength_Pa"] = *run.undrained_strength();
    if (end.seconds_per_update) summary["nanoseconds_per_update"] = 1e9 * *end.seconds_per_update;
    write_atomically(folder_ / "summary.json",
                     summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

} // namespace gault::core
