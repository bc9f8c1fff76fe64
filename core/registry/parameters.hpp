// Validated values of a component's parameters, in declared order, with the storage they point into.
#pragma once
#include "core/base/error.hpp"
#include <gault/gault.h>

#include <deque>
#include <string>
#include <vector>

namespace gault::core {

struct Parameters {
    std::vector<gault_value> values; // one per declared parameter, in order
    std::vector<Location> locations; // where each was written; where the component was, for a default
    Location where;                  // of the component itself

    // Storage behind `values`; deques, so that growing moves nothing. Moving keeps every pointer valid.
    std::deque<std::string> texts;
    std::deque<std::vector<double>> numbers;
    std::deque<std::vector<gault_item>> items;
    std::deque<std::vector<gault_value>> nested;

    Parameters() = default;
    Parameters(Parameters&&) = default;
    Parameters& operator=(Parameters&&) = default;
    Parameters(const Parameters&) = delete;
};

} // namespace gault::core
