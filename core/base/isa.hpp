// The instruction sets that a library may come compiled for, as glibc names them.
#pragma once

namespace gault::core {

enum class Isa { baseline, v3, v4 }; // any x86-64; AVX2 and FMA; AVX-512 F BW CD DQ VL

const char* isa_name(Isa isa); // "baseline", "x86-64-v3", "x86-64-v4"

// The best that this processor runs, and not above what GAULT_ISA (one of the names) allows. InputError:
// another word.
Isa best_isa();

} // namespace gault::core
