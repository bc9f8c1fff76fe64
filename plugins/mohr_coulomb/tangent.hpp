// The consistent tangent: d stress / d strain of the very update, with the turning of the principal
// directions.
#pragma once
#include "softening.hpp"

namespace mohr_coulomb {
inline namespace GAULT_ISA {

using Tangent = std::array<std::array<Pack, 6>, 6>; // [row][column], Pa

namespace detail {

// That of the region that holds in each lane.
template <class Number>
std::array<Pack, 9> chosen(const JacobiansOf<Number>& jacobians, Pack region) {
    std::array<Pack, 9> jacobian;
    jacobian.fill(0.0);
    for (int r = 0; r < region_count; ++r) {
        const Mask here = region == double(r);
        if (!any(here)) continue;
        for (int e = 0; e < 9; ++e)
            jacobian[e] = select(here, jacobians.of[r][e], jacobian[e]);
    }
    return jacobian;
}

// d s[i] / d s_trial[j].
inline std::array<Pack, 9> principal_jacobian(const PerfectSurface& k, const Returned&, const Returned& r) {
    return chosen(k.jacobians, r.region);
}

// With the plastic strain x that follows from x = old + growth(s_trial, x):
//   d s = s,t d s_trial + s,x dx         dx = growth,t d s_trial / (1 - growth,x)
inline std::array<Pack, 9> principal_jacobian(const SofteningSurface&, const Returned& trial,
                                              const Softened& r) {
    const SurfaceOf<Sensitive>& k = r.surface;
    std::array<Pack, 9> jacobian =
        chosen(jacobians<Pack>(k, [](const Sensitive& x) { return x.value; }), r.region);
    const Pack lost[3] = {trial.s1 - r.s1, trial.s2 - r.s2, trial.s3 - r.s3};
    const Pack trace = k.trace_weight * (lost[0] + lost[1] + lost[2]);
    const Pack per_growth = k.strain_measure / max(r.at.plastic_strain.value, 1e-100);
    const Mask on_plane = r.region == double{plane}, plastic = !(r.region == double{elastic});
    const Pack normal[3] = {1.0, 0.0, -k.kappa.value}; // exact on the plane, however small the growth
    const Pack rate[3] = {r.at.s1.rate, r.at.s2.rate, r.at.s3.rate};
    Pack growth[3];
    for (int j = 0; j < 3; ++j) {
        growth[j] = 0.0;
        for (int i = 0; i < 3; ++i)
            growth[j] += per_growth * (lost[i] - trace) * ((i == j ? 1.0 : 0.0) - jacobian[3 * i + j]);
        growth[j] = select(on_plane, k.strain_gain.value * normal[j], growth[j]);
    }
    const Pack share = select(plastic, 1.0 / (1.0 - r.at.plastic_strain.rate), 0.0);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            jacobian[3 * i + j] += rate[i] * (share * growth[j]);
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
template <class Strength>
GAULT_INLINE Tangent tangent(const Strength& k, double lame, double twice_shear,
                             const gault::SymmetricTensor& trial) {
    gault::Spectral s = gault::spectral(trial);
    gault::sort_descending(s);
    const Returned before{s.value[0], s.value[1], s.value[2], 0.0, 0.0};
    const auto r = return_to_surface(k, before.s1, before.s2, before.s3);
    const std::array<Pack, 9> jacobian = detail::principal_jacobian(k, before, r);
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
            elastic_stress[i] = twice_shear * strain + (j < 3 ? lame : 0.0);
        }
        for (int i = 0; i < 3; ++i)
            response[i] = jacobian[3 * i] * elastic_stress[0] + jacobian[3 * i + 1] * elastic_stress[1] +
                          jacobian[3 * i + 2] * elastic_stress[2];
        for (int i = 3; i < 6;
             ++i) // a normal column finds half of the product in dyad, a shear column all of it
            response[i] = (j < 3 ? 0.5 * twice_shear : twice_shear) * shrunk[i - 3] * dyad[i][j];
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
