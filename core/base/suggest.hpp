// The nearest right name for a mistyped one.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace gault::core {

// The candidate with the smallest Damerau-Levenshtein distance, or "" when none is near (more than a third
// wrong).
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

// "; did you mean 'x'?" or "", to append to a message, followed by "; allowed: a, b, c" when there are few.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

} // namespace gault::core
