// Backward Euler of the ellipse q^2 / M^2 + p' (p' - p'_c) = 0 with associated flow, as one equation for
// t = q / (M p'): see README.md.
#pragma once
#include "elasticity.hpp"

namespace modified_cam_clay {
inline namespace GAULT_ISA {

// A state on the ellipse, with the flow rule not yet obeyed. Slopes are derivatives to t.
struct Candidate {
    Pack x, x_slope;             // growth of ln p'
    Pack pressure;               // Pa
    Pack plastic, plastic_slope; // volumetric strain increment
    Pack shear, shear_slope;     // G, Pa
    SymmetricTensor elastic;     // deviatoric stress had there been no plastic shear
    Pack elastic_size;           // its q
    Pack residual, residual_slope;
};

GAULT_INLINE Candidate candidate(const Clay& clay, const Step& s, Pack t) {
    Candidate c;
    const Pack square = 1.0 + t * t; // p'_c / p'
    const Pack log_square = log(square), log_square_slope = 2.0 * t / square;
    c.x = s.lost / clay.lambda - clay.ratio_plastic * (s.log_ratio + log_square);
    c.x_slope = -clay.ratio_plastic * log_square_slope;
    c.pressure = s.pressure * exp(c.x);
    const Pack per_log = clay.ratio_plastic * clay.kappa / s.mean_volume;
    c.plastic = per_log * (s.log_ratio + s.lost / clay.kappa + log_square);
    c.plastic_slope = per_log * log_square_slope;
    c.shear = shear_modulus(clay, s, c.x);
    c.shear_slope = shear_modulus_slope(clay, s, c.x, c.x_slope, 0.0);
    c.elastic = shear_elastically(s, c.shear);
    c.elastic_size = deviator_size(c.elastic);

    const Pack q = clay.ratio * t * c.pressure, excess = c.elastic_size - q, wet = 1.0 - t * t;
    const Pack elastic_slope = 3.0 * inner(c.elastic, s.strain) / max(c.elastic_size, 1e-300) * c.shear_slope;
    const Pack q_slope = clay.ratio * c.pressure * (1.0 + t * c.x_slope);
    c.residual = 6.0 * c.shear * t * c.plastic - clay.ratio * excess * wet;
    c.residual_slope = 6.0 * (c.shear_slope * t * c.plastic + c.shear * (c.plastic + t * c.plastic_slope)) -
                       clay.ratio * ((elastic_slope - q_slope) * wet - 2.0 * t * excess);
    return c;
}

struct Root {
    Pack t;
    Mask missed; // lanes of `wanted` without a result
};

// The residual is negative at the nearer to 0 of 1, the critical state, and t of no plastic volume, and positive at
// the other: Newton's method, by bisection where it leaves what is known to hold the root
// or does not halve its steps.
inline Root solve(const Clay& clay, const Step& s, Mask wanted) {
    constexpr int most_iterations = 100;
    constexpr double close = 1e-10;                               // the step from here squares the error
    const Pack swollen = exp(-s.log_ratio - s.lost / clay.kappa); // p'_c / p' without plastic strain
    Pack t = select(wanted, sqrt(max(swollen - 1.0, 0.0)), 1.0);
    Pack low = min(t, 1.0), high = max(t, 1.0);
    Pack move = high - low;
    Mask open = wanted;
    for (int i = 0; i < most_iterations && any(open); ++i) {
        const Candidate c = candidate(clay, s, t);
        low = select(c.residual <= 0.0, t, low);
        high = select(c.residual <= 0.0, high, t);
        // On the dry side t may be of any size.
        const Pack middle = select(low < 1.0, 0.5 * (low + high), sqrt(low * high));
        const Pack newton = t - c.residual / c.residual_slope;
        const Mask good = (newton >= low) & (newton <= high) & (abs(newton - t) <= 0.5 * move);
        const Pack next = select(good, newton, middle);
        move = abs(next - t);
        const Mask settled = move <= close * max(next, 1.0);
        t = select(open, next, t);
        open = open & !settled;
    }
    return {t, open};
}

struct Returned {
    Mask plastic, missed;
    Pack t; // q / (M p') where plastic
    Pack x; // growth of ln p'
    Pack pressure, preconsolidation, shear, plastic_shear;
    SymmetricTensor elastic, deviator;
    Mask at_least_pressure;
};

GAULT_INLINE Returned return_to_surface(const Clay& clay, const Step& s) {
    Returned r;
    r.x = s.lost / clay.kappa;
    r.pressure = s.pressure * exp(r.x);
    r.preconsolidation = s.preconsolidation;
    r.shear = shear_modulus(clay, s, r.x);
    r.elastic = r.deviator = shear_elastically(s, r.shear);
    r.plastic_shear = r.t = 0.0;
    const Pack scaled = deviator_size(r.elastic) / clay.ratio;
    r.plastic = scaled * scaled + r.pressure * (r.pressure - r.preconsolidation) > 0.0;
    r.missed = Mask{};
    if (any(r.plastic)) {
        const Root root = solve(clay, s, r.plastic);
        const Candidate c = candidate(clay, s, root.t);
        const Pack q = min(clay.ratio * root.t * c.pressure, c.elastic_size);
        const Pack scale = q / max(c.elastic_size, 1e-300);
        r.missed = root.missed;
        r.t = root.t;
        r.x = select(r.plastic, c.x, r.x);
        r.pressure = select(r.plastic, c.pressure, r.pressure);
        r.preconsolidation = select(r.plastic, c.pressure * (1.0 + root.t * root.t), r.preconsolidation);
        r.shear = select(r.plastic, c.shear, r.shear);
        r.plastic_shear = select(r.plastic, (c.elastic_size - q) / (3.0 * c.shear), 0.0);
        for (int i = 0; i < 6; ++i) {
            r.elastic[i] = select(r.plastic, c.elastic[i], r.elastic[i]);
            r.deviator[i] = select(r.plastic, scale * c.elastic[i], r.deviator[i]);
        }
    }
    // Raising both keeps the deviator within the ellipse: p'_c is at least twice the least pressure.
    r.at_least_pressure = r.pressure <= least_pressure;
    r.pressure = max(r.pressure, least_pressure);
    r.preconsolidation = max(r.preconsolidation, least_preconsolidation);
    return r;
}

} // namespace GAULT_ISA
} // namespace modified_cam_clay
