// A run whose every number is known, and what a reader of results needs.
#pragma once
#include "core/output/results.hpp"

#include <map>

namespace gault::core::test {

struct Folder { // a new folder whose path has blanks and letters beyond ASCII; removed at the end
    Folder();
    ~Folder();
    std::filesystem::path path;
    std::filesystem::path results() const { return path / "a b" / "résultats µ"; }
};

extern const std::vector<ColumnInfo> columns;       // time (s), load (Pa), settlement (1)
std::vector<double> row(std::size_t number);        // of the history
double value(std::size_t frame, std::size_t entry); // of every dataset, by its place in memory
std::vector<Dataset> datasets(std::size_t frame, std::size_t points);
std::vector<FrameAttribute> attributes(std::size_t frame);
ResultWriter writer(const std::filesystem::path& folder, std::size_t points, bool replace = false);

std::string text_of(const std::filesystem::path& file);
std::vector<std::string> lines_of(const std::filesystem::path& file);

// Members of an HDF5 file; every failure throws std::runtime_error.
struct Numbers {
    std::vector<std::size_t> shape;
    std::vector<double> values;
};
std::vector<std::string> members(const std::filesystem::path& file, const std::string& group);
Numbers numbers(const std::filesystem::path& file, const std::string& dataset);
std::string text(const std::filesystem::path& file, const std::string& dataset);
double attribute(const std::filesystem::path& file, const std::string& object, const std::string& name);
std::string text_attribute(const std::filesystem::path& file, const std::string& object,
                           const std::string& name);

struct Reference { // a DataItem of results.xdmf
    std::string file, dataset;
    std::vector<std::size_t> shape;
};
std::vector<Reference> references(const std::filesystem::path& xdmf); // throws unless it is well-formed XML

} // namespace gault::core::test
