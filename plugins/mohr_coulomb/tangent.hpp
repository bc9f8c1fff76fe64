// The consistent tangent: d stress / d strain of the very update, with the turning of the principal
// directions.
#pragma once
#include "return_mapping.hpp"

namespace mohr_coulomb {
inline namespace GAULT_ISA {

using Tangent = std::array<std::array<Pack, 6>, 6>; // [row][column], Pa

namespace detail {

// d s[i] / d s_trial[j] of the region that holds in each lane.
inline std::array<Pack, 9> principal_jacobian(const Surface& k, Pack region) {
    std::array<Pack, 9> jacobian;
    jacobian.fill(0.0);
    for (int r = 0; r < region_count; ++r) {
        const Mask here = region == double(r);
        if (!any(here)) continue;
        for (int e = 0; e < 9; ++e)
            jacobian[e] = select(here, k.jacobian[r][e], jacobian[e]);
    }
    return jacobian;
}

// Shrinkage of a principal difference, which is also that of the shear stress between the two directions. At
// coincident trial values the difference is either kept or gone, and the regions say which.
GAULT_INLINE Pack shrinkage(Pack before, Pack after, Mask kept) {
    const Pack ratio = after / max(before, std::numeric_limits<double>::min());
    return select(kept, 1.0, min(max(ratio, 0.0), 1.0));
}

} // namespace detail

// De Souza Neto, Peric and Owen (2008), appendix A: derivative of an isotropic tensor function, after the
// elastic one.
GAULT_INLINE Tangent tangent(const Surface& k, const gault::SymmetricTensor& trial) {
    gault::Spectral s = gault::spectral(trial);
    gault::sort_descending(s);
    const Returned r = return_to_surface(k, s.value[0], s.value[1], s.value[2]);
    const std::array<Pack, 9> jacobian = detail::principal_jacobian(k, r.region);
    const Mask unchanged = r.region == double{elastic};
    const Mask lateral = unchanged | (r.region == double{tension_plane});
    const Pack shrunk[3] = {detail::shrinkage(s.value[0] - s.value[1], r.s1 - r.s2, unchanged),
                            detail::shrinkage(s.value[1] - s.value[2], r.s2 - r.s3, lateral),
                            detail::shrinkage(s.value[0] - s.value[2], r.s1 - r.s3, unchanged)};

    constexpr int row[] = {0, 1, 2, 0, 1, 0},
                  column[] = {0, 1, 2, 1, 2, 2}; // shear 0 1, 1 2, 0 2 in both frames
    // dyad[i][j]: component j of the symmetric product of two directions; for i < 3 of one with itself.
    Pack dyad[6][6];
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) {
            const gault::Triple &a = s.vector[row[i]], &b = s.vector[column[i]];
            const Pack product = a[row[j]] * b[column[j]];
            dyad[i][j] = i < 3 ? product : product + a[column[j]] * b[row[j]];
        }
    Tangent t;
    for (int j = 0; j < 6; ++j) {
        Pack elastic_stress[3], response[6];
        for (int i = 0; i < 3; ++i) {
            const Pack strain = j < 3 ? dyad[i][j] : 2.0 * dyad[i][j];
            elastic_stress[i] = k.twice_shear * strain + (j < 3 ? k.lame : 0.0);
        }
        for (int i = 0; i < 3; ++i)
            response[i] = jacobian[3 * i] * elastic_stress[0] + jacobian[3 * i + 1] * elastic_stress[1] +
                          jacobian[3 * i + 2] * elastic_stress[2];
        for (int i = 3; i < 6;
             ++i) // a normal column finds half of the product in dyad, a shear column all of it
            response[i] = (j < 3 ? 0.5 * k.twice_shear : k.twice_shear) * shrunk[i - 3] * dyad[i][j];
        for (int c = 0; c < 6; ++c) {
            Pack sum = 0.0;
            for (int i = 0; i < 6; ++i)
                sum += response[i] * dyad[i][c];
            t[c][j] = sum;
        }
    }
    return t;
}

} // namespace GAULT_ISA
} // namespace mohr_coulomb
