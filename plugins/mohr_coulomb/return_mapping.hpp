// Return of principal trial stresses to the surface, in the manner of Clausen, Damkilde and Andersen (2006):
// a given surface is piecewise linear, so each region has a closed form and the signs of linear functions say
// which region holds.
#pragma once
#include "sensitive.hpp"
#include "surface.hpp"

namespace mohr_coulomb {
inline namespace GAULT_ISA {

template <class Stress>
struct ReturnedOf {
    Stress s1, s2, s3;     // Pa
    Stress plastic_strain; // increment of sqrt(2/3 dep:dep)
    Pack region;           // of type Region
};
using Returned = ReturnedOf<Pack>;

// What a return to a surface of these numbers ends in.
template <class Number>
struct StressOf {
    using type = Number;
};
template <>
struct StressOf<double> {
    using type = Pack;
};

GAULT_INLINE Mask yields(const Surface& k, Pack s1, Pack s3) {
    const Mask shear = s1 - k.kappa * s3 > k.y;
    return k.cut_off ? shear | (s1 > k.tension) : shear;
}

namespace detail {

// Where the plane return leaves the order s1 >= s2 >= s3, an edge or the apex takes over. A trial state that
// violates both inequalities lies beyond the apex; that the two edges exclude each other elsewhere is proved
// in the README.
template <class Number, class Stress>
GAULT_INLINE void return_to_edges(const SurfaceOf<Number>& k, const Returned& trial, Stress f,
                                  Mask compression, Mask extension, ReturnedOf<Stress>& r) {
    const Pack d12 = trial.s1 - trial.s2, d23 = trial.s2 - trial.s3;
    const Stress s3_compression = trial.s3 + (f - 0.5 * d12) * k.s3_gain_compression;
    const Stress s3_extension = (trial.s3 + 0.5 * d23) + (f - k.half_kappa * d23) * k.s3_gain_extension;
    r.s3 = select(compression, s3_compression, r.s3);
    r.s3 = select(extension, s3_extension, r.s3);
    r.region = select(compression, double{compression_edge}, r.region);
    r.region = select(extension, double{extension_edge}, r.region);
    const Mask beyond = (r.s3 > k.apex) | (compression & extension & (Stress(k.apex) < HUGE_VAL));
    r.s3 = select(beyond, k.apex, r.s3);
    r.s1 = select(beyond, k.apex, k.kappa * r.s3 + k.y);
    r.s2 = select(compression, r.s1, select(extension, r.s3, r.s2));
    r.region = select(beyond, double{apex}, r.region);
}

// Where the return to the shear surface alone ends beyond the cut-off: the cut-off alone if that satisfies
// the shear condition, else the line on which both hold, between its ends at s2 = s3 and s2 = s1.
template <class Number, class Stress>
GAULT_INLINE void return_to_cut_off(const SurfaceOf<Number>& k, const Returned& trial, Mask beyond,
                                    ReturnedOf<Stress>& r) {
    const Stress t = k.tension;
    const Stress lateral = k.tension_ratio * (trial.s1 - t);
    Stress s2 = trial.s2 - lateral, s3 = trial.s3 - lateral;
    Pack region = double{tension_plane};
    const Mask edge = s2 > t;
    s3 = select(edge, trial.s3 - k.poisson * ((trial.s1 - t) + (trial.s2 - t)), s3);
    region = select(edge, double{tension_edge}, region);
    region = select(s3 > t, double{fixed_point}, region);
    s2 = min(s2, t);
    s3 = min(s3, t);

    const Mask both = !((trial.s1 > t) & (s3 >= k.tension_s3));
    const Stress on_line = trial.s2 - k.poisson * ((trial.s1 - t) + (trial.s3 - k.tension_s3));
    const Mask inside = (on_line > k.tension_s3) & (on_line < t);
    region = select(both, select(inside, Pack(double{line}), double{fixed_point}), region);
    s2 = select(both, min(max(on_line, k.tension_s3), t), s2);
    s3 = select(both, k.tension_s3, s3);

    r.s1 = select(beyond, t, r.s1);
    r.s2 = select(beyond, s2, r.s2);
    r.s3 = select(beyond, s3, r.s3);
    r.region = select(beyond, region, r.region);
}

template <class Number, class Stress>
GAULT_INLINE Stress plastic_strain(const SurfaceOf<Number>& k, const Returned& trial,
                                   const ReturnedOf<Stress>& r) {
    const Stress d1 = trial.s1 - r.s1, d2 = trial.s2 - r.s2, d3 = trial.s3 - r.s3;
    const Stress trace = d1 + d2 + d3;
    const Stress square = (d1 * d1 + d2 * d2 + d3 * d3) - k.trace_weight * (trace * trace);
    return sqrt(max(k.strain_measure * square, 0.0));
}

} // namespace detail

// For s1 >= s2 >= s3. Lanes that do not yield come back as they were.
template <class Number>
GAULT_INLINE auto return_to_surface(const SurfaceOf<Number>& k, Pack s1, Pack s2, Pack s3) {
    using Stress = typename StressOf<Number>::type;
    const Returned trial{s1, s2, s3, 0.0, 0.0};
    const Stress f = max(s1 - k.kappa * s3 - k.y, 0.0);
    const Mask shears = f > 0.0;
    ReturnedOf<Stress> r;
    r.s3 = s3 + f * k.s3_gain;
    r.s2 = s2 - f * k.s2_loss;
    // From the surface, not from the trial state: F = 0 at the size of the result.
    r.s1 = k.kappa * r.s3 + k.y;
    r.plastic_strain = f * k.strain_gain;
    r.region = double{plane};

    const Mask compression = k.per_f * f > s1 - s2;
    const Mask extension = k.order_23 * f > s2 - s3;
    Mask general = compression | extension;
    if (any(general)) detail::return_to_edges(k, trial, f, compression, extension, r);
    r.s1 = select(shears, r.s1, s1);
    r.region = select(shears, r.region, double{elastic});
    if (k.cut_off) {
        const Mask beyond = r.s1 > k.tension;
        if (any(beyond)) detail::return_to_cut_off(k, trial, beyond, r);
        general = general | beyond;
    }
    r.s2 = max(min(r.s2, r.s1), r.s3);
    if (any(general))
        r.plastic_strain = select(general, detail::plastic_strain(k, trial, r), r.plastic_strain);
    return r;
}

struct PerfectSurface {
    Surface surface;
    Jacobians jacobians;
};
GAULT_INLINE Mask is_mobilised(const PerfectSurface& k, Pack s1, Pack s3) {
    return is_mobilised(k.surface.kappa, k.surface.y, s1, s3);
}
GAULT_INLINE Mask yields(const PerfectSurface& k, Pack s1, Pack s3) {
    return yields(k.surface, s1, s3);
}
GAULT_INLINE Returned return_to_surface(const PerfectSurface& k, Pack s1, Pack s2, Pack s3) {
    return return_to_surface(k.surface, s1, s2, s3);
}

} // namespace GAULT_ISA
} // namespace mohr_coulomb
