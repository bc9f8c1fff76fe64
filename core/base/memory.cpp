#include "core/base/memory.hpp"

#include <sys/resource.h>

namespace gault::core {

double peak_resident_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) * 1024.0;
}

} // namespace gault::core
