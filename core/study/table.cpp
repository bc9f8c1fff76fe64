#include "core/study/frontier.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gault::core {
namespace {

using nlohmann::json;

std::string amount(const json& value) {
    if (!value.is_number()) return "-";
    const double v = value;
    for (const auto& [size, prefix] : {std::pair{1e9, " G"}, {1e6, " M"}, {1e3, " k"}})
        if (v >= size) return fmt::format("{:.3g}{}", v / size, prefix);
    return fmt::format("{:.3g}", v);
}

// 0.010 % (2.0) *
std::string error_text(const json& member, const std::string& name) {
    const json error = member["errors"][name];
    if (!error.is_number()) return "-";
    std::string text = fmt::format("{:.2g} %", 100.0 * error.get<double>());
    if (member.contains("orders") && member["orders"].contains(name))
        text += fmt::format(" ({:.1f})", member["orders"][name].get<double>());
    return member["front"][name] == true ? text + " *" : text;
}

using Row = std::vector<std::string>;

Row header(const json& frontier) {
    Row row{"", "time, s", "least", "most", "updates", "per s", "memory"};
    for (const char* group : {"errors", "values"})
        for (const json& name : frontier[group])
            row.push_back(name);
    return row;
}

Row row_of(const json& member, const json& frontier) {
    Row row{"  " + member["label"].get<std::string>()};
    if (member["status"] != "done") {
        row.push_back(member.value("message", member["status"].get<std::string>()));
        return row;
    }
    for (const char* time : {"median", "least", "most"})
        row.push_back(fmt::format("{:.3g}", member["wall_seconds"][time].get<double>()));
    for (const char* count : {"constitutive_updates", "point_steps_per_second", "peak_memory_bytes"})
        row.push_back(amount(member[count]));
    for (const json& name : frontier["errors"])
        row.push_back(error_text(member, name));
    for (const json& name : frontier["values"]) {
        const json& value = member["values"][name.get<std::string>()];
        row.push_back(value.is_number() ? fmt::format("{:.6g}", value.get<double>()) : "-");
    }
    return row;
}

} // namespace

std::string frontier_table(const json& frontier) {
    std::vector<Row> rows{header(frontier)};
    for (const json& family : frontier["families"]) {
        rows.push_back({family["name"]});
        for (const json& member : family["members"])
            rows.push_back(row_of(member, frontier));
    }
    std::vector<std::size_t> width(rows[0].size());
    for (const Row& row : rows) // a line with less is a name or a message, and may be long
        for (std::size_t k = 0; k < row.size() && (row.size() == width.size() || k == 0); ++k)
            width[k] = std::max(width[k], row.size() > 1 ? row[k].size() : 0);
    std::string text;
    for (const Row& row : rows) {
        std::string line;
        for (std::size_t k = 0; k < row.size(); ++k)
            line += row.size() == width.size() && k > 0 ? fmt::format("  {:>{}}", row[k], width[k])
                    : k == 0 && row.size() > 1          ? fmt::format("{:<{}}", row[k], width[k])
                                                        : (k ? "  " : "") + row[k];
        text += line + "\n";
    }
    if (frontier["against"].is_string())
        text += "\nErrors against " + frontier["against"].get<std::string>() +
                "; in brackets their order; * none is both faster and nearer.\n";
    return text;
}

} // namespace gault::core
