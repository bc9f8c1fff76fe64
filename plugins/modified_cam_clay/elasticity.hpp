// Elasticity of a step: ln p' rises by v / kappa per volumetric strain, exactly, whatever the size of the step.
// Pressure and volumetric strain are positive in compression here, as in papers; deviators keep the contract's signs.
#pragma once
#include <gault/tensor.hpp>

namespace modified_cam_clay {
inline namespace GAULT_ISA {

using gault::Mask;
using gault::Pack;
using gault::SymmetricTensor;

// The softest soil there is: at the critical state under this pressure.
constexpr double least_pressure = 10.0; // Pa
constexpr double least_preconsolidation = 2.0 * least_pressure;

struct Clay {
    double ratio;          // M
    double lambda, kappa;  // of specific volume and ln p'
    double ratio_plastic;  // 1 - kappa / lambda
    double shear_per_bulk; // of a constant Poisson's ratio; 0 where the shear modulus is constant
    double shear;          // Pa; 0 where Poisson's ratio is constant
};

// (exp(x) - 1) / x and its derivative.
GAULT_INLINE Pack mean_exponential(Pack x) {
    return gault::map([](double a) { return a == 0.0 ? 1.0 : std::expm1(a) / a; }, x);
}
GAULT_INLINE Pack mean_exponential_slope(Pack x) {
    return gault::map(
        [](double a) {
            if (std::fabs(a) > 0.02) return (std::exp(a) - std::expm1(a) / a) / a;
            return 1. / 2 + a * (1. / 3 + a * (1. / 8 + a * (1. / 30 + a * (1. / 144 + a / 840))));
        },
        x);
}

struct Step {
    Pack pressure, preconsolidation;     // Pa, at its start
    SymmetricTensor stress, strain;      // deviators: stress at its start, strain increment
    Pack volumetric;                     // strain increment
    Pack volume;                         // v at its end
    Pack lost;                           // v at its start less v at its end
    Pack mean_volume, mean_volume_slope; // lost / volumetric and its derivative to volumetric
    Pack log_ratio;                      // ln(p' / p'_c) at its start
};

GAULT_INLINE Pack trace(const SymmetricTensor& t) {
    return t[0] + t[1] + t[2];
}
GAULT_INLINE SymmetricTensor deviator(SymmetricTensor t) {
    const Pack mean = trace(t) / 3.0;
    for (int i = 0; i < 3; ++i)
        t[i] -= mean;
    return t;
}
GAULT_INLINE Pack inner(const SymmetricTensor& a, const SymmetricTensor& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

GAULT_INLINE Step step(const SymmetricTensor& stress, const SymmetricTensor& strain, Pack preconsolidation,
                       Pack volume) {
    Step s;
    s.pressure = max(-trace(stress) / 3.0, least_pressure);
    s.preconsolidation = max(preconsolidation, least_preconsolidation);
    s.stress = deviator(stress);
    s.strain = deviator(strain);
    s.volumetric = -trace(strain);
    s.mean_volume = volume * mean_exponential(-s.volumetric);
    s.mean_volume_slope = -volume * mean_exponential_slope(-s.volumetric);
    s.lost = s.mean_volume * s.volumetric;
    s.volume = volume - s.lost;
    s.log_ratio = log(s.pressure / s.preconsolidation);
    return s;
}

// G of a step in which ln p' rises by x: constant, or in proportion to the secant of p' over its elastic strain.
GAULT_INLINE Pack shear_modulus(const Clay& clay, const Step& s, Pack x) {
    if (clay.shear > 0.0) return clay.shear;
    return clay.shear_per_bulk / clay.kappa * s.pressure * s.mean_volume * mean_exponential(x);
}

// Derivative of it: x changes by `x_slope` and the mean volume by `mean_volume_slope`.
GAULT_INLINE Pack shear_modulus_slope(const Clay& clay, const Step& s, Pack x, Pack x_slope,
                                      Pack mean_volume_slope) {
    if (clay.shear > 0.0) return 0.0;
    return clay.shear_per_bulk / clay.kappa * s.pressure *
           (mean_volume_slope * mean_exponential(x) + s.mean_volume * mean_exponential_slope(x) * x_slope);
}

// s_old + 2G e, and q = sqrt(3/2 s:s) of a deviator.
GAULT_INLINE SymmetricTensor shear_elastically(const Step& s, Pack shear) {
    SymmetricTensor t;
    for (int i = 0; i < 6; ++i)
        t[i] = s.stress[i] + 2.0 * shear * s.strain[i];
    return t;
}
GAULT_INLINE Pack deviator_size(const SymmetricTensor& s) {
    return sqrt(1.5 * inner(s, s));
}

} // namespace GAULT_ISA
} // namespace modified_cam_clay
