// What the soils of these tests are made of: elasticity, a cone of Drucker and Prager with its tangent, neo-Hookean soil at
// finite strain; and a wrapper for what the SDK would not let a soil do.
#pragma once
#include <gault/material.hpp>
#include <gault/tensor.hpp>

struct Elastic {
    static constexpr const char* version = "1.0.0";
    static constexpr const char* doc = "A soil of the tests.";

    double young_modulus, poisson_ratio;
    static constexpr std::array parameters{
        gault::parameter<&Elastic::young_modulus>("young_modulus", "E", "Pa", "Stiffness.")
            .above(0)
            .fallback(100e6),
        gault::parameter<&Elastic::poisson_ratio>("poisson_ratio", "nu", "1", "Ratio.")
            .above(-1)
            .below(0.5)
            .fallback(0.25)};
    double lame, shear; // Pa

    void prepare() {
        shear = young_modulus / (2.0 * (1.0 + poisson_ratio));
        lame = 2.0 * shear * poisson_ratio / (1.0 - 2.0 * poisson_ratio);
    }
    GAULT_INLINE void elastic(gault::Point& p) const {
        p.stress = gault::add_elastic(p.stress_old, p.strain, lame, 2.0 * shear);
        p.modulus = lame + 2.0 * shear;
        p.shear_modulus = shear;
    }
    void update(gault::Point& p) const { elastic(p); }
};

inline gault::Pack norm(const gault::Components& t) {
    gault::Pack square = 0.0;
    for (int i = 0; i < 6; ++i)
        square += (i < 3 ? 1.0 : 2.0) * t[i] * t[i];
    return sqrt(square);
}

// q = strength (slope p + cohesion), with less dilation than friction; back to its tip where the cone ends.
struct Cone : Elastic {
    static constexpr double slope = 1.2, cohesion = 5e3;
    double dilation = 0.3;
    static constexpr bool has_tangent = true;
    using Tangent = std::array<gault::Components, 6>; // of every row, its columns

    // Where it yields.
    gault::Mask flow(gault::Point& p, gault::Pack strength, Tangent* tangent = nullptr) const {
        elastic(p);
        const double bulk = lame + 2.0 / 3.0 * shear;
        const gault::Pack mean = (p.stress[0] + p.stress[1] + p.stress[2]) / 3.0;
        gault::Components s = p.stress;
        for (int i = 0; i < 3; ++i)
            s[i] -= mean;
        const gault::Pack trial = sqrt(1.5) * norm(s), size = max(trial, 1e-300),
                          excess = trial + strength * (slope * mean - cohesion),
                          flowing = 3.0 * shear + strength * (slope * dilation * bulk),
                          growth = excess / flowing;
        const gault::Pack left = trial - 3.0 * shear * growth, top = cohesion / slope;
        const gault::Mask yields = excess > 0.0, tip = yields & (left < 0.0);
        const gault::Pack scale = select(tip, 0.0, select(yields, left / size, 1.0)),
                          now = select(tip, top, select(yields, mean - dilation * bulk * growth, mean));
        for (int i = 0; i < 6; ++i)
            p.stress[i] = scale * s[i] + (i < 3 ? now : gault::Pack(0.0));
        for (int column = 0; tangent && column < 6; ++column) {
            const gault::Pack swells = column < 3 ? 1.0 : 0.0,
                              d_trial = 3.0 * shear * (column < 3 ? 1.0 : 2.0) * s[column] / size,
                              d_mean = bulk * swells,
                              d_growth = (d_trial + strength * slope * d_mean) / flowing,
                              d_scale = (d_trial - 3.0 * shear * d_growth - scale * d_trial) / size;
            for (int row = 0; row < 6; ++row) {
                const double e = (row == column ? 1.0 : 0.0) - (row < 3 && column < 3 ? 1.0 / 3.0 : 0.0);
                const gault::Pack elastic_part = scale * (2.0 * shear * e);
                const gault::Pack plastic =
                    elastic_part + d_scale * s[row] +
                    (row < 3 ? d_mean - dilation * bulk * d_growth : gault::Pack(0.0));
                const gault::Pack whole = elastic_part + (row < 3 ? d_mean : gault::Pack(0.0));
                (*tangent)[row][column] = select(tip, 0.0, select(yields, plastic, whole));
            }
        }
        return yields;
    }
    void update(gault::Point& p) const {
        Tangent tangent;
        flow(p, 1.0, p.wants_tangent() ? &tangent : nullptr);
        if (p.wants_tangent()) set(p, tangent);
    }
    static void set(gault::Point& p, const Tangent& tangent) {
        for (int row = 0; row < 6; ++row)
            for (int column = 0; column < 6; ++column)
                p.set_tangent(row, column, tangent[row][column]);
    }
    static double sqrt(double x) { return std::sqrt(x); }
    static gault::Pack sqrt(gault::Pack x) { return gault::sqrt(x); }
};

// Cauchy stress (mu (b - 1) + lame ln J 1 + F S F^T) / J, S the initial stress.
struct Finite : Elastic {
    static constexpr bool finite_strain = true, has_tangent = true;
    static constexpr std::array states{
        gault::symmetric_state("initial_stress", "Pa", "Of the reference configuration.")};
    using Gradient = std::array<gault::Triple, 3>;

    void start(gault::Point& p) const { p.set_symmetric_state(0, p.stress_old); }
    void update(gault::Point& p) const {
        Gradient f;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                f[i][j] = p.F_new(i, j);
        answer(p, f);
    }

    // lhs m rhs^T of a symmetric m.
    static gault::Components pushed(const Gradient& f, const gault::Components& m) {
        static constexpr int at[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}, row[] = {0, 1, 2, 0, 1, 2},
                             column[] = {0, 1, 2, 1, 2, 0};
        gault::Components out;
        for (int c = 0; c < 6; ++c) {
            out[c] = 0.0;
            for (int k = 0; k < 3; ++k)
                for (int l = 0; l < 3; ++l)
                    out[c] += f[row[c]][k] * m[at[k][l]] * f[column[c]][l];
        }
        return out;
    }
    // e m + m e for a unit of one component of e.
    static gault::Components stretched(int unit, const gault::Components& m) {
        static constexpr int at[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}, row[] = {0, 1, 2, 0, 1, 2},
                             column[] = {0, 1, 2, 1, 2, 0};
        gault::Components out;
        for (int c = 0; c < 6; ++c) {
            out[c] = 0.0;
            for (int k = 0; k < 3; ++k) {
                if (at[row[c]][k] == unit) out[c] += m[at[k][column[c]]];
                if (at[k][column[c]] == unit) out[c] += m[at[row[c]][k]];
            }
        }
        return out;
    }
    void answer(gault::Point& p, const Gradient& f) const {
        const gault::Components one = {1.0, 1.0, 1.0, 0.0, 0.0, 0.0};
        const gault::Pack volume = f[0][0] * (f[1][1] * f[2][2] - f[1][2] * f[2][1]) -
                                   f[0][1] * (f[1][0] * f[2][2] - f[1][2] * f[2][0]) +
                                   f[0][2] * (f[1][0] * f[2][1] - f[1][1] * f[2][0]);
        const gault::Components b = pushed(f, one), t = pushed(f, p.symmetric_state_old(0));
        const gault::Pack growth = log(volume);
        gault::Pack largest = 1.0;
        for (int i = 0; i < 6; ++i) {
            p.stress[i] = (shear * (b[i] - one[i]) + t[i] + lame * growth * one[i]) / volume;
            largest = max(largest, abs(b[i]));
        }
        p.modulus = 1.02 * (lame + 2.0 * shear) * largest / volume;
        p.shear_modulus = shear;
        for (int column = 0; p.wants_tangent() && column < 6; ++column) {
            const double swells = column < 3 ? 1.0 : 0.0;
            const gault::Components d_b = stretched(column, b), d_t = stretched(column, t);
            for (int row = 0; row < 6; ++row)
                p.set_tangent(row, column,
                              (shear * d_b[row] + d_t[row] + lame * swells * one[row]) / volume -
                                  swells * p.stress[row]);
        }
    }
};

using Update = gault_status (*)(const void*, gault_points*, gault_error*) noexcept;
template <class T>
constexpr gault_material_api answered_by(Update update) {
    gault_material_api a = gault::detail::material_api<T>();
    a.update = update;
    return a;
}

// A soil whose answers T::spoil spoils afterwards, and whose status it chooses.
template <class T>
struct Spoilt {
    static gault_status update(const void* self, gault_points* points, gault_error* error) noexcept {
        const gault_status status = gault::detail::update<T>(self, points, error);
        return status == GAULT_OK ? T::spoil(*points) : status;
    }
    static constexpr gault_material_api api = answered_by<T>(&update);
    static constexpr gault_component declaration = gault::detail::component<T>(GAULT_MATERIAL, &api);
};
