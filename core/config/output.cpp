#include "core/config/component.hpp"
#include "core/config/records.hpp"
#include "core/config/sections.hpp"

#include <algorithm>
#include <cmath>

namespace gault::core::config {
namespace {

Key key_of(const Node& name, const std::string& path) {
    return {read_name(name, path), name.place};
}

void add_value(std::vector<double>& values, double value, const Location& where, const std::string& path) {
    if (std::find(values.begin(), values.end(), value) != values.end())
        throw InputError(where, path + " repeats a value");
    values.push_back(value);
}

FrameRequest read_frames(const Node& node, const Records& records) {
    require_kind(node, NodeKind::map, "output.frames");
    if (node.keys.size() != 1)
        throw InputError(node.where(), "output.frames must be a single {measure: [values]}; found " +
                                           std::to_string(node.keys.size()) + " measures");
    FrameRequest frames;
    frames.measure = node.keys[0].text;
    const std::string path = "output.frames." + frames.measure;
    const std::string unit = records.unit(node.keys[0], "output.frames");
    const auto values = one_or_more(node.items[0]);
    if (values.empty() || values[0]->kind == NodeKind::null)
        throw InputError(node.items[0].where(), path + " has no value");
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::string value_path =
            path + (node.items[0].kind == NodeKind::list ? "." + std::to_string(i) : std::string());
        const Bounds bounds = frames.measure == "time" ? not_negative : Bounds{};
        add_value(frames.values, read_quantity(*values[i], value_path, unit, bounds), values[i]->where(),
                  value_path);
    }
    return frames;
}

CurveReference read_curve(const Node& node, const std::string& path, const Source& source,
                          const Records& records) {
    const Fields fields(node, path, {"x", "y", "file", "range", "noise_range"});
    const Key x = key_of(fields.require("x", "a record of the program"), fields.path("x"));
    const Key y = key_of(fields.require("y", "a record of the program"), fields.path("y"));
    const std::string unit = records.unit(x, fields.path("x"));
    records.unit(y, fields.path("y"));
    CurveReference curve{x.text, y.text, {}, 0.0, 0.0, {}, node.where()};
    curve.file = existing_file(fields.require("file"), fields.path("file"), source.folder);
    const auto range =
        read_range(fields.require("range", "the x compared, [low, high]"), fields.path("range"), unit);
    curve.from = range[0];
    curve.to = range[1];
    if (const Node* noise = fields.find("noise_range"))
        curve.noise = read_range(*noise, fields.path("noise_range"), unit);
    return curve;
}

// A profile is compared at a frame, so there must be one. `key` is the value as written.
void check_frame(const Key& key, const std::string& path, double value, const std::string& measure,
                 const FrameRequest& frames) {
    const bool there = frames.measure == measure &&
                       std::any_of(frames.values.begin(), frames.values.end(), [&](double frame) {
                           return std::abs(frame - value) <= 1e-12 * std::abs(value);
                       });
    if (!there)
        throw InputError(key.place.location(), path + ": there is no frame at " + measure + " " +
                                                   in_quotes(key.text) + "; add it to output.frames");
}

ProfileReference read_profile(const Node& node, const std::string& path, const Source& source,
                              const Records& records, const FrameRequest& frames) {
    const Fields fields(node, path, {"measure", "files"});
    const Key measure = key_of(fields.require("measure", "a record of the program"), fields.path("measure"));
    const std::string unit = records.unit(measure, fields.path("measure"));
    const Node& files =
        require_kind(fields.require("files", "{2.5 %: file.csv, ...}"), NodeKind::map, fields.path("files"));
    if (files.keys.empty()) throw InputError(files.where(), fields.path("files") + " is empty");
    ProfileReference profile{measure.text, {}};
    std::vector<double> values;
    for (std::size_t i = 0; i < files.keys.size(); ++i) {
        const Key& key = files.keys[i];
        Node quantity;
        quantity.kind = NodeKind::scalar;
        quantity.text = key.text;
        quantity.place = key.place;
        const double value = read_quantity(quantity, fields.path("files"), unit);
        add_value(values, value, key.place.location(), fields.path("files"));
        check_frame(key, fields.path("files"), value, measure.text, frames);
        profile.at.push_back(
            {value, existing_file(files.items[i], fields.path("files") + "." + key.text, source.folder)});
    }
    return profile;
}

PalmerReference read_palmer(const Node& node, const Records& records, const FrameRequest& frames) {
    const Fields fields(node, "reference.palmer", {"x", "y", "range", "at"});
    const Key x = key_of(fields.require("x", "the record of the cavity strain"), fields.path("x"));
    const Key y = key_of(fields.require("y", "the record of the true pressure"), fields.path("y"));
    const std::string unit = records.unit(x, fields.path("x"));
    records.unit(y, fields.path("y"));
    const auto range =
        read_range(fields.require("range", "the x compared, [low, high]"), fields.path("range"), unit);
    PalmerReference palmer{x.text, y.text, range[0], range[1], {}, node.where()};
    if (range[0] < 0.0)
        throw InputError(fields.find("range")->where(),
                         fields.path("range") + " begins below 0: a cavity that closes");
    const Node* at = fields.find("at");
    for (const Node* item : at ? one_or_more(*at) : std::vector<const Node*>{}) {
        add_value(palmer.at, read_quantity(*item, fields.path("at"), unit, positive), item->where(),
                  fields.path("at"));
        check_frame({item->text, item->place}, fields.path("at"), palmer.at.back(), palmer.x, frames);
    }
    return palmer;
}

Scene::ObserverUse read_observer(const Node& node, const std::string& path, const Source& source,
                                 const Scene& scene) {
    Scene::ObserverUse observer{{},
                                read_component(node, path, {"on", "type"}, GAULT_OBSERVER, source.registry)};
    if (const Node* on = node.find("on")) observer.surface = surface_index(*on, path + ".on", scene);
    return observer;
}

// Reads one item or a list of them.
template <class Read, class Item>
void read_items(const Fields& fields, const std::string& key, std::vector<Item>& items, Read read) {
    const Node* node = fields.find(key);
    if (node == nullptr) return;
    const auto nodes = one_or_more(*node);
    if (nodes.empty()) throw InputError(node->where(), fields.path(key) + " is empty");
    for (std::size_t i = 0; i < nodes.size(); ++i)
        items.push_back(
            read(*nodes[i], fields.path(key) +
                                (node->kind == NodeKind::list ? "." + std::to_string(i) : std::string())));
}

} // namespace

std::filesystem::path existing_file(const Node& node, const std::string& path,
                                    const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / read_name(node, path);
    std::error_code problem;
    const auto status = std::filesystem::status(file, problem);
    if (std::filesystem::is_directory(status))
        throw InputError(node.where(), path + ": " + in_quotes(file.string()) + " is a folder");
    if (!std::filesystem::exists(status))
        throw InputError(node.where(), path + ": there is no file " + in_quotes(file.string()));
    return file;
}

void read_output(const Source& source, Scene& scene) {
    if (const Node* frames = source.root.section("output", {"frames"}).find("frames"))
        scene.frames = read_frames(*frames, Records(scene.program));
    else
        note_choice(scene, "output.frames", "the last state", "none are asked for");
}

void read_reference(const Source& source, Scene& scene) {
    const Fields fields = source.root.section("reference", {"curve", "profiles", "palmer", "observers"});
    const Records records(scene.program);
    read_items(fields, "curve", scene.curves, [&](const Node& item, const std::string& path) {
        return read_curve(item, path, source, records);
    });
    read_items(fields, "profiles", scene.profiles, [&](const Node& item, const std::string& path) {
        return read_profile(item, path, source, records, scene.frames);
    });
    if (const Node* palmer = fields.find("palmer"))
        scene.palmer = read_palmer(*palmer, records, scene.frames);
    read_items(fields, "observers", scene.observers, [&](const Node& item, const std::string& path) {
        return read_observer(item, path, source, scene);
    });
}

} // namespace gault::core::config
