// Reading a scene, or another file of this format, that is in memory.
#pragma once
#include "core/config/element.hpp"
#include "core/config/fields.hpp"

namespace gault::core::config {

// As read_scene; `file` is what locations name and what relative file names start from. Throws InputError.
Scene read_scene_text(std::string text, const std::filesystem::path& file,
                      const std::vector<Override>& overrides, const Registry& registry);
ElementTest read_element_text(std::string text, const std::filesystem::path& file,
                              const std::vector<Override>& overrides, const Registry& registry);

// The document, a map, with the overrides applied. Throws InputError.
Node parse_with_overrides(std::string text, const std::filesystem::path& file,
                          const std::vector<Override>& overrides);

void check_version(const Fields& root); // `gault: 1`; InputError

} // namespace gault::core::config
