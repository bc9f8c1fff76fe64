#include "core/config/sample.hpp"

#include "core/config/overrides.hpp"
#include "core/config/reader.hpp"
#include "core/config/sections.hpp"

#include <algorithm>
#include <utility>

namespace gault::core {
namespace {

constexpr double density = 2000.0, pressure = 100e3; // kg/m^3, Pa: of a soil that names none

Sample sample_of_test(ElementTest test, const std::string& model) {
    if (test.material.model.component->declaration->name != model)
        throw InputError("'" + test.file.string() + "' is a test of '" +
                         test.material.model.component->declaration->name + "', not of '" + model + "'");
    return {std::move(test.material), test.stress};
}

} // namespace

MaterialUse material_from(const std::string& model, const std::vector<Override>& values,
                          const Registry& registry) {
    config::Node node;
    node.kind = config::NodeKind::map;
    config::apply_override(node, {"model", model});
    for (const Override& value : values)
        config::apply_override(node, value);
    MaterialUse use = config::read_material(node, model, model, registry, density);
    use.water.reset();
    return use;
}

Sample sample_of(const std::filesystem::path& file, const std::vector<Override>& overrides,
                 const std::string& model, const Registry& registry) {
    const config::Node document = config::parse_with_overrides(config::read_text(file), file, overrides);
    if (document.find("material")) return sample_of_test(read_element_test(file, overrides, registry), model);
    Scene scene = read_scene(file, overrides, registry);
    const auto found =
        std::find_if(scene.materials.begin(), scene.materials.end(),
                     [&](const MaterialUse& use) { return use.model.component->declaration->name == model; });
    if (found == scene.materials.end())
        throw InputError("no material of '" + file.string() + "' has the model '" + model + "'");
    const InitialStress& initial = scene.initial_stress;
    const double vertical = initial.vertical > 0.0 ? initial.vertical : pressure;
    Sample sample{std::move(*found),
                  {-initial.k0 * vertical, -vertical, -initial.k0 * vertical, 0.0, 0.0, 0.0}};
    if (const std::optional<PoreWater> water = std::exchange(sample.material.water, std::nullopt))
        for (std::size_t k = 0; k < 3; ++k)
            sample.stress[k] += water->pressure;
    return sample;
}

} // namespace gault::core
