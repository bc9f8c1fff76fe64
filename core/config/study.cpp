#include "core/config/study.hpp"

#include "core/config/reader.hpp"
#include "core/config/sections.hpp"

#include <cstdlib>

namespace gault::core {
namespace config {
namespace {

const std::vector<std::string> keys = {"gault",  "title", "scene", "repeat",  "errors",
                                       "values", "curve", "set",   "families"};

Node parse_study(const std::filesystem::path& file) {
    Node root = parse_document(read_text(file), file.string());
    if (root.kind != NodeKind::map)
        throw InputError(Location{file.string(), 1, 1}, "a study is a map of keys; found " + described(root));
    return root;
}

// A value as it would be typed after --set KEY=.
std::string in_line(const Node& node) {
    if (node.kind == NodeKind::scalar) return node.quoted ? "'" + node.text + "'" : node.text;
    std::string text;
    for (std::size_t i = 0; i < node.items.size(); ++i)
        text += (i ? ", " : "") + (node.kind == NodeKind::map ? node.keys[i].text + ": " : std::string()) +
                in_line(node.items[i]);
    return node.kind == NodeKind::map ? "{" + text + "}" : "[" + text + "]";
}

// The first number in a value: 72 of [72, 1] and of {cells: [72, 1]}, 0.1 of 0.1 %.
double number_in(const Node& node) {
    if (!node.items.empty()) return number_in(node.items[0]);
    const char* begin = node.text.c_str();
    char* end = nullptr;
    const double value = std::strtod(begin, &end);
    return end == begin ? std::numeric_limits<double>::quiet_NaN() : value;
}

int read_threads(const Node& node, const std::string& path) {
    return static_cast<int>(read_integer(node, path, {.min = 1, .max = 1024}));
}

// {key: value}, keys of the scene with dots; `threads` is the run's own.
void add_settings(const Node& map, const std::string& path, std::vector<Override>& set, int& threads) {
    require_kind(map, NodeKind::map, path);
    for (std::size_t i = 0; i < map.keys.size(); ++i) {
        const std::string& key = map.keys[i].text;
        if (key == "threads")
            threads = read_threads(map.items[i], path + ".threads");
        else
            set.push_back({key, in_line(map.items[i])});
    }
}

std::string last_word(const std::string& key) {
    return key.substr(key.rfind('.') + 1);
}

// The lists of `vary` run together: the first member takes the first item of each.
std::vector<Study::Member> read_members(const Node* vary, const std::string& path, int threads) {
    if (vary == nullptr) return {{"", {}, threads}};
    require_kind(*vary, NodeKind::map, path);
    if (vary->keys.empty()) throw InputError(vary->where(), path + " is empty");
    std::vector<Study::Member> members;
    for (std::size_t k = 0; k < vary->keys.size(); ++k) {
        const std::string& key = vary->keys[k].text;
        const Node& list = require_kind(vary->items[k], NodeKind::list, path + "." + key);
        if (k == 0) members.resize(list.items.size(), {"", {}, threads});
        if (list.items.empty() || list.items.size() != members.size())
            throw InputError(list.where(), path + "." + key + " has " + std::to_string(list.items.size()) +
                                               " items; " + vary->keys[0].text + ", which varies with it, " +
                                               std::to_string(members.size()));
        for (std::size_t i = 0; i < members.size(); ++i) {
            Study::Member& member = members[i];
            const Node& value = list.items[i];
            if (key == "threads")
                member.threads = read_threads(value, path + ".threads." + std::to_string(i));
            else
                member.set.push_back({key, in_line(value)});
            member.label += (k ? ", " : "") + last_word(key) + " " + in_line(value);
            if (k == 0) member.size = number_in(value);
        }
    }
    return members;
}

void put_labels(const Node& list, const std::string& path, std::vector<Study::Member>& members) {
    require_kind(list, NodeKind::list, path);
    if (list.items.size() != members.size())
        throw InputError(list.where(), path + " has " + std::to_string(list.items.size()) + " items for " +
                                           std::to_string(members.size()) + " members");
    for (std::size_t i = 0; i < members.size(); ++i)
        members[i].label = read_name(list.items[i], path + "." + std::to_string(i));
}

Study::Family read_family(const Node& node, const std::string& path, const std::vector<Override>& common,
                          int threads) {
    const Fields fields(node, path, {"name", "set", "vary", "labels"});
    Study::Family family{read_name(fields.require("name"), fields.path("name")), common, {}};
    if (const Node* set = fields.find("set")) add_settings(*set, fields.path("set"), family.set, threads);
    family.members = read_members(fields.find("vary"), fields.path("vary"), threads);
    if (const Node* labels = fields.find("labels"))
        put_labels(*labels, fields.path("labels"), family.members);
    return family;
}

std::vector<Study::Measure> read_measures(const Node& map, const std::string& path) {
    require_kind(map, NodeKind::map, path);
    std::vector<Study::Measure> measures;
    for (std::size_t i = 0; i < map.keys.size(); ++i) {
        Study::Measure measure{map.keys[i].text, {}};
        for (const Node* place : one_or_more(map.items[i])) {
            measure.places.push_back(read_name(*place, path + "." + measure.name));
            if (measure.places.back()[0] != '/')
                throw InputError(place->where(), path + "." + measure.name +
                                                     ": a JSON pointer begins with '/', like "
                                                     "/reference/curves/0/largest_relative_error");
        }
        measures.push_back(std::move(measure));
    }
    return measures;
}

std::array<std::string, 2> read_axes(const Fields& root) {
    const Fields fields = root.section("curve", {"x", "y"});
    return {read_name(fields.require("x", "a column of the history"), "curve.x"),
            read_name(fields.require("y", "a column of the history"), "curve.y")};
}

} // namespace
} // namespace config

bool is_study(const std::filesystem::path& file) {
    const config::Node root = config::parse_study(file);
    return root.find("scene") || root.find("families");
}

Study read_study(const std::filesystem::path& file) {
    using namespace config;
    const Node document = parse_study(file);
    const Fields root(document, "", keys);
    check_version(root);
    Study study;
    study.scene = existing_file(root.require("scene", "the file of the scene that is run"), "scene",
                                file.parent_path());
    study.title = root.find("title") ? read_text_value(*root.find("title"), "title") : file.stem().string();
    if (const Node* repeat = root.find("repeat"))
        study.repeat = static_cast<int>(read_integer(*repeat, "repeat", {.min = 1, .max = 1000}));
    if (const Node* errors = root.find("errors")) study.errors = read_measures(*errors, "errors");
    if (const Node* values = root.find("values")) study.values = read_measures(*values, "values");
    if (root.find("curve")) study.curve = read_axes(root);
    std::vector<Override> common;
    int threads = 0;
    if (const Node* set = root.find("set")) add_settings(*set, "set", common, threads);
    const Node& families =
        require_kind(root.require("families", "a list of {name, set, vary}"), NodeKind::list, "families");
    if (families.items.empty()) throw InputError(families.where(), "families is empty");
    for (std::size_t i = 0; i < families.items.size(); ++i) {
        study.families.push_back(
            read_family(families.items[i], "families." + std::to_string(i), common, threads));
        for (std::size_t before = 0; before < i; ++before)
            if (study.families[before].name == study.families[i].name)
                throw InputError(families.items[i].where(),
                                 "a second family " + in_quotes(study.families[i].name));
    }
    return study;
}

} // namespace gault::core
