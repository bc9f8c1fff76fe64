// Quantities as people write them ("100 MPa", "48 deg", "10 %"), converted to SI by udunits2.
#pragma once
#include <string>
#include <string_view>

namespace gault::core {

// The SI value of `text`, which must be convertible to `unit` (an SI unit; "1" for a pure number, where "%"
// and a bare number are allowed). A bare number is an error unless `unit` is "1" or the number is 0. Throws
// std::invalid_argument with one sentence that says what was found, what was expected and the nearest unit
// ("kpa": did you mean "kPa"?).
double parse_quantity(std::string_view text, std::string_view unit);

} // namespace gault::core
