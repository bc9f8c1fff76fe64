#include "core/base/isa.hpp"
#include "core/transfer/kernels.hpp"

namespace gault::core {

namespace isa_baseline {
const Kernels* kernels(const KernelChoice& choice);
}
namespace isa_v3 {
const Kernels* kernels(const KernelChoice& choice);
}
namespace isa_v4 {
const Kernels* kernels(const KernelChoice& choice);
}

const Kernels& select_kernels(const KernelChoice& choice) {
#if defined(__x86_64__)
    switch (best_isa()) {
    case Isa::v4:
        return *isa_v4::kernels(choice);
    case Isa::v3:
        return *isa_v3::kernels(choice);
    default:
        break;
    }
#endif
    return *isa_baseline::kernels(choice);
}

} // namespace gault::core
