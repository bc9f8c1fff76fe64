// The keys of one map of a scene, and values of the plain kinds. Every error has its location and says what
// is allowed.
#pragma once
#include "core/config/document.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace gault::core::config {

struct Bounds {
    double min = -HUGE_VAL, max = HUGE_VAL; // SI
    bool min_open = false, max_open = false;
    bool hold(double value) const {
        return (min_open ? value > min : value >= min) && (max_open ? value < max : value <= max);
    }
    std::string text(const std::string& unit) const; // "at least 0 Pa and below 5 Pa"
};

constexpr Bounds positive{.min = 0.0, .min_open = true};
constexpr Bounds not_negative{.min = 0.0};

// A map whose keys are all among `keys`. `path` names it in messages, as --set does: "materials.sand".
class Fields {
  public:
    Fields(const Node& map, std::string path, const std::vector<std::string>& keys);

    const std::string& path() const { return path_; }
    std::string path(std::string_view key) const {
        return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
    }
    Location where() const { return map_.where(); }

    const Node* find(std::string_view key) const; // null where absent; a key without a value is an error
    const Node& require(std::string_view key, std::string_view meaning = "") const;
    // The map at `key`, without a key where it is absent or the word auto.
    Fields section(std::string_view key, const std::vector<std::string>& keys) const;

    // `otherwise` where the key is absent
    double quantity(std::string_view key, const std::string& unit, const Bounds& bounds) const; // required
    double quantity(std::string_view key, const std::string& unit, const Bounds& bounds,
                    double otherwise) const;

  private:
    const Node& map_;
    std::string path_;
};

bool is_auto(const Node* node); // absent, or the word auto

// `path` names the value in messages.
double read_quantity(const Node& node, const std::string& path, const std::string& unit,
                     const Bounds& bounds = {}, std::string_view meaning = "");
std::int64_t read_integer(const Node& node, const std::string& path, const Bounds& bounds = {},
                          std::string_view meaning = "");
const std::string& read_text_value(const Node& node, const std::string& path); // any single value
const std::string& read_name(const Node& node, const std::string& path); // one that fits a line of a message
std::size_t read_choice(const Node& node, const std::string& path, const std::vector<std::string>& choices);
std::array<double, 2> read_range(const Node& node, const std::string& path,
                                 const std::string& unit); // low < high

// The items of a list; a single value counts as a list of one.
std::vector<const Node*> one_or_more(const Node& node);

const Node& require_kind(const Node& node, NodeKind kind, const std::string& path);

// The place of `name` in `names`; InputError with the nearest otherwise.
int index_of_name(const Node& node, const std::string& path, const std::vector<std::string>& names,
                  const std::string& what);

// "; did you mean 'x'?; allowed: a, b", for a word of any length.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

} // namespace gault::core::config
