#include "core/base/units.hpp"

#include "core/base/suggest.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <udunits2.h>
#include <vector>

namespace gault::core {
namespace {

struct FreeUnit {
    void operator()(ut_unit* unit) const { ut_free(unit); }
};
struct FreeConverter {
    void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;
using Converter = std::unique_ptr<cv_converter, FreeConverter>;

// offered in messages, the usual ones first; those that convert to the wanted unit are picked
const std::vector<std::string> common_units = {
    "Pa",     "kPa",   "MPa",  "GPa",  "hPa",    "bar",   "kN/m^2", "N/mm^2", "m",     "mm",      "cm",
    "um",     "km",    "deg",  "rad",  "s",      "ms",    "min",    "h",      "day",   "kg/m^3",  "t/m^3",
    "g/cm^3", "m/s",   "mm/s", "cm/s", "mm/min", "1/s",   "%/s",    "1/min",  "%/min", "m/s^2",   "N",
    "kN",     "MN",    "J",    "kJ",   "kN/m^3", "N/m^3", "kPa/m",  "Pa/m",   "kPa/s", "kPa/min", "Pa/s",
    "Pa s",   "kPa s", "m^2",  "cm^2", "mm^2",   "m^3",   "cm^3",   "mPa",    "kg",    "t",       "%"};

ut_system* load_system() {
    ut_set_error_message_handler(ut_ignore);
    ut_system* system = ut_read_xml(nullptr);
    if (system == nullptr)
        throw std::runtime_error(
            "the units database of udunits2 cannot be read; set UDUNITS2_XML_PATH to udunits2.xml");
    const Unit degree(ut_get_unit_by_name(system, "degree"));
    ut_map_name_to_unit("deg", UT_ASCII, degree.get());
    return system;
}

// one for the process: never freed, reachable until exit
ut_system* units() {
    static ut_system* const system = load_system();
    return system;
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_space(char c) {
    return c == ' ' || c == '\t';
}

std::string trimmed(std::string_view text) {
    std::string plain(text);
    for (const std::string_view space : {"\u00a0", "\u202f"}) // typeset documents put these before a unit
        for (auto at = plain.find(space); at != std::string::npos; at = plain.find(space))
            plain.replace(at, space.size(), " ");
    while (!plain.empty() && is_space(plain.back()))
        plain.pop_back();
    plain.erase(0, plain.find_first_not_of(" \t"));
    return plain;
}

// A unit's name: letters, %, and whatever is not ASCII (°, µ, ²).
std::size_t name_length(std::string_view text) {
    std::size_t n = 0;
    while (n < text.size() && (std::isalpha(static_cast<unsigned char>(text[n])) || text[n] == '%' ||
                               text[n] == '_' || static_cast<unsigned char>(text[n]) >= 0x80))
        ++n;
    return n;
}

// An exponent: ^2, ^-2, -2 or 2; one digit.
std::size_t exponent_length(std::string_view text) {
    std::size_t n = 0;
    if (n < text.size() && text[n] == '^') ++n;
    if (n < text.size() && text[n] == '-') ++n;
    if (n < text.size() && is_digit(text[n]))
        return n + 1 < text.size() && is_digit(text[n + 1]) ? std::string_view::npos : n + 1;
    return n == 0 ? 0 : std::string_view::npos;
}

// udunits2 ignores what it cannot use ("mm)"), multiplies numbers ("1 2 kPa"), reads dates ("s @ 5") and
// takes m^0.5 for a factor of 5: only products and quotients of names with whole exponents reach it.
bool well_formed(std::string_view text) {
    if (text.size() > 64) return false;
    if (text.starts_with("1/") || text.starts_with("1 /")) text.remove_prefix(text.find('/') + 1);
    for (;;) {
        while (!text.empty() && is_space(text.front()))
            text.remove_prefix(1);
        const std::size_t name = name_length(text);
        if (name == 0) return false;
        text.remove_prefix(name);
        const std::size_t exponent = exponent_length(text);
        if (exponent == std::string_view::npos) return false;
        text.remove_prefix(exponent);
        if (text.empty()) return true;
        const std::size_t operation = text.find_first_not_of(" \t");
        if (text[operation] == '/' || text[operation] == '*' || text[operation] == '.')
            text.remove_prefix(operation + 1);
        else if (operation == 0)
            return false;
    }
}

Unit parse_unit(const std::string& text) {
    if (text == "1") return Unit(ut_get_dimensionless_unit_one(units()));
    return well_formed(text) ? Unit(ut_parse(units(), text.c_str(), UT_UTF8)) : Unit();
}

// The unit in base units without its factor: "m-1.kg.s-2", "rad", "". udunits2 itself would also convert rad
// to 1 and s to 1/s, which in a scene are mistakes.
std::string dimension(const ut_unit* unit) {
    std::array<char, 256> text{};
    const int length = ut_format(unit, text.data(), text.size() - 1, UT_ASCII | UT_DEFINITION);
    std::string_view definition(text.data(), length > 0 ? static_cast<std::size_t>(length) : 0);
    double factor = 0.0;
    const auto number = std::from_chars(definition.data(), definition.data() + definition.size(), factor);
    definition.remove_prefix(static_cast<std::size_t>(number.ptr - definition.data()));
    if (definition == " 1") // a percentage
        return "";
    if (definition.starts_with(" ")) definition.remove_prefix(1);
    return std::string(definition);
}

std::vector<std::string> units_like(std::string_view wanted_text, const ut_unit* wanted) {
    const std::string wanted_dimension = dimension(wanted);
    std::vector<std::string> like;
    for (const auto& name : common_units)
        if (dimension(parse_unit(name).get()) == wanted_dimension) like.push_back(name);
    if (std::find(like.begin(), like.end(), wanted_text) == like.end())
        like.insert(like.begin(), std::string(wanted_text));
    return like;
}

std::string lower_case(std::string_view text) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return lower;
}

// "; did you mean 'MPa' or 'mPa'?" where only the case differs, otherwise the nearest, otherwise what is
// allowed.
std::string hint(const std::string& found, std::string_view wanted_text, const ut_unit* wanted) {
    const auto like = units_like(wanted_text, wanted);
    std::string same_letters;
    for (const auto& name : like)
        if (lower_case(name) == lower_case(found))
            same_letters += (same_letters.empty() ? "'" : " or '") + name + "'";
    if (!same_letters.empty()) return "; did you mean " + same_letters + "?";
    if (const std::string near = nearest(found.substr(0, 64), like); !near.empty())
        return "; did you mean '" + near + "'?";
    if (wanted_text == "1") return "; write a bare number or a percentage";
    std::string allowed = "; allowed: " + like.front();
    for (std::size_t i = 1; i < std::min<std::size_t>(like.size(), 4); ++i)
        allowed += ", " + like[i];
    return allowed + (like.size() > 4 ? ", ..." : "");
}

[[noreturn]] void refuse(std::string_view text, const std::string& why) {
    throw std::invalid_argument("'" + std::string(text) + "'" + why);
}

struct NumberAndUnit {
    double number;
    std::string unit;
};

NumberAndUnit split(const std::string& text) {
    std::string_view rest = text;
    if (rest.size() > 1 && rest[0] == '+' && (is_digit(rest[1]) || rest[1] == '.')) rest.remove_prefix(1);
    NumberAndUnit result{};
    const auto read = std::from_chars(rest.data(), rest.data() + rest.size(), result.number);
    if (read.ec == std::errc::result_out_of_range) refuse(text, " is beyond the range of numbers");
    if (read.ec != std::errc{}) refuse(text, " is not a number with a unit");
    if (!std::isfinite(result.number)) refuse(text, " is not a finite number");
    rest.remove_prefix(static_cast<std::size_t>(read.ptr - rest.data()));
    if (rest.starts_with(",")) refuse(text, " has a comma in its number; write 1000.5, without commas");
    result.unit = trimmed(rest);
    if (result.unit.starts_with("/")) result.unit.insert(0, "1");
    return result;
}

double convert(double number, const ut_unit* from, const ut_unit* to) {
    const Converter converter(ut_get_converter(const_cast<ut_unit*>(from), const_cast<ut_unit*>(to)));
    const double factor = cv_convert_double(converter.get(), 1.0);
    if (cv_convert_double(converter.get(), 0.0) != 0.0) return cv_convert_double(converter.get(), number);
    // 7 % is 7 / 100, correctly rounded, rather than 7 * 0.01; 1000.0000000000001 is 1000
    const double whole = std::round(factor >= 1.0 ? factor : 1.0 / factor);
    if (std::abs((factor >= 1.0 ? factor / whole : whole * factor) - 1.0) > 1e-14) return number * factor;
    return factor >= 1.0 ? number * whole : number / whole;
}

} // namespace

double parse_quantity(std::string_view text, std::string_view unit) {
    const std::string plain = trimmed(text);
    const std::string wanted_text(unit.empty() ? "1" : unit);
    const Unit wanted = parse_unit(wanted_text);
    if (!wanted) throw std::invalid_argument("the declared unit '" + wanted_text + "' is not known");
    const NumberAndUnit found = split(plain);
    if (found.unit.empty()) {
        if (wanted_text != "1" && found.number != 0.0)
            refuse(plain, " has no unit; write for example '" + plain + " " +
                              units_like(wanted_text, wanted.get()).front() + "'" +
                              hint("", wanted_text, wanted.get()));
        return found.number;
    }
    const Unit given = parse_unit(found.unit);
    if (!given)
        refuse(plain, ": '" + found.unit + "' is not a unit" + hint(found.unit, wanted_text, wanted.get()));
    if (dimension(given.get()) != dimension(wanted.get()))
        refuse(plain, ": '" + found.unit + "' does not convert to " +
                          (wanted_text == "1" ? "a pure number" : "'" + wanted_text + "'") +
                          hint(found.unit, wanted_text, wanted.get()));
    const double value = convert(found.number, given.get(), wanted.get());
    if (!std::isfinite(value)) refuse(plain, " is beyond the range of numbers");
    return value;
}

} // namespace gault::core
