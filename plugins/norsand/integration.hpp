// Substeps of a strain increment under error control: every one is taken whole and in halves, and continued with what
// both extrapolate to (second order). Their lengths are halves of halves of the increment, so a slightly different
// increment is cut alike, and a difference of two updates is the derivative of one rule.
#pragma once
#include "substep.hpp"

namespace norsand {
inline namespace GAULT_ISA {

constexpr double largest_growth = 0.2; // of ln p' and ln p_i in a piece, about
constexpr double tolerance = 1e-2;     // whole against halves, of p' and p_i
constexpr int most_attempts = 2000;

GAULT_INLINE Increment part(const Increment& whole, Pack share) {
    Increment p{share * whole.volumetric, {}};
    for (int i = 0; i < 6; ++i)
        p.deviator[i] = share * whole.deviator[i];
    return p;
}
GAULT_INLINE State choose(Mask m, const State& yes, const State& no) {
    State s;
    s.pressure = select(m, yes.pressure, no.pressure);
    s.image = select(m, yes.image, no.image);
    s.plastic_strain = select(m, yes.plastic_strain, no.plastic_strain);
    for (int i = 0; i < 6; ++i)
        s.deviator[i] = select(m, yes.deviator[i], no.deviator[i]);
    s.plastic = (yes.plastic & m) | (no.plastic & !m);
    return s;
}

// One step, and how far it is from two halves, of its pressure.
struct Attempt {
    State state;
    Pack error;
};
inline Attempt attempt(const Sand& sand, const State& from, const Increment& by, Pack middle, Pack end) {
    const State whole = step(sand, from, by, end);
    if (!any(whole.plastic)) return {whole, 0.0}; // elasticity is exact
    const Increment half = part(by, 0.5);
    const State halves = step(sand, step(sand, from, half, middle), half, end);
    Attempt a{halves, abs(halves.pressure - whole.pressure) / halves.pressure};
    a.state.pressure = max(2.0 * halves.pressure - whole.pressure, least_pressure);
    a.state.image = max(2.0 * halves.image - whole.image, 0.0);
    a.state.plastic_strain = max(from.plastic_strain, 2.0 * halves.plastic_strain - whole.plastic_strain);
    for (int i = 0; i < 6; ++i) {
        a.error = max(a.error, abs(halves.deviator[i] - whole.deviator[i]) / halves.pressure);
        a.state.deviator[i] = 2.0 * halves.deviator[i] - whole.deviator[i];
    }
    a.error = max(a.error, abs(halves.image - whole.image) / halves.image);
    settle(sand, a.state, end);
    const Mask elastic = !whole.plastic;
    return {choose(elastic, whole, a.state), select(elastic, 0.0, a.error)};
}

// Void ratio after a share of the increment: grains keep their volume and strain is logarithmic.
GAULT_INLINE Pack void_ratio_at(Pack old, Pack volumetric, Pack share) {
    return (1.0 + old) * exp(-share * volumetric) - 1.0;
}

// Pieces of an increment, a power of two: by what a piece may do to ln p' and ln p_i as they stand.
GAULT_INLINE Pack pieces(const Sand& sand, const State& s, const Increment& by, Pack void_ratio) {
    const Pack psi = state_parameter(sand, s.pressure, void_ratio);
    const Pack x = max(-1.0, min(log(s.image / s.pressure), largest_log_ratio(sand, psi)));
    const Pack limit = image_at(sand, psi + sand.lambda * x).limit;
    const Pack hardening =
        max(1.0, sand.hardening - sand.slope * psi) * exp(-2.0 * x) * abs(exp(limit) - exp(x));
    const Pack rate = max(bulk_modulus(sand, s.pressure) / s.pressure, hardening);
    const Pack amount = abs(by.volumetric) + sqrt(inner(by.deviator, by.deviator));
    return gault::map([](double n) { return std::exp2(std::ceil(std::log2(std::max(n, 1.0)))); },
                      amount * rate / largest_growth);
}

// Answers the lanes that are not done after as many attempts as there may be.
inline Mask integrate(const Sand& sand, State& state, const Increment& whole, Pack void_ratio, Mask wanted) {
    const Pack most = 1.0 / pieces(sand, state, whole, void_ratio);
    Pack done = 0.0, size = most;
    Mask open = wanted;
    for (int i = 0; i < most_attempts && any(open); ++i) {
        const Attempt a = attempt(sand, state, part(whole, size),
                                  void_ratio_at(void_ratio, whole.volumetric, done + 0.5 * size),
                                  void_ratio_at(void_ratio, whole.volumetric, done + size));
        const Mask good = open & (a.error <= tolerance);
        state = choose(good, a.state, state);
        done = select(good, done + size, done);
        const Pack twice = 2.0 * size; // only where the next piece ends on a multiple of its length
        const Pack multiple = gault::map([](double x) { return std::floor(x); }, done / twice) * twice;
        const Mask longer = good & (a.error <= tolerance / 8.0) & (multiple == done) & (twice <= most);
        size = select(open & !good, 0.5 * size, select(longer, twice, size));
        open = open & (done < 1.0);
    }
    return open;
}

} // namespace GAULT_ISA
} // namespace norsand
