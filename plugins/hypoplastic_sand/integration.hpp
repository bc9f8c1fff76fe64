// Runge-Kutta-Fehlberg of order 2(3) over one increment of strain (Fellin and Ostermann 2002; Tamagnini,
// Viggiani and Chambon 2000), with substeps of its own for every lane of the pack: a lane that has arrived
// stands still while others go on. Substeps are powers of two of the increment: a change of the strain too small
// to move an error across its bound leaves their lengths alone, so the result is as smooth as the law, which
// differences of it rely on.
#pragma once
#include "law.hpp"

namespace hypoplastic_sand {
inline namespace GAULT_ISA {

constexpr double tolerance = 1e-5; // of a substep, relative to |T| and to the radius of the memory
constexpr int most_attempts = 1000;
constexpr double least_growth = 0.125, safety = 0.85;

struct Increment {
    Components strain;
    Pack volumetric, void_ratio; // its trace; at its start

    // 1 + e grows with the volume, exactly: the strain is logarithmic.
    Pack void_ratio_at(Pack time) const {
        const Pack growth = gault::map([](double x) { return std::expm1(x); }, time * volumetric);
        return void_ratio + (1.0 + void_ratio) * growth;
    }
};

GAULT_INLINE State advanced(const Constants& k, const State& from, Pack factor, const State& rates) {
    State to = from;
    to.stress = admissible(k, sum(from.stress, factor, rates.stress));
    if (k.remembers) to.memory = within_radius(k, sum(from.memory, factor, rates.memory));
    return to;
}

GAULT_INLINE Pack error(const Constants& k, const State& rough, const State& fine) {
    const Pack stress = norm(sum(fine.stress, -1.0, rough.stress));
    const Pack pressure = k.shift - trace(fine.stress) / 3.0;
    Pack relative = stress / (std::sqrt(3.0) * pressure);
    if (k.remembers) relative = max(relative, norm(sum(fine.memory, -1.0, rough.memory)) / k.radius);
    return relative;
}

struct Substep {
    State end;
    Pack error;
};

inline Substep substep(const Constants& k, const Increment& increment, const State& from, const State& first,
                       Pack time, Pack length) {
    const auto rate_at = [&](const State& y, Pack when) {
        return rate(k, law(k, y.stress, increment.void_ratio_at(when)), y.memory, increment.strain);
    };
    const State second = rate_at(advanced(k, from, 0.5 * length, first), time + 0.5 * length);
    const State skewed{sum(second.stress, 1.0, sum(second.stress, -1.0, first.stress)),
                       sum(second.memory, 1.0, sum(second.memory, -1.0, first.memory))};
    const State third = rate_at(advanced(k, from, length, skewed), time + length);
    State mean;
    for (int i = 0; i < 6; ++i) {
        mean.stress[i] = (first.stress[i] + 4.0 * second.stress[i] + third.stress[i]) / 6.0;
        mean.memory[i] = (first.memory[i] + 4.0 * second.memory[i] + third.memory[i]) / 6.0;
    }
    const State rough = advanced(k, from, length, second), fine = advanced(k, from, length, mean);
    return {fine, error(k, rough, fine)};
}

GAULT_INLINE Pack power_of_two_below(Pack x) {
    return gault::map([](double value) { return std::ldexp(1.0, std::ilogb(value)); }, x);
}

// As much of the increment as changes neither the stress nor the memory by much.
GAULT_INLINE Pack first_length(const Constants& k, const Law& at, const State& rates) {
    Pack change = norm(rates.stress) / (0.05 * std::sqrt(3.0) * at.pressure);
    if (k.remembers) change = max(change, norm(rates.memory) / (0.3 * k.radius));
    return power_of_two_below(1.0 / max(change, 1.0));
}

// At most twice as long, and that only where the increment can be divided so from `time` on.
GAULT_INLINE Pack next_length(Pack length, Pack time, Pack error) {
    const Pack growth =
        safety / gault::map([](double x) { return std::cbrt(x); }, max(error / tolerance, 1e-30));
    // An error that is not a number shortens the substep.
    const Pack wanted = power_of_two_below(select(growth >= least_growth, min(growth, 2.0), least_growth));
    const Pack pairs = 0.5 * time / length;
    const Mask divides = gault::map([](double x) { return std::floor(x); }, pairs) == pairs;
    return length * select(divides, wanted, min(wanted, 1.0));
}

// Takes `y` and `at`, the law there, to the end of the increment where `goes`. True where that needed more than
// most_attempts.
inline Mask integrate(const Constants& k, const Increment& increment, Mask goes, State& y, Law& at) {
    Pack time = 0.0, length = 1.0;
    for (int attempt = 0; attempt < most_attempts && any(goes); ++attempt) {
        const State first = rate(k, at, y.memory, increment.strain);
        if (attempt == 0) length = first_length(k, at, first);
        const Substep trial = substep(k, increment, y, first, time, length);
        const Mask accepted = goes & (trial.error <= tolerance);
        for (int i = 0; i < 6; ++i) {
            y.stress[i] = select(accepted, trial.end.stress[i], y.stress[i]);
            y.memory[i] = select(accepted, trial.end.memory[i], y.memory[i]);
        }
        time = select(accepted, time + length, time);
        goes = goes & (time < 1.0);
        at = law(k, y.stress, increment.void_ratio_at(time));
        length = next_length(length, time, trial.error);
    }
    return goes;
}

} // namespace GAULT_ISA
} // namespace hypoplastic_sand
