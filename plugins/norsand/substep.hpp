// One backward Euler step. M_i, D_min and the elastic moduli are those of its start (the void ratio that of its end);
// pressure, deviator and image pressure are those of its end, on the surface.
#pragma once
#include "surface.hpp"

namespace norsand {
inline namespace GAULT_ISA {

struct State {
    Pack pressure; // p', Pa
    SymmetricTensor deviator;
    Pack image;          // p_i, Pa
    Pack plastic_strain; // sum of d eps_q
    Mask plastic;        // at the end of the step that led here
};
struct Increment {
    Pack volumetric; // compression positive
    SymmetricTensor deviator;
};

// What the step knows before it yields.
struct Trial {
    Pack start, pressure, bulk, shear; // p' at the start and after elastic strain; secant moduli
    SymmetricTensor deviator;
    Pack size;                               // q
    Pack friction;                           // M(theta)
    Pack image;                              // p_i that counts
    Pack m;                                  // M_i
    Pack bend;                               // -d ln M_i / d ln p_i
    Pack hardening, limit, softening, least; // of the law below
    Mask yields;
};

// Growth of x with eps_q at constant p' and M_i of the start: d ln p_i, and what it does to M_i. Bounded from below
// where softening would outrun elastic unloading.
struct Hardening {
    Pack rate, slope;
};
GAULT_INLINE Hardening hardening(const Trial& t, Pack x) {
    const Pack fall = exp(-x), wet = min(x, 0.0), turn = 1.0 - t.bend * (1.0 + x);
    const Pack law = t.hardening * fall * (t.limit * fall - 1.0) + t.softening * wet * (1.0 + x);
    const Pack law_slope = t.hardening * fall * (1.0 - 2.0 * t.limit * fall) +
                           select(x < 0.0, t.softening * (1.0 + 2.0 * x), 0.0);
    const Pack rate = law * turn;
    return {max(rate, t.least), select(rate > t.least, law_slope * turn - law * t.bend, 0.0)};
}

GAULT_INLINE Trial try_elastically(const Sand& sand, const State& from, const Increment& by,
                                   Pack void_ratio) {
    Trial t;
    t.start = from.pressure;
    const Pack bulk = bulk_modulus(sand, from.pressure), rate = bulk / from.pressure;
    const Pack growth = rate * by.volumetric, rest = 1.0 - sand.power;
    const Pack log_growth =
        sand.power == 1.0
            ? growth
            : gault::map([](double g) { return std::log1p(g); }, max(rest * growth, -1.0)) / rest;
    const Pack relative = gault::map([](double g) { return std::expm1(g); }, log_growth);
    t.pressure = max(from.pressure + from.pressure * relative, least_pressure);
    t.bulk = select(abs(growth) < 1e-6, bulk * (1.0 + 0.5 * sand.power * growth),
                    (t.pressure - from.pressure) / select(abs(growth) < 1e-6, 1.0, by.volumetric));
    t.shear = sand.shear_per_bulk * max(t.bulk, bulk_modulus(sand, least_pressure));
    for (int i = 0; i < 6; ++i)
        t.deviator[i] = from.deviator[i] + 2.0 * t.shear * by.deviator[i];
    t.size = deviator_size(t.deviator);
    t.friction = friction(sand, t.deviator, t.pressure);

    const Pack psi = state_parameter(sand, t.pressure, void_ratio);
    t.image = from.image;
    const Image at = image_at(sand, state_parameter(sand, t.image, void_ratio));
    t.m = t.friction * at.shape;
    t.yields = (t.size > t.m * t.pressure * (1.0 + log(t.image / t.pressure))) |
               (t.size > t.friction * t.pressure * strength(sand, psi));
    t.bend = image_bend(sand, at) / at.shape;
    t.hardening = max(1.0, sand.hardening - sand.slope * psi) * t.friction / sand.ratio;
    t.limit = exp(at.limit);
    t.softening = select(psi > 0.0, sand.softening * rate * t.m * at.shape / (at.shape - at.dilatancy), 0.0);
    t.least = -0.9 * min(3.0 * t.shear / t.m, t.m * max(t.bulk, 1e-3 * bulk)) / t.pressure;
    return t;
}

// A point of the return, by z: on the surface where z = 1 + x >= 0; at its tip, q = 0, with less pressure where z < 0.
struct Candidate {
    Pack pressure, size, strain; // p', q, d eps_q
    Pack residual, slope;        // of the hardening law, over z
};
GAULT_INLINE Candidate candidate(const Trial& t, Pack z) {
    Candidate c;
    const Mask tip = z < 0.0;
    const Pack x = max(z, 0.0) - 1.0, y = 1.0 + x;
    const Hardening h = hardening(t, x);
    const Pack soft = t.bulk / (3.0 * t.shear) * t.m, base = 1.0 + soft * t.m * x * y;
    const Pack on = (t.start + (t.pressure - t.start) + soft * x * t.size) / base;
    const Mask free = on > least_pressure;
    const Pack on_slope = select(free, soft * (t.size - on * t.m * (1.0 + 2.0 * x)) / base, 0.0);
    const Pack on_pressure = max(on, least_pressure);
    const Pack strain = (t.size - t.m * y * on_pressure) / (3.0 * t.shear);
    const Pack strain_slope = -t.m * (on_pressure + y * on_slope) / (3.0 * t.shear);

    const Pack flow = t.m * max(t.bulk, 1e-3 * 3.0 * t.shear);
    const Pack tip_pressure = max(on_pressure * exp(min(z, 0.0)), least_pressure);
    const Pack tip_strain = max(0.0, t.pressure - tip_pressure) / flow;

    c.pressure = select(tip, tip_pressure, on_pressure);
    c.size = select(tip, 0.0, t.m * y * on_pressure);
    c.strain = max(0.0, select(tip, tip_strain, strain));
    c.residual = x + log(c.pressure / t.image) - h.rate * c.strain;
    c.slope = select(tip, 1.0 + h.rate * c.pressure / flow,
                     1.0 + on_slope / on_pressure - h.slope * c.strain - h.rate * strain_slope);
    return c;
}

// Newton's method; by bisection where it leaves what is known to hold the root or does not halve its steps. No more than
// what is elastic, where p_i is beyond what counts.
inline Pack solve(const Trial& t, Mask wanted) {
    constexpr int most_iterations = 80;
    constexpr double close = 1e-9; // the step from here squares the error
    const Pack elastic = t.size / (t.m * t.pressure);
    const Candidate end = candidate(t, 0.0);
    const Mask tip = end.residual >= 0.0;
    Pack low = select(tip, log(least_pressure / end.pressure) - 1.0, 0.0);
    Pack high = select(tip, 0.0, elastic);
    const Pack start = 1.0 + log(t.image / t.pressure);
    Mask open = wanted & (start < elastic);
    Pack z = select(open, max(low, min(high, start)), elastic);
    Pack move = high - low;
    for (int i = 0; i < most_iterations && any(open); ++i) {
        const Candidate c = candidate(t, z);
        low = select(c.residual <= 0.0, z, low);
        high = select(c.residual <= 0.0, high, z);
        const Pack newton = z - c.residual / c.slope;
        const Mask good = (newton >= low) & (newton <= high) & (abs(newton - z) <= 0.5 * move);
        const Pack next = select(good, newton, 0.5 * (low + high));
        move = abs(next - z);
        z = select(open, next, z);
        open = open & (move > close * max(abs(z), 1e-3));
    }
    return z;
}

// The return, within the strength of the density at the pressure where it ends.
inline Candidate return_to_surface(const Sand& sand, const Trial& t, Pack void_ratio) {
    const Pack z = solve(t, t.yields);
    Candidate c = candidate(t, z);
    for (int i = 0; i < 3; ++i) { // the strength hardly depends on the pressure
        const Pack most = strength(sand, state_parameter(sand, c.pressure, void_ratio));
        c = candidate(t, min(z, t.friction / t.m * most));
    }
    return c;
}

// Puts p_i where the surface passes through the stress, and the stress within the strength of the density.
GAULT_INLINE void settle(const Sand& sand, State& s, Pack void_ratio) {
    const Pack psi = state_parameter(sand, s.pressure, void_ratio);
    const Pack size = deviator_size(s.deviator), unit = friction(sand, s.deviator, s.pressure) * s.pressure;
    const Pack most = strength(sand, psi), scaled = min(size / unit, most);
    const Mask strong = size > most * unit;
    const Pack scale = most * unit / max(size, 1e-300);
    for (int i = 0; i < 6; ++i)
        s.deviator[i] = select(strong, scale * s.deviator[i], s.deviator[i]);
    const Pack through = s.pressure * exp(log_ratio_through(sand, scaled, psi));
    s.image = select(s.plastic, through, max(s.image, through));
    if (sand.cap) s.image = min(s.image, s.pressure * exp(largest_log_ratio(sand, psi)));
}

inline State step(const Sand& sand, const State& from, const Increment& by, Pack void_ratio) {
    const Trial t = try_elastically(sand, from, by, void_ratio);
    State to{t.pressure, t.deviator, from.image, from.plastic_strain, t.yields};
    if (any(t.yields)) {
        const Candidate c = return_to_surface(sand, t, void_ratio);
        const Pack scale = c.size / max(t.size, 1e-300);
        to.pressure = select(t.yields, c.pressure, t.pressure);
        for (int i = 0; i < 6; ++i)
            to.deviator[i] = select(t.yields, scale * t.deviator[i], t.deviator[i]);
        to.plastic_strain += select(t.yields, c.strain, 0.0);
    }
    settle(sand, to, void_ratio);
    return to;
}

} // namespace GAULT_ISA
} // namespace norsand
