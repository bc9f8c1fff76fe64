#include "apps/command.hpp"
#include "core/base/log.hpp"
#include "core/base/suggest.hpp"
#include "core/certificate/certificate.hpp"
#include "core/config/sample.hpp"
#include "core/output/atomic_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

namespace gault::app {
namespace {

namespace fs = std::filesystem;

struct Arguments {
    std::string plugin, model, with, json;
    std::vector<std::string> set, only;
    std::vector<fs::path> plugin_path;
    double time_limit = 300.0;
};

bool is_file(const std::string& plugin) {
    return plugin.find('/') != std::string::npos || plugin.ends_with(".so");
}

// From the file that was named, what it is a link to, or a variant of either for this processor.
bool comes_from(const core::Component& component, const fs::path& named) {
    const fs::path folder = component.file.parent_path(), beside = folder.parent_path().parent_path();
    for (const fs::path& file :
         {fs::canonical(named), fs::canonical(fs::absolute(named).parent_path()) / named.filename()})
        if (component.file.filename() == file.filename() &&
            (folder == file.parent_path() || beside == file.parent_path()))
            return true;
    return false;
}

// A file of plugins, or the name of a model that is found as ever. A certificate is of one model.
const core::Component& chosen(const core::Registry& registry, const Arguments& arguments) {
    std::vector<const core::Component*> models;
    std::vector<std::string> names;
    const bool file = is_file(arguments.plugin);
    const std::string wanted = file ? arguments.model : arguments.plugin;
    for (const core::Component& c : registry.components()) {
        if (c.declaration->kind != GAULT_MATERIAL || (file && !comes_from(c, arguments.plugin))) continue;
        names.emplace_back(c.declaration->name);
        if (wanted.empty() || wanted == c.declaration->name) models.push_back(&c);
    }
    if (models.empty())
        throw core::InputError(
            names.empty() ? fmt::format("'{}' holds no material model", arguments.plugin)
                          : fmt::format("no material model '{}'{}", wanted, core::suggestion(wanted, names)));
    if (models.size() > 1)
        throw core::InputError(fmt::format("'{}' holds {} material models; choose one with --model{}",
                                           arguments.plugin, models.size(), core::suggestion("", names)));
    return *models.front();
}

core::Sample sample(const Arguments& arguments, const std::string& model, const core::Registry& registry) {
    const std::vector<core::Override> values = overrides(arguments.set);
    if (!arguments.with.empty()) return core::sample_of(arguments.with, values, model, registry);
    try {
        return {core::material_from(model, values, registry), {-100e3, -100e3, -100e3, 0.0, 0.0, 0.0}};
    } catch (const core::InputError& error) {
        throw core::InputError(
            fmt::format("{}; give values with --with SCENE, or --set KEY=VALUE", error.what()));
    }
}

// Where linear_elastic is installed, as it is with the program.
std::optional<core::MaterialUse> yardstick(const core::Registry& registry) try {
    return core::material_from("linear_elastic", {{"young_modulus", "100 MPa"}, {"poisson_ratio", "0.25"}},
                               registry);
} catch (const core::InputError&) {
    return std::nullopt;
}

void check_names(const std::vector<std::string>& only) {
    std::vector<std::string> names;
    for (const core::Check& check : core::all_checks())
        names.emplace_back(check.name);
    for (const std::string& name : only)
        if (std::find(names.begin(), names.end(), name) == names.end())
            throw core::InputError(fmt::format("no check '{}'{}", name, core::suggestion(name, names)));
}

int certify(const Arguments& arguments) {
    check_names(arguments.only);
    if (is_file(arguments.plugin) && fs::is_directory(arguments.plugin))
        throw core::InputError(
            fmt::format("'{}' is a folder: name a plugin's file, or a model", arguments.plugin));
    if (!is_file(arguments.plugin) && !arguments.model.empty())
        throw core::InputError(fmt::format("--model chooses from a file; '{}' is a model", arguments.plugin));
    std::vector<fs::path> first;
    if (!arguments.with.empty()) first = core::scene_plugins(arguments.with, overrides(arguments.set));
    if (is_file(arguments.plugin)) first.insert(first.begin(), arguments.plugin);
    const core::Registry registry(core::plugin_search_path(first, arguments.plugin_path));
    const core::Component& model = chosen(registry, arguments);
    const core::Sample soil = sample(arguments, model.declaration->name, registry);
    const std::optional<core::MaterialUse> elastic = yardstick(registry);
    const core::Subject subject{registry,
                                soil.material,
                                soil.stress,
                                shared_file("cavity.yaml"),
                                elastic ? &*elastic : nullptr,
                                arguments.time_limit};
    fmt::print("{} {}, {}\n", model.declaration->name, model.declaration->version, model.file.string());
    std::fflush(stdout); // before processes are made
    const auto results = core::certify(subject, arguments.only);
    fmt::print("{}", core::certificate_table(results));
    if (!arguments.json.empty())
        core::write_atomically(fs::absolute(arguments.json), core::certificate_json(subject, results).dump(2) + "\n");
    const bool good = core::passed(results);
    fmt::print("{}\n", good ? "certified" : "not certified");
    return good ? 0 : 3;
}

} // namespace

Action declare_certify(CLI::App& options) {
    const auto arguments = std::make_shared<Arguments>();
    options
        .add_option("plugin", arguments->plugin,
                    "A plugin's file, or a material model as `gault list` names it")
        ->required()
        ->type_name("PLUGIN");
    options.add_option("--model", arguments->model, "Which, where the file holds several")->type_name("NAME");
    options
        .add_option("--with", arguments->with,
                    "A scene, or a test of `gault element`, whose parameters and initial stress are taken")
        ->type_name("FILE");
    options
        .add_option("--set", arguments->set,
                    "A parameter of the model; with --with, a key of that file. May be repeated")
        ->allow_extra_args(false)
        ->type_name("KEY=VALUE");
    options.add_option("--only", arguments->only, "These checks alone")
        ->allow_extra_args(false)
        ->type_name("CHECK");
    options.add_option("--json", arguments->json, "Writes the certificate there too")->type_name("FILE");
    options.add_option("--time-limit", arguments->time_limit, "For one check, s")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    declare_plugin_path(options, arguments->plugin_path);
    options.footer(
        "Runs a soil model through the contract and through physics and prints what was measured; "
        "docs/certificates.md "
        "has\nthose of the shipped soils. Exit status: 0 certified, 3 a check failed.\n\n"
        "Examples:\n"
        "  gault certify build/lib/gault/plugins/my_soil.so --with my_scene.yaml\n"
        "  gault certify linear_elastic --set young_modulus='100 MPa' --set poisson_ratio=0.25\n"
        "  gault certify mohr_coulomb --with configs/paper/fahey.yaml --only tangent --only speed");
    return [arguments](const std::string&) { return certify(*arguments); };
}

} // namespace gault::app
