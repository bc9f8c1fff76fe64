#include "core/config/overrides.hpp"

#include <charconv>
#include <optional>

namespace gault::core::config {
namespace {

std::vector<std::string> split_at_dots(const std::string& key) {
    std::vector<std::string> words(1);
    for (const char c : key) {
        if (c == '.')
            words.emplace_back();
        else
            words.back() += c;
    }
    return words;
}

void move_to(Node& node, const Place& place) {
    node.place = place;
    for (auto& key : node.keys)
        key.place = place;
    for (auto& item : node.items)
        move_to(item, place);
}

Node parse_value(const Override& change, const Place& place) {
    try {
        Node value = parse_document(change.value, "");
        move_to(value, place);
        return value;
    } catch (const InputError& error) { // its position is one in the value
        throw InputError(place.location(), std::string("position ") + error.what());
    }
}

std::optional<std::size_t> index_of(const std::string& word, std::size_t count) {
    std::size_t index = 0;
    const auto read = std::from_chars(word.data(), word.data() + word.size(), index);
    if (read.ec != std::errc{} || read.ptr != word.data() + word.size() || index >= count)
        return std::nullopt;
    return index;
}

Node& list_item(Node& list, const std::string& word, const std::string& path, const Location& where) {
    const std::size_t count = list.items.size();
    const auto index = index_of(word, count + 1);
    if (!index)
        throw InputError(where, path + " is a list, items 0 to " + std::to_string(count) +
                                    ", of which the last would be new; found " + in_quotes(word));
    if (*index == count) list.items.emplace_back();
    return list.items[*index];
}

Node& map_item(Node& map, const std::string& word, const Place& place) {
    for (std::size_t i = 0; i < map.keys.size(); ++i)
        if (map.keys[i].text == word) return map.items[i];
    map.kind = NodeKind::map;
    map.keys.push_back({word, place});
    map.items.emplace_back().place = place;
    return map.items.back();
}

} // namespace

void apply_override(Node& root, const Override& change) {
    const Place place{std::make_shared<const std::string>("--set " + change.key)};
    const auto words = split_at_dots(change.key);
    if (words.size() > deepest)
        throw InputError(place.location(), "more than " + std::to_string(deepest) + " levels");
    Node* node = &root;
    std::string path = "the scene";
    for (const auto& word : words) {
        if (word.empty() || word.size() > longest_key)
            throw InputError(place.location(), "a key is words with dots between them, like grid.cells.0");
        if (node->kind == NodeKind::scalar && node->text == "auto") *node = Node{};
        if (node->kind == NodeKind::scalar)
            throw InputError(place.location(), path + " is a single value, " + in_quotes(node->text) +
                                                   "; it has no " + in_quotes(word));
        node = node->kind == NodeKind::list ? &list_item(*node, word, path, place.location())
                                            : &map_item(*node, word, place);
        path = path == "the scene" ? word : path + "." + word;
    }
    *node = parse_value(change, place);
}

} // namespace gault::core::config
