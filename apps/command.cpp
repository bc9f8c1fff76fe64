#include "apps/command.hpp"
#include "core/base/log.hpp"
#include "core/study/child.hpp"

#include <fmt/format.h>

namespace gault::app {
std::vector<core::Override> overrides(const std::vector<std::string>& set) {
    std::vector<core::Override> all;
    for (const std::string& text : set) {
        const auto equals = text.find('=');
        if (equals == std::string::npos || equals == 0)
            throw core::InputError(fmt::format(
                "--set {}: expected KEY=VALUE, e.g. --set materials.sand.friction_angle='46 deg'", text));
        all.push_back({text.substr(0, equals), text.substr(equals + 1)});
    }
    return all;
}

namespace {

std::vector<core::Override> joined(std::vector<core::Override> all, const std::vector<core::Override>& more) {
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

} // namespace

void SceneArguments::declare(CLI::App& options, const std::string& what) {
    options.add_option(what, file, "The " + what + ", a YAML file")->required()->type_name("FILE");
    options
        .add_option("--set", set,
                    "Overrides a key of the " + what +
                        "; dots for maps, numbers for list items. May be repeated")
        ->allow_extra_args(false)
        ->type_name("KEY=VALUE");
    declare_plugin_path(options, plugin_path);
}

LoadedScene::LoadedScene(const SceneArguments& arguments, const std::vector<core::Override>& more)
    : file_(arguments.file), changes_(joined(overrides(arguments.set), more)),
      registry_(core::plugin_search_path(core::scene_plugins(file_, changes_), arguments.plugin_path)),
      scene_(read({})) {
    choices_ = core::choose_least(
        scene_, [this](const std::vector<core::Override>& changes) { return read(changes); });
    scene_ = reread({});
}

LoadedElementTest::LoadedElementTest(const SceneArguments& arguments)
    : registry_(core::plugin_search_path(core::scene_plugins(arguments.file, overrides(arguments.set)),
                                         arguments.plugin_path)),
      test_(core::read_element_test(arguments.file, overrides(arguments.set), registry_)) {}

std::filesystem::path installation() {
    return std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path();
}

std::filesystem::path shared_file(const std::string& name) {
    return installation() / "share/gault" / name;
}

void run_script(const std::string& script, std::vector<std::string> arguments,
                const std::filesystem::path& folder) {
    const std::filesystem::path file = shared_file(script), said = folder / (script + ".log");
    arguments.insert(arguments.begin(), {"/usr/bin/python3", file.string()});
    if (core::run_child(arguments, said).status == 0)
        std::filesystem::remove(said);
    else
        core::log::warn("no figure: /usr/bin/python3 {} failed, see {}", file.string(), said.string());
}

core::Scene LoadedScene::read(const std::vector<core::Override>& more) const {
    return core::read_scene(file_, joined(changes_, more), registry_);
}

core::Scene LoadedScene::reread(const std::vector<core::Override>& more) const {
    return read(joined(core::overrides_of(choices_), more));
}

std::vector<core::Override> everything_open(const core::Scene& scene) {
    std::vector<core::Override> open{
        {"model.frame", "auto"}, {"model.solver", "auto"}, {"model.volumetric_strain", "auto"},
        {"grid", "auto"},        {"points", "auto"},       {"solver", "auto"}};
    if (scene.symmetry != core::Symmetry::radial) open.push_back({"model.symmetry", "auto"});
    return open;
}

void declare_plugin_path(CLI::App& options, std::vector<std::filesystem::path>& plugin_path) {
    options
        .add_option("--plugin-path", plugin_path,
                    "A folder of plugins or a plugin file, searched before GAULT_PLUGIN_PATH (colons "
                    "between) and the "
                    "installation's own folder. May be repeated")
        ->allow_extra_args(false)
        ->type_name("PATH");
}

} // namespace gault::app
