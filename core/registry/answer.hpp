// What a plugin's function answered, made safe to use.
#pragma once
#include <gault/gault.h>

#include <cstddef>
#include <string>

namespace gault::core {

// At most `capacity` bytes of a plugin's text, on one line: valid UTF-8 without control characters. "" for
// NULL.
std::string plain_text(const char* text, std::size_t capacity);
std::string error_text(const gault_error& error); // "" where no reason was given

// `suggest`, within [least, most]; a half of the step where it is not a number.
double step_fraction(double suggest, double least, double most);

} // namespace gault::core
