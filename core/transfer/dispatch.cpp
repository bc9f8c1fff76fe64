#include "core/registry/isa.hpp"
#include "core/transfer/kernels.hpp"

namespace gault::core {

namespace isa_baseline {
const Kernels* kernels(int degree, bool axisymmetric);
}
namespace isa_v3 {
const Kernels* kernels(int degree, bool axisymmetric);
}
namespace isa_v4 {
const Kernels* kernels(int degree, bool axisymmetric);
}

const Kernels& select_kernels(int degree, bool axisymmetric) {
#if defined(__x86_64__)
    switch (best_isa()) {
    case Isa::v4:
        return *isa_v4::kernels(degree, axisymmetric);
    case Isa::v3:
        return *isa_v3::kernels(degree, axisymmetric);
    default:
        break;
    }
#endif
    return *isa_baseline::kernels(degree, axisymmetric);
}

} // namespace gault::core
