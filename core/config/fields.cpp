#include "core/config/fields.hpp"

#include "core/base/suggest.hpp"
#include "core/base/units.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <stdexcept>

namespace gault::core::config {
namespace {

std::string sentence(std::string_view meaning) {
    return meaning.empty() ? "" : " (" + std::string(meaning) + ")";
}

void check_bounds(double value, const Node& node, const std::string& path, const std::string& unit,
                  const Bounds& bounds, std::string_view meaning) {
    if (!bounds.hold(value))
        throw InputError(node.where(), path + " is " + in_quotes(node.text) + "; it must be " +
                                           bounds.text(unit) + sentence(meaning));
}

std::string number(double value) { // whole ones with all their digits
    return value == std::trunc(value) ? fmt::format("{:.10g}", value) : fmt::format("{:g}", value);
}

bool one_line(const std::string& text) {
    return text.size() <= longest_key &&
           std::all_of(text.begin(), text.end(), [](unsigned char c) { return c >= 0x20; });
}

} // namespace

std::string Bounds::text(const std::string& unit) const {
    const std::string suffix = unit.empty() || unit == "1" ? "" : " " + unit;
    const std::string low = (min_open ? "more than " : "at least ") + number(min) + suffix;
    const std::string high = (max_open ? "less than " : "at most ") + number(max) + suffix;
    if (min == -HUGE_VAL) return max == HUGE_VAL ? "a number" : high;
    return max == HUGE_VAL ? low : low + " and " + high;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
    return suggestion(word.substr(0, 64), candidates);
}

Fields::Fields(const Node& map, std::string path, const std::vector<std::string>& keys)
    : map_(map), path_(std::move(path)) {
    require_kind(map, NodeKind::map, path_.empty() ? "the scene" : path_);
    for (const auto& key : map.keys)
        if (std::find(keys.begin(), keys.end(), key.text) == keys.end())
            throw InputError(key.place.location(), "unknown key " + in_quotes(key.text) + " in " +
                                                       (path_.empty() ? "the scene" : path_) +
                                                       did_you_mean(key.text, keys));
}

const Node* Fields::find(std::string_view key) const {
    const Node* node = map_.find(key);
    if (node != nullptr && node->kind == NodeKind::null)
        throw InputError(node->where(), path(key) + " has no value");
    return node;
}

const Node& Fields::require(std::string_view key, std::string_view meaning) const {
    if (const Node* node = find(key)) return *node;
    throw InputError(map_.where(), path(key) + " is missing" + sentence(meaning));
}

Fields Fields::section(std::string_view key, const std::vector<std::string>& keys) const {
    static const Node absent = [] {
        Node map;
        map.kind = NodeKind::map;
        return map;
    }();
    const Node* node = find(key);
    return Fields(is_auto(node) ? absent : *node, path(key), keys);
}

double Fields::quantity(std::string_view key, const std::string& unit, const Bounds& bounds) const {
    return read_quantity(require(key), path(key), unit, bounds);
}

double Fields::quantity(std::string_view key, const std::string& unit, const Bounds& bounds,
                        double otherwise) const {
    const Node* node = find(key);
    return node == nullptr ? otherwise : read_quantity(*node, path(key), unit, bounds);
}

bool is_auto(const Node* node) {
    return node == nullptr || (node->kind == NodeKind::scalar && node->text == "auto");
}

const Node& require_kind(const Node& node, NodeKind kind, const std::string& path) {
    if (node.kind == kind) return node;
    if (node.kind == NodeKind::null) throw InputError(node.where(), path + " has no value");
    const std::string wanted = kind == NodeKind::map    ? "a map of keys"
                               : kind == NodeKind::list ? "a list"
                                                        : "a single value";
    throw InputError(node.where(), path + " must be " + wanted + "; found " + described(node));
}

double read_quantity(const Node& node, const std::string& path, const std::string& unit, const Bounds& bounds,
                     std::string_view meaning) {
    const std::string& text = require_kind(node, NodeKind::scalar, path).text;
    if (!one_line(text)) throw InputError(node.where(), path + ": " + in_quotes(text) + " is not a number");
    try {
        const double value = parse_quantity(text, unit);
        check_bounds(value, node, path, unit, bounds, meaning);
        return value;
    } catch (const std::invalid_argument& error) {
        throw InputError(node.where(), path + ": " + error.what());
    }
}

std::int64_t read_integer(const Node& node, const std::string& path, const Bounds& bounds,
                          std::string_view meaning) {
    const std::string& text = require_kind(node, NodeKind::scalar, path).text;
    std::int64_t value = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec != std::errc{} || read.ptr != text.data() + text.size())
        throw InputError(node.where(),
                         path + " must be a whole number; found " + in_quotes(text) + sentence(meaning));
    check_bounds(static_cast<double>(value), node, path, "1", bounds, meaning);
    return value;
}

const std::string& read_text_value(const Node& node, const std::string& path) {
    return require_kind(node, NodeKind::scalar, path).text;
}

const std::string& read_name(const Node& node, const std::string& path) {
    const std::string& text = read_text_value(node, path);
    if (text.empty() || !one_line(text))
        throw InputError(node.where(), path + " must be a name on one line; found " + in_quotes(text));
    return text;
}

std::size_t read_choice(const Node& node, const std::string& path, const std::vector<std::string>& choices) {
    const std::string& text = read_text_value(node, path);
    const auto found = std::find(choices.begin(), choices.end(), text);
    if (found == choices.end())
        throw InputError(node.where(), path + " cannot be " + in_quotes(text) + did_you_mean(text, choices));
    return static_cast<std::size_t>(found - choices.begin());
}

std::array<double, 2> read_range(const Node& node, const std::string& path, const std::string& unit) {
    require_kind(node, NodeKind::list, path);
    if (node.items.size() != 2)
        throw InputError(node.where(), path + " must be [low, high]; found " +
                                           std::to_string(node.items.size()) +
                                           (node.items.size() == 1 ? " item" : " items"));
    const std::array<double, 2> range{read_quantity(node.items[0], path + ".0", unit),
                                      read_quantity(node.items[1], path + ".1", unit)};
    if (!(range[0] < range[1]))
        throw InputError(node.where(), path + " must rise; found " + described(node.items[0]) + " to " +
                                           described(node.items[1]));
    return range;
}

std::vector<const Node*> one_or_more(const Node& node) {
    if (node.kind != NodeKind::list) return {&node};
    std::vector<const Node*> items;
    for (const auto& item : node.items)
        items.push_back(&item);
    return items;
}

int index_of_name(const Node& node, const std::string& path, const std::vector<std::string>& names,
                  const std::string& what) {
    const std::string& name = read_name(node, path);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw InputError(node.where(),
                         path + ": unknown " + what + " " + in_quotes(name) + did_you_mean(name, names));
    return static_cast<int>(found - names.begin());
}

} // namespace gault::core::config
