// --set KEY=VALUE on a document: dots for maps, numbers for list items.
#pragma once
#include "core/config/document.hpp"
#include "core/config/scene.hpp"

namespace gault::core::config {

// Replaces the value at the key; map keys that are absent are made. What it writes stands at "--set KEY".
// Throws InputError at that place: the value is not YAML, an index is out of range, a key leads into a single
// value.
void apply_override(Node& root, const Override& change);

} // namespace gault::core::config
