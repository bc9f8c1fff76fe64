// The sand at one state: elasticity, critical state, limiting dilatancy and the yield surface. Pressure and volumetric
// strain are positive in compression here, as in papers; deviators keep the contract's signs.
#pragma once
#include <gault/tensor.hpp>

namespace norsand {
inline namespace GAULT_ISA {

using gault::Mask;
using gault::Pack;
using gault::SymmetricTensor;

constexpr double least_pressure = 100.0; // Pa; p' is never less
constexpr double unit_pressure = 1e3;    // Pa; where Gamma is

struct Sand {
    double gamma, lambda;         // critical state, natural logarithm
    double ratio;                 // M_tc
    double coupling;              // N
    double dilatancy;             // chi_i
    double hardening, slope;      // H_0, H_psi
    double bulk, pressure, power; // K at the reference pressure, Pa; exponent
    double shear_per_bulk;        // G / K
    double softening;             // factor of the undrained term; 0 without it
    bool cap;                     // the image pressure follows unloading
};

GAULT_INLINE Pack inner(const SymmetricTensor& a, const SymmetricTensor& b) {
    return (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) + 2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}
GAULT_INLINE Pack trace(const SymmetricTensor& t) {
    return t[0] + t[1] + t[2];
}
GAULT_INLINE SymmetricTensor deviator(SymmetricTensor t) {
    const Pack mean = trace(t) / 3.0;
    for (int i = 0; i < 3; ++i)
        t[i] -= mean;
    return t;
}
GAULT_INLINE Pack deviator_size(const SymmetricTensor& s) { // q
    return sqrt(1.5 * inner(s, s));
}

GAULT_INLINE Pack bulk_modulus(const Sand& sand, Pack p) {
    return sand.bulk * pow(p / sand.pressure, sand.power);
}
GAULT_INLINE Pack state_parameter(const Sand& sand, Pack p, Pack void_ratio) {
    return void_ratio - sand.gamma + sand.lambda * log(p / unit_pressure);
}

// M(theta) of Jefferies and Shuttle (2011): cos(1.5 theta + 45 deg) is the root of (1 - sin 3 theta)/2. The edge at
// triaxial compression is rounded within 1e-4 of it, and next to the isotropic axis theta counts as 0.
GAULT_INLINE Pack friction(const Sand& sand, const SymmetricTensor& s, Pack p) {
    constexpr double edge = 1e-4, axis = 1e-7;
    const auto& [xx, yy, zz, xy, yz, zx] = s;
    const Pack j2 = 0.5 * inner(s, s) + (axis * p) * (axis * p);
    const Pack j3 = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx);
    const Pack sine = -1.5 * std::sqrt(3.0) * j3 / (j2 * sqrt(j2));
    const Pack share = 0.5 * (1.0 - max(-1.0, min(1.0, sine)));
    const double lost = sand.ratio * sand.ratio / (3.0 + sand.ratio);
    return sand.ratio - lost * (sqrt(share + edge * edge) - edge);
}

// What follows from the state parameter of the image, psi_i.
struct Image {
    Pack dilatancy; // D_min / M_tc, within -1 and 1
    Pack shape;     // M_i / M(theta)
    Pack limit;     // ln (p_mx / p')
};
GAULT_INLINE Image image_at(const Sand& sand, Pack psi_i) {
    Image i;
    i.dilatancy = max(-1.0, min(1.0, sand.dilatancy / sand.ratio * psi_i));
    i.shape = 1.0 - sand.coupling * abs(i.dilatancy);
    i.limit = -i.dilatancy / i.shape;
    return i;
}

GAULT_INLINE Pack image_bend(const Sand& sand, const Image& at) { // -d shape / d ln p_i
    const Pack rate = sand.coupling * sand.dilatancy * sand.lambda / sand.ratio;
    return select(abs(at.dilatancy) >= 1.0, 0.0, select(at.dilatancy > 0.0, rate, -rate));
}

// The largest ln (p_i / p') that counts, so that unloading leaves no strength beyond that of the density: that of
// p_mx (of p' where the sand is loose), and a quarter more of p_i for softening that lags behind.
GAULT_INLINE Pack largest_log_ratio(const Sand& sand, Pack psi) {
    const double n = sand.coupling * sand.dilatancy;
    const Pack dense = max(0.0, -psi); // -psi_i is the lesser root of a quadratic
    const Pack b = sand.ratio + sand.lambda * sand.dilatancy + n * dense;
    const Pack root = sqrt(max(0.0, b * b - 4.0 * n * sand.ratio * dense));
    return image_at(sand, -2.0 * sand.ratio * dense / (b + root)).limit + std::log(1.25);
}

// ln (p_i / p') of the surface through q / (M(theta) p').
GAULT_INLINE Pack log_ratio_through(const Sand& sand, Pack scaled, Pack psi) {
    Pack x = scaled - 1.0;
    for (int i = 0; i < 8; ++i) { // monotonic, all but linear
        const Image at = image_at(sand, psi + sand.lambda * x);
        x -= (at.shape * (1.0 + x) - scaled) / (at.shape - image_bend(sand, at) * (1.0 + x));
    }
    return x;
}
// Largest q / (M(theta) p').
GAULT_INLINE Pack strength(const Sand& sand, Pack psi) {
    const Pack x = largest_log_ratio(sand, psi);
    return image_at(sand, psi + sand.lambda * x).shape * (1.0 + x);
}

} // namespace GAULT_ISA
} // namespace norsand
