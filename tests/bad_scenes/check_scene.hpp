// What must hold of the scene reader whatever the text.
#pragma once
#include "core/registry/registry.hpp"

#include <string>

namespace gault::core {

const Registry& test_registry(); // the test components

// "" where the text is read, or refused with an InputError of one line that begins with the file's name;
// otherwise what is wrong. A scene that is read must be read again from its own Scene::yaml, and say the
// same.
std::string broken_promise(const std::string& text);

} // namespace gault::core
