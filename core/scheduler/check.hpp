#pragma once
#include "core/config/scene.hpp"

#include <string>
#include <vector>

namespace gault::core {

// Everything that `run` checks before its first step, and what the scene took hold of, a line each.
std::vector<std::string> check_scene(const Scene& scene);

} // namespace gault::core
