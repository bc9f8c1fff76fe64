#include "core/config/scene.hpp"

#include "core/config/overrides.hpp"
#include "core/config/reader.hpp"
#include "core/config/sections.hpp"

namespace gault::core {
namespace config {
namespace {

const std::vector<std::string> keys = {
    "gault", "title",   "accuracy", "plugins", "geometry",   "model",   "grid",   "points", "materials",
    "soil",  "regions", "gravity",  "initial", "boundaries", "program", "solver", "output", "reference"};

std::string read_title(const Fields& root, Scene& scene) {
    if (const Node* title = root.find("title")) return read_text_value(*title, "title");
    note_choice(scene, "title", scene.file.stem().string(), "the name of the file");
    return scene.file.stem().string();
}

} // namespace

Node parse_with_overrides(std::string text, const std::filesystem::path& file,
                          const std::vector<Override>& overrides) {
    Node root = parse_document(std::move(text), file.string());
    const Location start{file.string(), 1, 1};
    if (root.kind == NodeKind::null) throw InputError(start, "the scene is empty");
    if (root.kind != NodeKind::map)
        throw InputError(root.where(),
                         "a scene is a map of keys (`gault: 1`, `geometry: ...`); found " + described(root));
    for (const auto& change : overrides)
        apply_override(root, change);
    return root;
}

void check_version(const Fields& root) {
    const Node& version = root.require("gault", "the version of this format: `gault: 1`");
    if (read_integer(version, "gault") != 1)
        throw InputError(version.where(),
                         "gault is " + described(version) + "; this program reads version 1");
}

Scene read_scene_text(std::string text, const std::filesystem::path& file,
                      const std::vector<Override>& overrides, const Registry& registry) {
    const Node document = parse_with_overrides(std::move(text), file, overrides);
    const Fields root(document, "", keys);
    const Source source{root, registry, file.parent_path()};
    Scene scene{};
    scene.file = file;
    check_version(root);
    scene.title = read_title(root, scene);
    scene.accuracy = root.quantity("accuracy", "1", {.min = 1e-6, .max = 0.1}, scene.accuracy);
    read_geometry(source, scene);
    read_model(source, scene);
    read_grid(source, scene);
    read_parts(source, scene);
    read_points(source, scene);
    read_materials(source, scene);
    read_gravity(source, scene);
    read_initial(source, scene);
    read_boundaries(source, scene);
    read_program(source, scene);
    read_solver(source, scene);
    read_output(source, scene);
    read_reference(source, scene);
    scene.yaml = emit(document);
    return scene;
}

} // namespace config

std::vector<std::filesystem::path> scene_plugins(const std::filesystem::path& file,
                                                 const std::vector<Override>& overrides) {
    using namespace config;
    const Node document = parse_with_overrides(read_text(file), file, overrides);
    std::vector<std::filesystem::path> plugins;
    const Node* node = document.find("plugins");
    if (node == nullptr) return plugins;
    if (node->kind == NodeKind::null) throw InputError(node->where(), "plugins has no value");
    for (const Node* item : one_or_more(*node)) {
        const std::filesystem::path plugin = file.parent_path() / read_name(*item, "plugins");
        std::error_code problem;
        if (!std::filesystem::exists(plugin, problem))
            throw InputError(item->where(),
                             "plugins: there is no file or folder " + in_quotes(plugin.string()));
        plugins.push_back(plugin);
    }
    return plugins;
}

Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides,
                 const Registry& registry) {
    return config::read_scene_text(config::read_text(file), file, overrides, registry);
}

} // namespace gault::core
