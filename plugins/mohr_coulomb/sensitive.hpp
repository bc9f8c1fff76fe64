// A value and its derivative with the plastic strain, carried through the formulas of the return.
#pragma once
#include <gault/tensor.hpp>

namespace mohr_coulomb {
inline namespace GAULT_ISA {

using gault::any;
using gault::Mask;
using gault::max;
using gault::min;
using gault::Pack;
using gault::select;
using gault::sqrt;

struct Sensitive {
    Pack value, rate;

    Sensitive() = default;
    GAULT_INLINE Sensitive(double v) : value(v), rate(0.0) {}
    GAULT_INLINE Sensitive(Pack v) : value(v), rate(0.0) {}
    GAULT_INLINE Sensitive(Pack v, Pack r) : value(v), rate(r) {}
    GAULT_INLINE Sensitive operator-() const { return {-value, -rate}; }
};

GAULT_INLINE Sensitive operator+(Sensitive a, Sensitive b) {
    return {a.value + b.value, a.rate + b.rate};
}
GAULT_INLINE Sensitive operator-(Sensitive a, Sensitive b) {
    return {a.value - b.value, a.rate - b.rate};
}
GAULT_INLINE Sensitive operator*(Sensitive a, Sensitive b) {
    return {a.value * b.value, a.rate * b.value + a.value * b.rate};
}
GAULT_INLINE Sensitive operator/(Sensitive a, Sensitive b) {
    const Pack quotient = a.value / b.value;
    return {quotient, (a.rate - quotient * b.rate) / b.value};
}

GAULT_INLINE Mask operator<(Sensitive a, Sensitive b) {
    return a.value < b.value;
}
GAULT_INLINE Mask operator>(Sensitive a, Sensitive b) {
    return a.value > b.value;
}
GAULT_INLINE Mask operator>=(Sensitive a, Sensitive b) {
    return a.value >= b.value;
}

GAULT_INLINE Sensitive select(Mask m, Sensitive yes, Sensitive no) {
    return {select(m, yes.value, no.value), select(m, yes.rate, no.rate)};
}
GAULT_INLINE Sensitive min(Sensitive a, Sensitive b) {
    return select(a < b, a, b);
}
GAULT_INLINE Sensitive max(Sensitive a, Sensitive b) {
    return select(a > b, a, b);
}
GAULT_INLINE Sensitive sqrt(Sensitive a) {
    const Pack root = sqrt(a.value);
    return {root, 0.5 * a.rate / max(root, std::numeric_limits<double>::min())};
}

} // namespace GAULT_ISA
} // namespace mohr_coulomb
