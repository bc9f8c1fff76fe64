// Strength that falls, linearly in the plastic strain, from peak to ultimate values, and the return to the
// surface of the strength at the end of the step: one scalar equation over the closed forms of
// return_mapping.hpp.
#pragma once
#include "return_mapping.hpp"

#include <gault/material.hpp>

namespace mohr_coulomb {
inline namespace GAULT_ISA {

struct Softening {           // constants of a soil
    struct Angle {           // rad
        double sine, cosine; // of the peak angle
        double change;       // from peak to ultimate
    };
    double young_modulus, poisson_ratio;
    Angle friction, dilation;
    double cohesion, cohesion_change; // Pa
    double tension_strength;          // Pa; infinity: none
    double strain;                    // plastic strain from peak to ultimate, in a cell as long as `length`
    double length;                    // m; 0: the strain is the same in every cell
};

namespace detail {

struct Turned {
    Sensitive sine, cosine;
};

// Of the peak angle plus a share of its change, which is within pi. Series of half the turn, to rounding: the
// same on every processor, which a library's sine is not.
GAULT_INLINE Turned turned(const Softening::Angle& angle, Sensitive share) {
    const Pack half = 0.5 * (angle.change * share.value), square = half * half;
    Pack s = 1.0, c = 1.0;
    for (int n = 22; n >= 2; n -= 2) {
        s = 1.0 - square * s * (1.0 / ((n + 1) * n));
        c = 1.0 - square * c * (1.0 / (n * (n - 1)));
    }
    s = half * s;
    const Pack sine = 2.0 * s * c, cosine = 1.0 - 2.0 * s * s, rate = angle.change * share.rate;
    const Pack new_sine = angle.sine * cosine + angle.cosine * sine,
               new_cosine = angle.cosine * cosine - angle.sine * sine;
    return {{new_sine, new_cosine * rate}, {new_cosine, -new_sine * rate}};
}

} // namespace detail

// Of soil that has strained plastically by `strained`; ultimate where that is `end` or more.
inline SurfaceOf<Sensitive> surface(const Softening& m, Pack strained, Pack end) {
    const Mask softens = strained < end;
    const Sensitive share{select(softens, strained / end, 1.0), select(softens, 1.0 / end, 0.0)};
    SurfaceOf<Sensitive> k;
    detail::set_elasticity(k, m.young_modulus, m.poisson_ratio);
    const detail::Turned friction = detail::turned(m.friction, share),
                         dilation = detail::turned(m.dilation, share);
    const Sensitive sine = max(friction.sine, 0.0), root = friction.cosine / (1.0 + sine);
    const Sensitive cohesion = max(m.cohesion + m.cohesion_change * share, 0.0);
    const Sensitive flow = dilation.cosine / (1.0 + dilation.sine);
    k.kappa = root * root;
    k.y = 2.0 * cohesion * root;
    k.mu = flow * flow;
    detail::set_returns(k);

    const Sensitive vertex = cohesion * friction.cosine / sine; // infinite without friction
    const Mask cut = Pack(m.tension_strength) < vertex.value;
    k.cut_off = m.tension_strength < HUGE_VAL;
    k.apex = select(cut | !(vertex.value < HUGE_VAL), HUGE_VAL, vertex);
    k.tension = select(cut, Pack(m.tension_strength), HUGE_VAL);
    k.tension_s3 = select(cut, (m.tension_strength - k.y) / k.kappa, 0.0);
    return k;
}

struct SofteningSurface { // of the points of a pack
    const Softening* soil;
    Pack old, end; // plastic strain at the start of the step, and from peak to ultimate
    SurfaceOf<Sensitive> start;
};

GAULT_INLINE SofteningSurface softening_surface(const Softening& m, Pack old, Pack cell) {
    const Pack end = m.length > 0.0 ? m.strain * m.length / cell : Pack(m.strain);
    return {&m, old, end, surface(m, old, end)};
}

struct Softened : Returned {
    ReturnedOf<Sensitive> at;     // the same, with its change where the strength alone changes
    SurfaceOf<Sensitive> surface; // at the end of the step
    Pack snap_back;               // 0: none, 1: perhaps, the trial stress being far outside, 2: for certain
};

GAULT_INLINE Mask is_mobilised(const SofteningSurface& k, Pack s1, Pack s3) {
    return is_mobilised(k.start.kappa.value, k.start.y.value, s1, s3);
}

GAULT_INLINE Mask yields(const SofteningSurface& k, Pack s1, Pack s3) {
    const Mask shear = s1 - k.start.kappa.value * s3 > k.start.y.value;
    return shear | (s1 > k.start.tension.value);
}

// The plastic strain x at the end of the step: x = old + growth(x), growth that of the trial state on the
// surface of strength x. Newton's method within brackets, later halving; unique where growth'(x) < 1. From 1 on the
// strength falls faster than elastic strain can follow.
inline Softened return_to_surface(const SofteningSurface& k, Pack s1, Pack s2, Pack s3) {
    constexpr int newton = 20, most = 60;
    Softened r;
    r.surface = k.start;
    Pack strained = k.old, low = k.old, high = HUGE_VAL, steepest = 0.0, first = 0.0;
    Mask open;
    for (int n = 0;; ++n) {
        if (n > 0) r.surface = surface(*k.soil, strained, k.end);
        r.at = return_to_surface(r.surface, s1, s2, s3);
        const Sensitive growth = r.at.plastic_strain;
        if (n == 0) first = growth.value;
        steepest = max(steepest, growth.rate);
        const Pack missing = (k.old + growth.value) - strained;
        const Pack noise = (gault::abs(s1) + gault::abs(s3)) / r.surface.twice_shear + strained;
        open = gault::abs(missing) > 1e-15 * noise;
        if (n == most || !any(open)) break;
        low = select(missing > 0.0, strained, low);
        high = select(missing > 0.0, high, strained);
        const Pack middle = select(high < HUGE_VAL, 0.5 * (low + high), max(k.end, strained + growth.value));
        const Pack next = strained + missing / max(1.0 - growth.rate, 1e-6);
        const Mask inside = (next > low) & (next < (n < newton ? high : Pack(low)));
        strained = select(open, select(inside, next, middle), strained);
    }
    const Mask snaps = (first > 0.0) & (open | (steepest >= 1.0));
    r.snap_back = select(snaps, select(first > 0.01 * k.end, Pack(1.0), 2.0), 0.0);
    static_cast<Returned&>(r) = {r.at.s1.value, r.at.s2.value, r.at.s3.value, strained - k.old, r.at.region};
    return r;
}

} // namespace GAULT_ISA
} // namespace mohr_coulomb
