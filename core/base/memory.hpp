#pragma once

namespace gault::core {

double peak_resident_bytes(); // of this process so far

} // namespace gault::core
