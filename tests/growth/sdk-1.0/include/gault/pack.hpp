// clang-format off
// A pack of doubles as wide as the instruction set the file is compiled for (2, 4 or 8), on the compilers'
// vector extension (gcc, clang). Arithmetic is lane by lane and, with -ffp-contract=off, the same to the bit whatever
// the width. Everything is forced inline and lives in a namespace of its instruction set, so that objects compiled for
// different ones can be linked together.
#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#if defined(__AVX512F__) && defined(__AVX512DQ__)
#define GAULT_PACK_LANES 8
#define GAULT_ISA isa_v4
#elif defined(__AVX2__)
#define GAULT_PACK_LANES 4
#define GAULT_ISA isa_v3
#else
#define GAULT_PACK_LANES 2
#define GAULT_ISA isa_baseline
#endif
#define GAULT_INLINE inline __attribute__((always_inline))

namespace gault {
inline namespace GAULT_ISA {

constexpr int pack_lanes = GAULT_PACK_LANES;

struct Mask { // all bits set where true
    typedef int64_t Vector __attribute__((vector_size(8 * GAULT_PACK_LANES)));
    Vector v;
};

struct Pack {
    typedef double Vector __attribute__((vector_size(8 * GAULT_PACK_LANES)));
    Vector v;

    Pack() = default;
    GAULT_INLINE Pack(double x) : v(x - Vector{}) {} // broadcast; x - 0 is x, which a compiler knows
    GAULT_INLINE explicit Pack(Vector x) : v(x) {}

    static GAULT_INLINE Pack load(const double* aligned) {
        return Pack(*static_cast<const Vector*>(__builtin_assume_aligned(aligned, 8 * GAULT_PACK_LANES)));
    }
    static GAULT_INLINE Pack load_unaligned(const double* p) {
        Pack r;
        std::memcpy(&r.v, p, sizeof r.v);
        return r;
    }
    GAULT_INLINE void store(double* aligned) const {
        *static_cast<Vector*>(__builtin_assume_aligned(aligned, 8 * GAULT_PACK_LANES)) = v;
    }
    GAULT_INLINE double operator[](int lane) const { return v[lane]; }

    GAULT_INLINE Pack& operator+=(Pack b) { v += b.v; return *this; }
    GAULT_INLINE Pack& operator-=(Pack b) { v -= b.v; return *this; }
    GAULT_INLINE Pack& operator*=(Pack b) { v *= b.v; return *this; }
    GAULT_INLINE Pack& operator/=(Pack b) { v /= b.v; return *this; }
    GAULT_INLINE Pack operator-() const { return Pack(-v); }
};

GAULT_INLINE Pack operator+(Pack a, Pack b) { return Pack(a.v + b.v); }
GAULT_INLINE Pack operator-(Pack a, Pack b) { return Pack(a.v - b.v); }
GAULT_INLINE Pack operator*(Pack a, Pack b) { return Pack(a.v * b.v); }
GAULT_INLINE Pack operator/(Pack a, Pack b) { return Pack(a.v / b.v); }

GAULT_INLINE Mask operator<(Pack a, Pack b) { return {a.v < b.v}; }
GAULT_INLINE Mask operator<=(Pack a, Pack b) { return {a.v <= b.v}; }
GAULT_INLINE Mask operator>(Pack a, Pack b) { return {a.v > b.v}; }
GAULT_INLINE Mask operator>=(Pack a, Pack b) { return {a.v >= b.v}; }
GAULT_INLINE Mask operator==(Pack a, Pack b) { return {a.v == b.v}; }
GAULT_INLINE Mask operator&(Mask a, Mask b) { return {a.v & b.v}; }
GAULT_INLINE Mask operator|(Mask a, Mask b) { return {a.v | b.v}; }
GAULT_INLINE Mask operator!(Mask a) { return {~a.v}; }

GAULT_INLINE bool any(Mask m) {
#if GAULT_PACK_LANES == 8
    return _mm512_movepi64_mask(reinterpret_cast<__m512i>(m.v)) != 0;
#elif GAULT_PACK_LANES == 4
    return _mm256_movemask_pd(reinterpret_cast<__m256d>(m.v)) != 0;
#else
    return (m.v[0] | m.v[1]) != 0;
#endif
}
GAULT_INLINE bool all(Mask m) { return !any(!m); }
GAULT_INLINE bool lane(Mask m, int i) { return m.v[i] != 0; }

GAULT_INLINE Pack select(Mask m, Pack yes, Pack no) { return Pack(m.v ? yes.v : no.v); }
GAULT_INLINE Pack min(Pack a, Pack b) { return select(a < b, a, b); }
GAULT_INLINE Pack max(Pack a, Pack b) { return select(a > b, a, b); }
GAULT_INLINE Pack abs(Pack a) { return select(a < Pack(0.0), -a, a); }

GAULT_INLINE Pack sqrt(Pack a) {
#if GAULT_PACK_LANES == 8
    return Pack(reinterpret_cast<Pack::Vector>(_mm512_maskz_sqrt_pd(0xff, reinterpret_cast<__m512d>(a.v))));
#elif GAULT_PACK_LANES == 4
    return Pack(reinterpret_cast<Pack::Vector>(_mm256_sqrt_pd(reinterpret_cast<__m256d>(a.v))));
#elif defined(__SSE2__)
    return Pack(reinterpret_cast<Pack::Vector>(_mm_sqrt_pd(reinterpret_cast<__m128d>(a.v))));
#else
    return Pack(Pack::Vector{std::sqrt(a.v[0]), std::sqrt(a.v[1])});
#endif
}

// Any scalar function, lane by lane.
template <class F>
GAULT_INLINE Pack map(F f, Pack a) {
    Pack r;
    for (int i = 0; i < pack_lanes; ++i) r.v[i] = f(a.v[i]);
    return r;
}
GAULT_INLINE Pack exp(Pack a) { return map([](double x) { return std::exp(x); }, a); }
GAULT_INLINE Pack log(Pack a) { return map([](double x) { return std::log(x); }, a); }
GAULT_INLINE Pack pow(Pack a, double b) { return map([b](double x) { return std::pow(x, b); }, a); }

// Sum over the lanes, pairwise: ((0+4)+(2+6)) + ((1+5)+(3+7)) for eight.
GAULT_INLINE double sum(Pack a) {
#if GAULT_PACK_LANES == 8
    const __m512d x = reinterpret_cast<__m512d>(a.v);
    const __m256d y = _mm512_maskz_extractf64x4_pd(0xf, x, 0) + _mm512_maskz_extractf64x4_pd(0xf, x, 1);
    return (y[0] + y[2]) + (y[1] + y[3]);
#elif GAULT_PACK_LANES == 4
    return (a.v[0] + a.v[2]) + (a.v[1] + a.v[3]);
#else
    return a.v[0] + a.v[1];
#endif
}

} // namespace GAULT_ISA
} // namespace gault
