// A material by itself, for what is done with a soil away from any scene.
#pragma once
#include "core/config/scene.hpp"

namespace gault::core {

struct Sample {
    MaterialUse material;
    std::array<double, 6>
        stress{}; // initial, effective, Pa, tension positive; 100 kPa of pressure where nothing says another
};

// The model with these values of its parameters, the others at their defaults, without water. InputError.
MaterialUse material_from(const std::string& model, const std::vector<Override>& values,
                          const Registry& registry);

// The first material of a scene, or that of a test of one point, that uses the model, with the initial stress there and
// without the scene's water. InputError: none uses it.
Sample sample_of(const std::filesystem::path& file, const std::vector<Override>& overrides,
                 const std::string& model, const Registry& registry);

} // namespace gault::core
