// What a run says of its results when it ends.
#pragma once
#include <nlohmann/json.hpp>

namespace gault::core {

void report_reference(const nlohmann::json& reference); // as in summary.json
void report_derived(const nlohmann::json& derived);

} // namespace gault::core
