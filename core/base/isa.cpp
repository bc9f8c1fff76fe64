#include "core/base/isa.hpp"
#include "core/base/error.hpp"
#include "core/base/suggest.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>

namespace gault::core {
namespace {

constexpr Isa all[] = {Isa::baseline, Isa::v3, Isa::v4};

Isa processor_isa() {
#if defined(__x86_64__)
    // Every processor with these has the rest of its level (F16C, LZCNT, MOVBE).
    const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
                    __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma");
    if (!v3) return Isa::baseline;
    const bool v4 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                    __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512vl");
    return v4 ? Isa::v4 : Isa::v3;
#else
    return Isa::baseline;
#endif
}

} // namespace

const char* isa_name(Isa isa) {
    switch (isa) {
    case Isa::v3:
        return "x86-64-v3";
    case Isa::v4:
        return "x86-64-v4";
    default:
        return "baseline";
    }
}

Isa best_isa() {
    const char* wanted = std::getenv("GAULT_ISA");
    if (!wanted || !*wanted) return processor_isa();
    std::vector<std::string> names;
    for (const Isa isa : all) {
        if (std::string(wanted) == isa_name(isa)) return std::min(isa, processor_isa());
        names.push_back(isa_name(isa));
    }
    throw InputError("GAULT_ISA: unknown instruction set '" + std::string(wanted) + "'" +
                     suggestion(wanted, names));
}

} // namespace gault::core
