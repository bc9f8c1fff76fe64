// The consistent tangent: d stress / d strain of the very update, by the implicit derivative of its one equation.
#pragma once
#include "return_mapping.hpp"

namespace modified_cam_clay {
inline namespace GAULT_ISA {

using Tangent = std::array<std::array<Pack, 6>, 6>; // [row][column], Pa

// What depends on the strain increment through its volumetric part (v), through m:e (m = s / q) and through t.
struct Derivatives {
    Pack pressure_v, pressure_t; // of p'
    Pack shear_v, shear_t;       // of G
    Pack t_v, t_m;               // of t
    Pack scale;                  // s / s_elastic
    Pack along;                  // M p': q = along * t; 0 where elastic
    SymmetricTensor direction;   // m
};

GAULT_INLINE Derivatives derivatives(const Clay& clay, const Step& s, const Returned& r) {
    const Candidate c = candidate(clay, s, r.t);
    const Pack size = deviator_size(r.elastic), wet = 1.0 - r.t * r.t;
    Derivatives d;
    for (int i = 0; i < 6; ++i)
        d.direction[i] = r.elastic[i] / max(size, 1e-300);

    const Pack x_v = s.volume / select(r.plastic, Pack(clay.lambda), Pack(clay.kappa));
    d.shear_v = shear_modulus_slope(clay, s, r.x, x_v, s.mean_volume_slope);
    d.shear_t = c.shear_slope;
    const Pack q = clay.ratio * r.t * c.pressure;
    const Pack plastic_v = (clay.ratio_plastic * s.volume - c.plastic * s.mean_volume_slope) / s.mean_volume;
    const Pack residual_v = 6.0 * r.t * (d.shear_v * c.plastic + c.shear * plastic_v) -
                            clay.ratio * wet * (3.0 * inner(d.direction, s.strain) * d.shear_v - q * x_v);
    const Pack slope = select(abs(c.residual_slope) > 1e-300, c.residual_slope, 1e-300);
    d.t_v = select(r.plastic, -residual_v / slope, 0.0);
    d.t_m = select(r.plastic, clay.ratio * wet * 3.0 * c.shear / slope, 0.0);

    d.pressure_v = select(r.at_least_pressure, 0.0, r.pressure * x_v);
    d.pressure_t = select(r.at_least_pressure, 0.0, r.pressure * c.x_slope);
    // q / q_elastic; near the isotropic axis, where both vanish, from the flow rule.
    const Pack flow = clay.ratio * clay.ratio * c.pressure * wet;
    const Pack near_axis = flow / (6.0 * c.shear * c.plastic + flow);
    d.scale = select(r.plastic, select(r.t < 0.5, near_axis, q / max(size, 1e-300)), 1.0);
    d.along = select(r.plastic, clay.ratio * c.pressure, 0.0);
    return d;
}

inline Tangent tangent(const Clay& clay, const Step& s, const Returned& r) {
    const Candidate c = candidate(clay, s, r.t);
    const Derivatives d = derivatives(clay, s, r);
    const Pack strain_along = inner(d.direction, s.strain);
    Tangent tangent;
    for (int column = 0; column < 6; ++column) {
        SymmetricTensor e; // unit of strain: its deviator; tensor shear counts twice in m:e
        for (int i = 0; i < 6; ++i)
            e[i] = (i == column ? 1.0 : 0.0) - (i < 3 && column < 3 ? 1.0 / 3.0 : 0.0);
        const Pack v = column < 3 ? -1.0 : 0.0, m = inner(d.direction, e);
        const Pack t = d.t_v * v + d.t_m * m;
        const Pack shear = d.shear_v * v + d.shear_t * t;
        const Pack pressure = d.pressure_v * v + d.pressure_t * t;
        const Pack elastic_size = 3.0 * (r.shear * m + strain_along * shear);
        const Pack x = select(r.plastic, s.volume / clay.lambda * v + c.x_slope * t, 0.0);
        const Pack size = d.along * (t + r.t * x) - select(r.plastic, d.scale * elastic_size, 0.0);
        for (int row = 0; row < 6; ++row)
            tangent[row][column] = d.scale * 2.0 * (r.shear * e[row] + shear * s.strain[row]) +
                                   size * d.direction[row] - (row < 3 ? pressure : Pack(0.0));
    }
    return tangent;
}

} // namespace GAULT_ISA
} // namespace modified_cam_clay
