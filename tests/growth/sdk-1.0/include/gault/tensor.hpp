// Symmetric second-order tensors of packs: components xx yy zz xy yz zx, tensor shear, as everywhere in the
// contract. Every lane's result depends on that lane alone, so it is the same to the bit in a pack of any
// width.
#pragma once
#include <gault/pack.hpp>

#include <array>
#include <limits>
#include <utility>

namespace gault {
inline namespace GAULT_ISA {

using SymmetricTensor = std::array<Pack, 6>;
using Triple = std::array<Pack, 3>;

// Isotropic elasticity: old + lame tr(strain) 1 + 2 shear strain.
GAULT_INLINE SymmetricTensor add_elastic(const SymmetricTensor& old, const SymmetricTensor& strain, Pack lame,
                                         Pack twice_shear) {
    const Pack mean = lame * (strain[0] + strain[1] + strain[2]);
    SymmetricTensor sum;
    for (int i = 0; i < 3; ++i) {
        sum[i] = old[i] + (mean + twice_shear * strain[i]);
        sum[i + 3] = old[i + 3] + twice_shear * strain[i + 3];
    }
    return sum;
}

// The decomposition within the xy plane of a tensor whose yz and zx are zero; zz is its own principal value.
// No directions are formed: a change of the two values from (high, low) to (high', low') keeps them, so it
// scales half_difference and xy by (high' - low') / (high - low).
struct InPlaneSpectral {
    Pack half_difference, radius; // (xx - yy) / 2, (high - low) / 2
    Pack high, low;
};

GAULT_INLINE InPlaneSpectral in_plane_spectral(const SymmetricTensor& t) {
    InPlaneSpectral s;
    const Pack mean = 0.5 * (t[0] + t[1]);
    s.half_difference = 0.5 * (t[0] - t[1]);
    s.radius = sqrt(s.half_difference * s.half_difference + t[3] * t[3]);
    s.high = mean + s.radius;
    s.low = mean - s.radius;
    return s;
}

struct Spectral { // unsorted; t = sum of value[i] vector[i] vector[i]
    Triple value;
    std::array<Triple, 3> vector; // orthonormal, vector[i][k] is component k
};

namespace detail {

// One Jacobi rotation that annihilates the entry pq where it exceeds `negligible`; elsewhere it is the
// identity.
GAULT_INLINE void jacobi_rotation(Pack& pp, Pack& qq, Pack& pq, Pack& rp, Pack& rq, Triple& vp, Triple& vq,
                                  Pack negligible) {
    const Mask turns = abs(pq) > negligible;
    if (!any(turns)) return;
    const Pack half = 0.5 * (qq - pp);
    const Pack radius = sqrt(half * half + pq * pq);
    const Pack width = abs(half) + radius;
    const Pack inverse = 1.0 / sqrt(max(2.0 * radius * width, std::numeric_limits<double>::min()));
    const Pack c = width * inverse;
    const Pack sine = pq * inverse;
    const Pack s = select(half < 0.0, -sine, sine);
    const Pack gain = select(half < 0.0, -2.0 * radius, 2.0 * radius) * (s * s);
    pp = select(turns, pp - gain, pp);
    qq = select(turns, qq + gain, qq);
    pq = select(turns, 0.0, pq);
    const auto turn = [c, s, turns](Pack& a, Pack& b) {
        const Pack old = a;
        a = select(turns, c * a - s * b, a);
        b = select(turns, s * old + c * b, b);
    };
    turn(rp, rq);
    for (int k = 0; k < 3; ++k)
        turn(vp[k], vq[k]);
}

} // namespace detail

// Cyclic Jacobi (Golub and Van Loan 2013, 8.5): values to a few ulp of the largest entry and vectors
// orthonormal to a few ulp, at repeated values too. Entries below 1e-140 count as zero.
inline Spectral spectral(const SymmetricTensor& t) {
    auto [xx, yy, zz, xy, yz, zx] = t;
    Spectral result{{}, {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}}};
    auto& [x, y, z] = result.vector;
    Pack size = abs(xx);
    for (int i = 1; i < 6; ++i)
        size = max(size, abs(t[i]));
    const Pack negligible = max(0x1p-56 * size, 1e-140);
    for (int sweep = 0; sweep < 12; ++sweep) {
        if (!any(max(max(abs(xy), abs(yz)), abs(zx)) > negligible)) break;
        detail::jacobi_rotation(xx, yy, xy, zx, yz, x, y, negligible);
        detail::jacobi_rotation(xx, zz, zx, xy, yz, x, z, negligible);
        detail::jacobi_rotation(yy, zz, yz, xy, zx, y, z, negligible);
    }
    result.value = {xx, yy, zz};
    return result;
}

// Sum of value[i] vector[i] vector[i].
GAULT_INLINE SymmetricTensor compose(const Triple& value, const std::array<Triple, 3>& vector) {
    constexpr int row[] = {0, 1, 2, 0, 1, 2}, column[] = {0, 1, 2, 1, 2, 0};
    SymmetricTensor t;
    for (int c = 0; c < 6; ++c) {
        t[c] = value[0] * (vector[0][row[c]] * vector[0][column[c]]);
        for (int i = 1; i < 3; ++i)
            t[c] += value[i] * (vector[i][row[c]] * vector[i][column[c]]);
    }
    return t;
}

// Reorders so that value[0] >= value[1] >= value[2].
GAULT_INLINE void sort_descending(Spectral& s) {
    constexpr int first[] = {0, 1, 0}, second[] = {1, 2, 1};
    for (int k = 0; k < 3; ++k) {
        const int i = first[k], j = second[k];
        const Mask swap = s.value[i] < s.value[j];
        const auto exchange = [swap](Pack& a, Pack& b) {
            const Pack old = a;
            a = select(swap, b, a);
            b = select(swap, old, b);
        };
        exchange(s.value[i], s.value[j]);
        for (int c = 0; c < 3; ++c)
            exchange(s.vector[i][c], s.vector[j][c]);
    }
}

} // namespace GAULT_ISA
} // namespace gault
