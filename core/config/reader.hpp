// Reading a scene that is in memory.
#pragma once
#include "core/config/scene.hpp"

namespace gault::core::config {

// As read_scene; `file` is what locations name and what relative file names start from. Throws InputError.
Scene read_scene_text(std::string text, const std::filesystem::path& file,
                      const std::vector<Override>& overrides, const Registry& registry);

} // namespace gault::core::config
