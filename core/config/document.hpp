// A YAML file as a tree that knows where each word stands. Duplicate keys, cyclic aliases, tags, tabs,
// several documents and what is not text are refused here.
#pragma once
#include "core/base/error.hpp"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace gault::core::config {

enum class NodeKind { null, scalar, list, map };

struct Place { // a Location that shares its file name
    std::shared_ptr<const std::string> file;
    int line = 0, column = 0;
    Location location() const { return {file ? *file : "", line, column}; }
};

struct Key {
    std::string text;
    Place place;
};

struct Node {
    NodeKind kind = NodeKind::null;
    bool quoted = false, flow = false; // how it was written, kept for writing it again
    std::string text;                  // scalar
    std::vector<Key> keys;             // map: one per item, all different
    std::vector<Node> items;           // list or map
    Place place;

    Location where() const { return place.location(); }
    const Node* find(std::string_view key) const; // null where the key is absent
};

constexpr std::size_t largest_file = std::size_t{1} << 20; // bytes
constexpr std::size_t most_nodes = 100000;                 // aliases expanded
constexpr int deepest = 64;                                // levels
constexpr std::size_t longest_key = 256;                   // bytes

// Throws InputError: a folder, unreadable, larger than largest_file.
std::string read_text(const std::filesystem::path& file);

// `file` is what locations name. Throws InputError.
Node parse_document(std::string text, const std::string& file);

std::string emit(const Node& node);

std::size_t size_of(const Node& node); // with everything below it

// `text` in quotes, on one line, shortened.
std::string in_quotes(std::string_view text);

// "a map", "a list", "'text'", "nothing"
std::string described(const Node& node);

} // namespace gault::core::config
