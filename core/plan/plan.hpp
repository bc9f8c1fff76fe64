// What a scene needs: the least that is enough for the accuracy it asks for, with a reason for each choice, and
// what it will cost.
#pragma once
#include "core/config/scene.hpp"

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gault::core {

// Reads the scene once more, with these overrides after all others. Throws InputError.
using Reread = std::function<Scene(const std::vector<Override>&)>;

struct Estimate {
    std::size_t points = 0;
    double steps = 0.0, updates = 0.0; // constitutive updates; NaN where they are not known
    double seconds = 0.0, bytes = 0.0; // of the whole command; peak resident memory
    std::string unknown;               // why steps, updates and seconds are not known; empty: they are
};

// What the keys that the scene leaves open (Scene::chosen) should be. `scene` was read with nothing chosen.
std::vector<Choice> choose_least(const Scene& scene, const Reread& reread);
std::vector<Override> overrides_of(const std::vector<Choice>& choices);

// From a pilot run on a coarse grid, which may take `patience` seconds, and the first steps of the scene itself.
Estimate estimate_cost(const Scene& scene, const Reread& reread, int threads, double patience);

nlohmann::json to_json(const std::vector<Choice>& choices, const Estimate& estimate);

// Why radial symmetry cannot show the scene; empty: it can.
std::string not_radial(const Scene& scene);

} // namespace gault::core
