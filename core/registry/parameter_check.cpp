#include "core/registry/module_check.hpp"

#include <cmath>
#include <fmt/format.h>
#include <set>
#include <stdexcept>

namespace gault::core {
namespace {

constexpr int deepest = 4; // records within records; also ends a kind that contains itself

bool has_bounds(const gault_parameter& p) {
    return p.type == GAULT_REAL || p.type == GAULT_INTEGER || p.type == GAULT_LIST || p.type == GAULT_TABLE;
}

void check_bounds(const gault_parameter& p, const std::string& owner) {
    check_that(!std::isnan(p.min) && !std::isnan(p.max), owner, "has a bound that is not a number");
    check_that(p.min <= p.max, owner, fmt::format("has min {} above max {}", p.min, p.max));
    const bool open = p.flags & (GAULT_MIN_OPEN | GAULT_MAX_OPEN);
    check_that(p.min < p.max || !open, owner,
               fmt::format("allows no value: its open bounds are both {}", p.min));
}

std::int64_t check_choices(const gault_parameter& p, const std::string& owner) {
    check_that(p.choices && p.choices[0], owner, "is a choice without choices");
    std::set<std::string> seen;
    std::int64_t count = 0;
    for (; p.choices[count]; ++count) {
        check_that(is_text(p.choices[count]), owner, fmt::format("has an empty word as choice {}", count));
        check_that(seen.insert(p.choices[count]).second, owner,
                   fmt::format("offers '{}' twice", p.choices[count]));
    }
    return count;
}

void check_fallback(const gault_parameter& p, std::int64_t choice_count, const std::string& owner) {
    const double x = p.fallback;
    if (p.type == GAULT_REAL || p.type == GAULT_INTEGER) {
        check_that(std::isfinite(x) && (p.type == GAULT_REAL || (x == std::trunc(x) && std::abs(x) < 0x1p63)),
                   owner,
                   fmt::format("has the default {}, which is no {} number", x,
                               p.type == GAULT_REAL ? "finite" : "whole"));
        const bool above = p.flags & GAULT_MIN_OPEN ? x > p.min : x >= p.min;
        const bool below = p.flags & GAULT_MAX_OPEN ? x < p.max : x <= p.max;
        check_that(above && below, owner,
                   fmt::format("has the default {}, outside its bounds {} and {}", x, p.min, p.max));
    } else if (p.type == GAULT_BOOLEAN) {
        check_that(x == 0.0 || x == 1.0, owner, fmt::format("has the default {}; a boolean is 0 or 1", x));
    } else if (p.type == GAULT_CHOICE) {
        check_that(x == std::trunc(x) && x >= 0 && x < static_cast<double>(choice_count), owner,
                   fmt::format("has the default {}, an index into {} choices", x, choice_count));
    } else {
        check_that(false, owner, "has no default (its type has none) and says neither REQUIRED nor OPTIONAL");
    }
}

void check_list(const gault_parameter* const* parameters, const std::string& owner, int depth);

void check_kinds(const gault_parameter& p, const std::string& owner, int depth) {
    check_that(depth < deepest, owner, fmt::format("nests records more than {} deep", deepest));
    check_that(p.kinds && p.kinds[0], owner, "is a list of records without kinds");
    std::set<std::string> seen;
    for (const gault_record_kind* const* k = p.kinds; *k; ++k) {
        const gault_record_kind& kind = **k;
        check_size(kind.size, GAULT_BYTES_1_0(gault_record_kind, parameters), owner, "a record kind of ");
        check_name(kind.name, owner + ": a record kind");
        const std::string name = fmt::format("{}: record kind '{}'", owner, kind.name);
        check_that(seen.insert(kind.name).second, name, "is declared twice");
        check_reserved(kind.reserved, name);
        check_that(is_text(kind.doc), name, "has no doc");
        check_list(kind.parameters, name, depth + 1);
    }
}

void check_parameter(const gault_parameter& p, const std::string& owner, int depth) {
    check_that(
        p.type >= GAULT_REAL && p.type <= GAULT_RECORDS, owner,
        fmt::format("has the unknown type {}; the host knows {} to {}", p.type, +GAULT_REAL, +GAULT_RECORDS));
    check_flags(p.flags, GAULT_REQUIRED | GAULT_OPTIONAL | GAULT_MIN_OPEN | GAULT_MAX_OPEN, owner);
    check_reserved(p.reserved, owner);
    check_that(is_text(p.doc), owner, "has no doc");
    check_that(p.symbol, owner, "has NULL as its symbol; the host expects a text, which may be empty");
    check_that(!has_bounds(p) || is_text(p.unit), owner, "has no unit; a pure number has the unit \"1\"");
    check_that(p.type != GAULT_TABLE || is_text(p.x_unit), owner, "is a table without an x_unit");
    check_that(!(p.flags & GAULT_REQUIRED) || !(p.flags & GAULT_OPTIONAL), owner,
               "is both REQUIRED and OPTIONAL");
    if (has_bounds(p)) check_bounds(p, owner);
    check_that(p.min_count >= 0 && p.max_count >= 0 && (p.max_count == 0 || p.min_count <= p.max_count),
               owner, fmt::format("wants {} to {} entries", p.min_count, p.max_count));
    const std::int64_t choice_count = p.type == GAULT_CHOICE ? check_choices(p, owner) : 0;
    if (p.type == GAULT_RECORDS) check_kinds(p, owner, depth);
    if (!(p.flags & (GAULT_REQUIRED | GAULT_OPTIONAL))) check_fallback(p, choice_count, owner);
}

void check_list(const gault_parameter* const* parameters, const std::string& owner, int depth) {
    check_that(parameters, owner, "has NULL as its parameters; the host expects a list that ends with NULL");
    std::set<std::string> seen;
    for (; *parameters; ++parameters) {
        const gault_parameter& p = **parameters;
        check_size(p.size, GAULT_BYTES_1_0(gault_parameter, max_count), owner, "a parameter of ");
        check_name(p.name, owner + ": a parameter");
        const std::string name = fmt::format("{}: parameter '{}'", owner, p.name);
        check_that(seen.insert(p.name).second, name, "is declared twice");
        check_parameter(p, name, depth);
    }
}

} // namespace

void check_parameters(const gault_parameter* const* parameters, const std::string& owner) {
    check_list(parameters, owner, 0);
}

} // namespace gault::core
