#include "core/registry/registry.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>

namespace gault::core {
namespace {

using Row = std::vector<std::string>;

std::size_t width(const std::string& text) { // characters: UTF-8 continuation bytes do not count
    return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

// The first row is the head. Columns are as wide as their widest cell; one without any cell is left out.
std::string table(const std::string& title, const std::vector<Row>& rows) {
    std::string text = fmt::format("\n{}\n", title);
    std::vector<std::size_t> widths(rows[0].size());
    for (std::size_t i = 1; i < rows.size(); ++i)
        for (std::size_t j = 0; j < widths.size(); ++j)
            widths[j] = std::max(widths[j], width(rows[i][j]));
    for (std::size_t j = 0; j < widths.size(); ++j)
        if (widths[j]) widths[j] = std::max(widths[j], width(rows[0][j]));
    for (const Row& row : rows) {
        std::string line = "   ";
        for (std::size_t j = 0; j < row.size(); ++j)
            if (widths[j]) line += " " + row[j] + std::string(widths[j] - width(row[j]) + 1, ' ');
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

// Angles are given as people write them.
std::string number(const gault_parameter& p, double value) {
    if (p.unit && p.unit == std::string_view("rad") && value != 0.0)
        return fmt::format("{:g} deg", value * 180.0 / std::numbers::pi);
    return p.type == GAULT_INTEGER ? fmt::format("{:.0f}", value) : fmt::format("{:g}", value);
}

std::string bounds(const gault_parameter& p) {
    const char* above = p.flags & GAULT_MIN_OPEN ? ">" : ">=";
    const char* below = p.flags & GAULT_MAX_OPEN ? "<" : "<=";
    std::string text;
    if (!std::isinf(p.min)) text = fmt::format("{} {}", above, number(p, p.min));
    if (!std::isinf(p.max)) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", below, number(p, p.max));
    return text;
}

std::string entries(const gault_parameter& p) {
    if (p.max_count == 0) return p.min_count == 0 ? "" : fmt::format("at least {}", p.min_count);
    if (p.min_count == p.max_count) return fmt::format("exactly {}", p.min_count);
    return fmt::format("{} to {}", p.min_count, p.max_count);
}

std::string joined(std::initializer_list<std::string> parts) {
    std::string text;
    for (const std::string& part : parts)
        if (!part.empty()) text += (text.empty() ? "" : ", ") + part;
    return text;
}

std::string allowed(const gault_parameter& p) {
    switch (p.type) {
    case GAULT_REAL:
        return bounds(p).empty() ? "any number" : bounds(p);
    case GAULT_INTEGER:
        return joined({"whole number", bounds(p)});
    case GAULT_BOOLEAN:
        return "true | false";
    case GAULT_TEXT_VALUE:
        return "text";
    case GAULT_LIST:
        return joined({"list of numbers", bounds(p), entries(p)});
    case GAULT_TABLE:
        return joined({fmt::format("table [x in {}, y]", p.x_unit), bounds(p), entries(p)});
    case GAULT_RECORDS:
        return joined({"list of the records below", entries(p)});
    default:
        break;
    }
    std::string words;
    for (const char* const* word = p.choices; *word; ++word)
        words += fmt::format("{}{}", words.empty() ? "" : " | ", *word);
    return words;
}

std::string fallback(const gault_parameter& p) {
    if (p.flags & GAULT_REQUIRED) return "required";
    if (p.flags & GAULT_OPTIONAL) return "optional";
    if (p.type == GAULT_BOOLEAN) return p.fallback == 0.0 ? "false" : "true";
    if (p.type == GAULT_CHOICE) return p.choices[static_cast<std::size_t>(p.fallback)];
    return number(p, p.fallback);
}

bool is_number(const gault_parameter& p) {
    return p.type == GAULT_REAL || p.type == GAULT_INTEGER || p.type == GAULT_LIST || p.type == GAULT_TABLE;
}

// Record kinds and their parameters follow the first parameter that holds them, indented; a kind of a single
// parameter is one line, as it is written.
class ParameterRows {
  public:
    std::vector<Row> rows{{"name", "symbol", "unit", "default", "allowed", "meaning"}};

    void add(const gault_parameter* const* parameters, const std::string& indent) {
        for (; *parameters; ++parameters) {
            const gault_parameter& p = **parameters;
            const bool again = p.type == GAULT_RECORDS && shown_.contains(p.kinds);
            rows.push_back(
                {indent + p.name, p.symbol, unit(p), fallback(p),
                 again ? joined({fmt::format("as `{}` above", shown_[p.kinds]), entries(p)}) : allowed(p),
                 p.doc});
            if (p.type != GAULT_RECORDS || again) continue;
            shown_[p.kinds] = p.name;
            for (const gault_record_kind* const* kind = p.kinds; *kind; ++kind)
                add(**kind, indent + "  ");
        }
    }

  private:
    static std::string unit(const gault_parameter& p) { return is_number(p) && p.unit ? p.unit : ""; }
    void add(const gault_record_kind& kind, const std::string& indent) {
        const gault_parameter* const* p = kind.parameters;
        if (p[0] && !p[1] && p[0]->type != GAULT_RECORDS) {
            rows.push_back({indent + kind.name, p[0]->symbol, unit(**p),
                            p[0]->flags & GAULT_REQUIRED ? "" : fallback(**p), allowed(**p), kind.doc});
            return;
        }
        rows.push_back({fmt::format("{}{}:", indent, kind.name), "", "", "", "", kind.doc});
        add(p, indent + "  ");
    }
    std::map<const gault_record_kind* const*, std::string> shown_;
};

std::string parameter_table(const gault_component& c) {
    if (!c.parameters[0]) return "\nparameters: none\n";
    ParameterRows all;
    all.add(c.parameters, "");
    return table("parameters", all.rows);
}

std::string signal_table(const std::string& title, const gault_signal* signals, std::uint32_t count) {
    if (count == 0) return fmt::format("\n{}: none\n", title);
    std::vector<Row> rows{{"name", "unit", "meaning"}};
    for (const gault_signal& s : std::span(signals, count))
        rows.push_back({s.name, s.unit, s.doc});
    return table(title, rows);
}

std::string control_table(const gault_boundary_api& api) {
    if (api.control_count == 0) return "\ncontrols: none\n";
    std::vector<Row> rows{{"name", "unit", "uncommanded", "meaning"}};
    for (const gault_signal& s : std::span(api.controls, api.control_count))
        rows.push_back(
            {s.name, s.unit, std::isnan(s.initial) ? "none" : fmt::format("{:g}", s.initial), s.doc});
    return table("controls", rows);
}

const char* shape_name(gault_shape shape) {
    return shape == GAULT_SCALAR ? "scalar" : shape == GAULT_VECTOR ? "vector" : "symmetric tensor";
}

std::string state_table(const gault_material_api& api) {
    if (api.instance_states) return "\nstates: depend on the parameters\n";
    if (api.state_count == 0) return "\nstates: none\n";
    std::vector<Row> rows{{"name", "unit", "shape", "initial", "from", "to", "meaning"}};
    for (const gault_state& s : std::span(api.states, api.state_count))
        rows.push_back({s.name, s.unit, shape_name(s.shape), fmt::format("{:g}", s.initial),
                        fmt::format("{:g}", s.min), fmt::format("{:g}", s.max), s.doc});
    return table("states", rows);
}

std::string names(const std::string& title, const char* const* list) {
    std::string text;
    for (; list && *list; ++list)
        text += fmt::format("{}{}", text.empty() ? "" : ", ", *list);
    return text.empty() ? "" : fmt::format("\n{}: {}\n", title, text);
}

std::string details(const gault_material_api& api) {
    std::string text = state_table(api) + names("asks the host for", api.inputs);
    text += api.flags & GAULT_HAS_TANGENT ? "\ntangent: its own\n"
                                          : "\ntangent: differentiated numerically by the host\n";
    if (api.flags & GAULT_FINITE_STRAIN) text += "\nkinematics: wants the deformation gradient\n";
    if (api.flags & GAULT_RATE_DEPENDENT) text += "\nrate: its answer depends on it\n";
    if (api.flags & GAULT_ONE_AT_A_TIME) text += "\nthreads: one call at a time\n";
    return text;
}

std::string details(const gault_boundary_api& api) {
    const char* imposes = !api.load        ? "prescribed velocities"
                          : !api.constrain ? "loads"
                                           : "prescribed velocities, loads";
    std::string text = control_table(api) + fmt::format("\nimposes: {}\n", imposes);
    if (api.flags & GAULT_BOUNDARY_UNIFORM) text += "\nalong an axis: the same everywhere\n";
    if (api.flags & GAULT_BOUNDARY_HOLDS_NORMAL) text += "\nacross the surface: holds it still, no more\n";
    if (api.flags & GAULT_BOUNDARY_ELASTIC_BEHIND) text += "\nstands for: elastic soil without bound\n";
    return text;
}

std::string details(const gault_program_api& api) {
    const gault_program_signals none{};
    const gault_program_signals& s = api.signals ? *api.signals : none;
    const bool listed = s.measure_count + s.control_count + s.record_count > 0;
    std::string text;
    if (listed || !api.instance_signals)
        text = signal_table("measures", s.measures, s.measure_count) +
               signal_table("controls", s.controls, s.control_count) +
               signal_table("records", s.records, s.record_count);
    if (api.instance_signals)
        text += listed ? "\nwhich controls it needs depends on the parameters\n"
                       : "\nmeasures, controls, records: depend on the parameters\n";
    if (api.evaluate) text += "\nresults: derived from the history when it is done\n";
    return text;
}

std::string details(const gault_observer_api& api) {
    return signal_table("measures", api.measures, api.measure_count) +
           signal_table("results", api.results, api.result_count) + names("asks for the states", api.fields);
}

std::string details(const gault_component& c) {
    switch (c.kind) {
    case GAULT_MATERIAL:
        return details(*static_cast<const gault_material_api*>(c.api));
    case GAULT_BOUNDARY:
        return details(*static_cast<const gault_boundary_api*>(c.api));
    case GAULT_PROGRAM:
        return details(*static_cast<const gault_program_api*>(c.api));
    default:
        return details(*static_cast<const gault_observer_api*>(c.api));
    }
}

} // namespace

std::string describe(const Component& component) {
    const gault_component& c = *component.declaration;
    const gault_module& m = *component.module;
    std::string text = fmt::format("{} {} {}\n    {}\n", kind_name(c.kind), c.name, c.version, c.doc);
    if (*c.reference) text += fmt::format("    reference  {}\n", c.reference);
    const std::string about =
        joined({fmt::format("{} {}", m.name, m.version), m.author, m.license, m.built_with});
    text += fmt::format("    module     {}\n    file       {}\n", about, component.file.string());
    return text + parameter_table(c) + details(c);
}

} // namespace gault::core
