// The rate equations of von Wolffersdorff (1996) and Niemunis and Herle (1997). Tension positive; T is the
// stress less p_t in every direction, T^ = T / tr T, T^* its deviator, p* = -tr T / 3. See README.md.
#pragma once
#include <gault/material.hpp>

#include <algorithm>

namespace hypoplastic_sand {
inline namespace GAULT_ISA {

using gault::Components;
using gault::Mask;
using gault::Pack;

struct Constants {
    double hardness, exponent;            // h_s, Pa; n
    double densest, critical, loosest;    // e_d0, e_c0, e_i0
    double alpha, beta;                   // of f_d, of f_e
    double shift;                         // p_t, Pa
    double a;                             // of the critical friction angle
    double barotropy;                     // what f_b has that does not depend on the state, Pa
    double most_f_d;                      // beyond it isotropic compression would have a negative stiffness
    bool remembers;                       // has an intergranular strain
    double radius, m_r, m_t, beta_r, chi; // of the intergranular strain
};

// A memory this near to R D/|D|, over R, is there and stays: the decay of the rest would limit the length of
// substeps for stability, for nothing.
constexpr double arrival = 1e-7;

struct State {
    Components stress, memory; // Pa; the intergranular strain
};

// No principal value of T is above -slack p*, so that F exists.
constexpr double slack = 0.01;

GAULT_INLINE Pack trace(const Components& t) {
    return t[0] + t[1] + t[2];
}
GAULT_INLINE Pack product(const Components& u, const Components& v) {
    return (u[0] * v[0] + u[1] * v[1] + u[2] * v[2]) + 2.0 * (u[3] * v[3] + u[4] * v[4] + u[5] * v[5]);
}
GAULT_INLINE Pack norm(const Components& t) {
    return sqrt(product(t, t));
}
GAULT_INLINE Pack determinant(const Components& t) {
    return t[0] * (t[1] * t[2] - t[4] * t[4]) - t[3] * (t[3] * t[2] - t[4] * t[5]) +
           t[5] * (t[3] * t[4] - t[1] * t[5]);
}
GAULT_INLINE Components deviator(Components t) {
    const Pack mean = trace(t) / 3.0;
    for (int i = 0; i < 3; ++i)
        t[i] -= mean;
    return t;
}
GAULT_INLINE Components sum(const Components& t, Pack factor, const Components& added) {
    Components result;
    for (int i = 0; i < 6; ++i)
        result[i] = t[i] + factor * added[i];
    return result;
}

// cos 3 theta of a deviator whose square is given: -1 in triaxial compression of T^, which is positive there.
GAULT_INLINE Pack cosine_3_theta(const Components& s, Pack square) {
    const Pack cube = max(square * sqrt(square), 1e-100);
    return max(-1.0, min(1.0, -3.0 * std::sqrt(6.0) * determinant(s) / cube));
}

// Nearest admissible stress: no tensile mean stress, and the deviator is shortened where a principal value of
// T would be above -slack p*. A stress that is admissible keeps its bits.
inline Components admissible(const Constants& k, const Components& stress) {
    const Pack mean = trace(stress) / 3.0, held = min(mean, 0.0);
    const Pack room = (1.0 - slack) * (k.shift - held);
    const Components s = deviator(stress);
    const Pack square = product(s, s), radius = std::sqrt(2.0 / 3.0) * sqrt(square);
    Pack scale = 1.0;
    if (any(radius > room)) { // the largest principal value of s is at most the radius
        const Pack third =
            gault::map([](double c) { return std::cos(std::acos(c) / 3.0); }, -cosine_3_theta(s, square));
        scale = min(1.0, room / max(radius * third, 1e-100));
    }
    const Mask kept = (mean <= 0.0) & (scale == 1.0);
    Components result;
    for (int i = 0; i < 6; ++i)
        result[i] = select(kept, stress[i], scale * s[i] + (i < 3 ? held : Pack(0.0)));
    return result;
}

GAULT_INLINE Components within_radius(const Constants& k, const Components& memory) {
    const Pack scale = min(1.0, k.radius / max(norm(memory), 1e-100));
    Components result;
    for (int i = 0; i < 6; ++i)
        result[i] = scale * memory[i];
    return result;
}

struct Bounds {                            // of the void ratio, at a pressure
    Pack densest, critical, loosest, load; // load: 3 p* / h_s, at most 1
    Pack power;                            // load^n
};
GAULT_INLINE Bounds bounds(const Constants& k, Pack pressure) {
    Bounds b;
    b.load = min(3.0 * pressure / k.hardness, 1.0);
    b.power = pow(b.load, k.exponent);
    const Pack bauer = exp(-b.power);
    b.densest = k.densest * bauer;
    b.critical = k.critical * bauer;
    b.loosest = k.loosest * bauer;
    return b;
}

// The law at a state: T. = s_I E + s_T T^ (T^:E) + s_N c (T^ + T^*), where E is D and c is f_d |D| without
// intergranular strain.
struct Law {
    Components direction;          // T^
    Pack square;                   // T^:T^
    Pack f, f_d, tan_psi;          // F of Matsuoka and Nakai; pyknotropy; sqrt(3) |T^*|
    Pack linear, along, nonlinear; // s_I, s_T, s_N; Pa
    Pack pressure;                 // p*

    // |L^-1 N|: above 1 outside of the limit surface.
    Pack overstress(const Constants& k) const {
        const Pack mixed = 2.0 * square - 1.0 / 3.0;
        const Pack part = k.a * k.a * mixed / (f * f + k.a * k.a * square);
        Components b;
        for (int i = 0; i < 6; ++i)
            b[i] = (2.0 - part) * direction[i] - (i < 3 ? 1.0 / 3.0 : 0.0);
        return f_d * k.a / f * norm(b);
    }
    // Of the traction on a plane, per unit of the strain of a wave through it, in any direction and after any
    // history: README.md, "Bound of the modulus".
    Pack stiffness_bound(const Constants& k) const {
        const double turned = std::max(k.m_r - k.m_t, k.m_t - 1.0);
        const Pack largest = (1.0 + std::sqrt(2.0) * tan_psi) / 3.0;
        return k.m_r * linear + along * largest * (k.m_t * largest + turned * sqrt(square)) +
               nonlinear * f_d * (2.0 * largest - 1.0 / 3.0);
    }
};

inline Law law(const Constants& k, const Components& stress, Pack void_ratio) {
    Law at;
    const Pack total = trace(stress) - 3.0 * k.shift;
    at.pressure = total / -3.0;
    for (int i = 0; i < 6; ++i)
        at.direction[i] = (stress[i] - (i < 3 ? k.shift : 0.0)) / total;
    at.square = product(at.direction, at.direction);
    const Components s = deviator(at.direction);
    const Pack s_square = product(s, s), t = sqrt(3.0 * s_square);
    const Pack c = cosine_3_theta(s, s_square);
    at.tan_psi = t;
    at.f = sqrt(t * t / 8.0 + (2.0 - t * t) / (2.0 + std::sqrt(2.0) * t * c)) - t / (2.0 * std::sqrt(2.0));

    const Bounds e = bounds(k, at.pressure);
    const Pack looseness = max(void_ratio - e.densest, 0.0) / (e.critical - e.densest);
    at.f_d = min(pow(looseness, k.alpha), k.most_f_d);
    const Pack f_e = pow(e.critical / max(void_ratio, e.densest), k.beta);
    const Pack f_b = k.barotropy * (1.0 + e.loosest) / e.loosest * (e.load / e.power);
    const Pack f_s = f_b * f_e / at.square;
    at.linear = f_s * at.f * at.f;
    at.along = f_s * (k.a * k.a);
    at.nonlinear = f_s * k.a * at.f;
    return at;
}

// The stiffness of the linear part in a direction at right angles to the intergranular strain, over that
// without.
GAULT_INLINE Pack linear_factor(const Constants& k, const Components& memory) {
    if (!k.remembers) return 1.0;
    const Pack power = pow(min(norm(memory) / k.radius, 1.0), k.chi);
    return power * k.m_t + (1.0 - power) * k.m_r;
}

// Rates for the strain D per unit of pseudo-time.
inline State rate(const Constants& k, const Law& at, const Components& memory, const Components& strain) {
    State r;
    Components e = strain;
    Pack flow = at.f_d * norm(strain);
    r.memory = strain;
    if (k.remembers) {
        const Pack length = norm(memory), rho = min(length / k.radius, 1.0);
        const Pack inverse = 1.0 / max(length, 1e-100);
        Components along;
        for (int i = 0; i < 6; ++i)
            along[i] = inverse * memory[i];
        const Pack loading = product(along, strain);
        const Mask forward = loading > 0.0;
        const Pack power = pow(rho, k.chi);
        const Pack extra = power * select(forward, 1.0 - k.m_t, k.m_r - k.m_t) * loading;
        const Pack factor = power * k.m_t + (1.0 - power) * k.m_r;
        const Pack spent = select(forward, pow(rho, k.beta_r) * loading, 0.0);
        const Pack speed = norm(strain);
        const Mask arrived = norm(sum(strain, -1.0 / k.radius * speed, memory)) <= arrival * speed;
        for (int i = 0; i < 6; ++i) {
            e[i] = factor * strain[i] + extra * along[i];
            r.memory[i] = select(arrived, 0.0, strain[i] - spent * along[i]);
        }
        flow = at.f_d * power * max(loading, 0.0);
    }
    const Pack along = at.along * product(at.direction, e), nonlinear = at.nonlinear * flow;
    for (int i = 0; i < 6; ++i)
        r.stress[i] = at.linear * e[i] + (along + 2.0 * nonlinear) * at.direction[i] -
                      (i < 3 ? nonlinear / 3.0 : Pack(0.0));
    return r;
}

} // namespace GAULT_ISA
} // namespace hypoplastic_sand
