#include "core/base/error.hpp"
#include "core/base/suggest.hpp"
#include "core/output/compare.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fstream>

namespace gault::core {

namespace {

struct Cell {
    std::string text;
    int column; // of its first character, from 1
};

std::vector<Cell> split(const std::string& line) {
    std::vector<Cell> cells;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        const std::size_t first = std::min(line.find_first_not_of(" \t\r", begin), end);
        const std::size_t last = line.find_last_not_of(" \t\r", end - (end > 0));
        const bool empty = first == end || last == std::string::npos || last < first;
        cells.push_back({empty ? "" : line.substr(first, last - first + 1), static_cast<int>(first) + 1});
        begin = end + 1;
    }
    return cells;
}

double number(const Cell& cell, const Location& where) {
    double value = 0.0;
    const char* end = cell.text.data() + cell.text.size();
    const auto [rest, error] = std::from_chars(cell.text.data(), end, value);
    if (error != std::errc{} || rest != end || !std::isfinite(value))
        throw InputError(where, fmt::format("'{}' is not a finite number", cell.text));
    return value;
}

} // namespace

std::span<const double> CsvTable::column(const std::string& name) const {
    const auto found = std::ranges::find(columns, name);
    if (found == columns.end())
        throw InputError(fmt::format("no column '{}'{}", name, suggestion(name, columns)));
    return values[static_cast<std::size_t>(found - columns.begin())];
}

CsvTable read_csv(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream || std::filesystem::is_directory(file))
        throw InputError(fmt::format("cannot read '{}'", file.string()));
    CsvTable table;
    std::string line;
    for (int line_number = 1; std::getline(stream, line); ++line_number) {
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        const std::vector<Cell> cells = split(line);
        if (table.columns.empty()) {
            for (const Cell& cell : cells)
                table.columns.push_back(cell.text);
            table.values.resize(cells.size());
            continue;
        }
        const Location where{file.string(), line_number, 1};
        if (cells.size() != table.columns.size())
            throw InputError(where,
                             fmt::format("{} values for {} columns", cells.size(), table.columns.size()));
        for (std::size_t i = 0; i < cells.size(); ++i)
            table.values[i].push_back(number(cells[i], {file.string(), line_number, cells[i].column}));
    }
    if (table.columns.empty()) throw InputError(fmt::format("'{}' is empty", file.string()));
    return table;
}

} // namespace gault::core
