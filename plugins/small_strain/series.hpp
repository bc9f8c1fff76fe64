// The overlay and the strength in series: a part of the strain is plastic, and both carry the same stress.
//
// The unknown is a trial stress T that returns to the strength along a fixed isotropic stiffness C. The stress S(T) is then
// admissible and the plastic strain C^-1 (T - S(T)) obeys the flow rule, whatever C is; what is left to be solved is that
// the overlay carries it too: overlay(strain - plastic) - S(T) = 0. Newton's method, with the derivatives of both.
#pragma once
#include "overlay.hpp"
#include "strength.hpp"

namespace small_strain {
inline namespace GAULT_ISA {

struct Solution {
    SymmetricTensor stress;
    Response overlay;
    Pack plastic_strain; // norm of the increment
    Mask plastic, unsolved;
    Matrix tangent; // only if asked for
};

struct Stiffness { // C: half way between the overlay's stiffest and its softest
    Pack bulk, twice_shear;
    GAULT_INLINE SymmetricTensor strain(const SymmetricTensor& stress) const {
        const Pack inverse = 1.0 / twice_shear, mean = trace(stress) * (1.0 / (9.0 * bulk) - inverse / 3.0);
        SymmetricTensor e;
        for (int c = 0; c < 6; ++c)
            e[c] = stress[c] * inverse + (c < 3 ? mean : Pack(0.0));
        return e;
    }
};

inline double return_shear(const Backbone& k) { // 2G of C at the reference pressure
    return 0.5 * (1.0 + k.spring) * k.twice_shear;
}

// D C^-1 (1 - J) + J, where D is the tangent of the overlay and J that of the return.
inline Matrix newton_matrix(const Stiffness& c, const Matrix& d, const Matrix& j) {
    Matrix flexible; // C^-1 (1 - J), column by column
    for (int k = 0; k < 6; ++k) {
        SymmetricTensor column;
        for (int i = 0; i < 6; ++i)
            column[i] = (i == k ? 1.0 : 0.0) - j[i][k];
        column = c.strain(column);
        for (int i = 0; i < 6; ++i)
            flexible[i][k] = column[i];
    }
    Matrix m = product(d, flexible);
    for (int i = 0; i < 6; ++i)
        for (int k = 0; k < 6; ++k)
            m[i][k] += j[i][k];
    return m;
}

// The next trial stress, in every lane: a Newton step from where the residual fell; half of the last step where it did
// not; after five halvings a step of the residual itself, whatever comes of it.
struct Search {
    SymmetricTensor trial, accepted, missing{}, direction{};
    Pack least = gault::infinity, fraction = 1.0;
    Mask forced;

    explicit Search(const SymmetricTensor& from) : trial(from), accepted(from), forced(least < 0.0) {}

    Mask accepts(Pack size) const { return forced | (size <= (1.0 - 1e-4 * fraction) * least); }
    void advance(Mask accept, const SymmetricTensor& residual, Pack size, const SymmetricTensor& newton) {
        accepted = select_lanes(accept, trial, accepted);
        missing = select_lanes(accept, residual, missing);
        direction = select_lanes(accept, newton, direction);
        least = select(accept, size, least);
        fraction = select(accept, 1.0, 0.5 * fraction);
        forced = fraction < 0.03;
        for (int c = 0; c < 6; ++c)
            trial[c] = accepted[c] + select(forced, missing[c], fraction * direction[c]);
        fraction = select(forced, 1.0, fraction);
    }
};

inline void keep(Mask where, const Admissible& a, const Response& r, const SymmetricTensor& plastic,
                 Solution& s) {
    s.stress = select_lanes(where, a.stress, s.stress);
    s.overlay = select_response(where, r, s.overlay);
    s.plastic_strain = select(where, norm(plastic), s.plastic_strain);
    s.unsolved = s.unsolved & !where;
}

// d stress / d strain = J (D C^-1 (1 - J) + J)^-1 D.
inline void keep_tangent(Mask where, Matrix newton, Matrix d, const Matrix& j, Solution& s) {
    solve(newton, d);
    const Matrix t = product(j, d);
    for (int i = 0; i < 6; ++i)
        s.tangent[i] = select_lanes(where, t[i], s.tangent[i]);
}

__attribute__((noinline)) inline void return_to_strength(const Backbone& k, const Strength& f,
                                                         const Overlay& old, const SymmetricTensor& strain,
                                                         bool wants_tangent, Solution& s) {
    constexpr int most_iterations = 60;
    constexpr double tolerance = 1e-11;
    const Stiffness c{k.bulk * old.stiffness, return_shear(k) * old.stiffness};
    // Elements that balance each other at the apex leave the rounding of what they carry.
    const Pack scale = norm(s.stress) + 1e-3 * (k.carried * old.stiffness);
    Search search(s.stress);
    s.unsolved = s.plastic;
    for (int iteration = 0; iteration < most_iterations && gault::any(s.unsolved); ++iteration) {
        const Admissible a = return_stress(f, search.trial);
        const SymmetricTensor plastic = c.strain(minus(search.trial, a.stress));
        const Response r = respond(k, old, minus(strain, plastic));
        const SymmetricTensor missing = minus(r.stress, a.stress);
        const Pack size = norm(missing);
        const Mask solved = s.unsolved & (size <= tolerance * (scale + norm(search.trial)));
        const Mask accept = search.accepts(size);
        keep(solved, a, r, plastic, s);

        std::array<std::array<Pack, 1>, 6> step{};
        if (gault::any(s.unsolved & accept) || (wants_tangent && gault::any(solved))) {
            const Matrix d = tangent(k, r, old.stiffness), j = derivative(f, a);
            Matrix newton = newton_matrix(c, d, j);
            if (wants_tangent && gault::any(solved)) keep_tangent(solved, newton, d, j, s);
            for (int i = 0; i < 6; ++i)
                step[i][0] = missing[i];
            solve(newton, step);
        }
        search.advance(accept, missing, size,
                       {step[0][0], step[1][0], step[2][0], step[3][0], step[4][0], step[5][0]});
    }
}

inline Solution advance(const Backbone& k, const Strength& f, const Overlay& old,
                        const SymmetricTensor& strain, bool wants_tangent) {
    Solution s;
    s.overlay = respond(k, old, strain);
    s.stress = s.overlay.stress;
    s.plastic_strain = 0.0;
    s.plastic = excess(f, s.stress) > 0.0;
    s.unsolved = s.plastic & !s.plastic;
    if (wants_tangent) s.tangent = tangent(k, s.overlay, old.stiffness);
    if (gault::any(s.plastic)) return_to_strength(k, f, old, strain, wants_tangent, s);
    return s;
}

} // namespace GAULT_ISA
} // namespace small_strain
