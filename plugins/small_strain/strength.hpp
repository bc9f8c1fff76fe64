// Mohr-Coulomb with a flow rule of its own: return of a trial stress along an isotropic stiffness, in closed form
// (Clausen, Damkilde and Andersen 2006). Principal stresses s1 >= s2 >= s3, tension positive:
//
//     F = s1 - kappa s3 - y <= 0      flow (1, 0, -mu)
//
// A return by the length d on the plane changes them by -d (1 + l, l, l - mu), l = (lambda/2G)(1 - mu).
#pragma once
#include "linear.hpp"

#include <gault/component.hpp>

namespace small_strain {

enum Region { inside, plane, compression_edge, extension_edge, apex };
constexpr int regions = 5;

struct Strength {
    double kappa, y, vertex; // 1, Pa, Pa: infinity where there is no apex
    double mu, l;
    double per_f, per_f_compression, per_f_extension; // d per unit of F: plane, s1 = s2, s2 = s3
    double jacobian[regions][9];                      // d s / d trial s, row-major
};

// bulk_ratio: K/2G of the stiffness along which stresses return.
inline Strength strength(double cohesion, double friction, double dilation, double bulk_ratio) {
    const auto root = [](double angle) {
        return angle == 0.0 ? 1.0 : std::tan(0.25 * gault::pi - 0.5 * angle);
    };
    Strength k{};
    k.kappa = root(friction) * root(friction);
    k.y = 2.0 * cohesion * root(friction);
    k.vertex = friction > 0.0 ? cohesion / std::tan(friction) : gault::infinity;
    k.mu = root(dilation) * root(dilation);
    k.l = (bulk_ratio - 1.0 / 3.0) * (1.0 - k.mu);
    const double low = k.l - k.mu, joined = k.l - 0.5 * k.mu, high = k.l + 0.5;
    k.per_f = 1.0 / (1.0 + k.l - k.kappa * low);
    k.per_f_compression = 1.0 / (high - k.kappa * low);
    k.per_f_extension = 1.0 / (1.0 + k.l - k.kappa * joined);
    const double average[regions][9] = {{1, 0, 0, 0, 1, 0, 0, 0, 1},
                                        {1, 0, 0, 0, 1, 0, 0, 0, 1},
                                        {.5, .5, 0, .5, .5, 0, 0, 0, 1},
                                        {1, 0, 0, 0, .5, .5, 0, .5, .5},
                                        {}};
    const double flow[regions][3] = {
        {}, {1 + k.l, k.l, low}, {high, high, low}, {1 + k.l, joined, joined}, {}};
    const double normal[regions][3] = {
        {}, {1, 0, -k.kappa}, {.5, .5, -k.kappa}, {1, -.5 * k.kappa, -.5 * k.kappa}, {}};
    const double per_f[regions] = {0, k.per_f, k.per_f_compression, k.per_f_extension, 0};
    for (int r = 0; r < regions; ++r)
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                k.jacobian[r][3 * i + j] = average[r][3 * i + j] - flow[r][i] * normal[r][j] * per_f[r];
    return k;
}

inline namespace GAULT_ISA {

struct Principal {
    gault::Triple s; // descending
    Pack region;
};

struct Admissible {
    SymmetricTensor stress;
    gault::Spectral trial; // sorted
    Principal returned;
};

GAULT_INLINE Pack excess(const Strength& k, const SymmetricTensor& stress) {
    const gault::Spectral t = gault::spectral(stress);
    const auto& [a, b, c] = t.value;
    return gault::max(gault::max(a, b), c) - k.kappa * gault::min(gault::min(a, b), c) - k.y;
}

// Where the plane return leaves the order s1 >= s2 >= s3, an edge or the apex takes over; both violated means the apex.
inline Principal return_principal(const Strength& k, const gault::Triple& trial) {
    const auto& [t1, t2, t3] = trial;
    const Pack f = gault::max(t1 - k.kappa * t3 - k.y, 0.0), d12 = t1 - t2, d23 = t2 - t3;
    const Mask yields = f > 0.0, compression = k.per_f * f > d12, extension = k.mu * k.per_f * f > d23;
    const double low = k.l - k.mu, joined = k.l - 0.5 * k.mu;

    Pack s2 = t2 - f * (k.per_f * k.l), s3 = t3 - f * (k.per_f * low);
    s3 = select(compression, t3 - (f - 0.5 * d12) * (k.per_f_compression * low), s3);
    s3 = select(extension, (t3 + 0.5 * d23) - (f - 0.5 * k.kappa * d23) * (k.per_f_extension * joined), s3);
    const Mask beyond = (s3 > k.vertex) | (compression & extension & (Pack(k.vertex) < gault::infinity));
    s3 = select(beyond, k.vertex, s3);
    // From the surface, not from the trial state: F = 0 to rounding of the result.
    const Pack s1 = select(beyond, k.vertex, k.kappa * s3 + k.y);
    s2 = select(compression | beyond, s1, select(extension, s3, gault::max(gault::min(s2, s1), s3)));

    Principal r;
    r.s = {select(yields, s1, t1), select(yields, s2, t2), select(yields, s3, t3)};
    const Pack edge = select(compression, double{compression_edge},
                             select(extension, double{extension_edge}, double{plane}));
    r.region = select(yields, select(beyond, double{apex}, edge), double{inside});
    return r;
}

inline Admissible return_stress(const Strength& k, const SymmetricTensor& trial) {
    Admissible a;
    a.trial = gault::spectral(trial);
    gault::sort_descending(a.trial);
    a.returned = return_principal(k, a.trial.value);
    a.stress =
        select_lanes(a.returned.region > double{inside}, gault::compose(a.returned.s, a.trial.vector), trial);
    return a;
}

// d stress / d trial stress, with the turning of the principal directions (de Souza Neto, Peric and Owen 2008,
// appendix A): the shear between two of them shrinks as their difference does.
inline Matrix derivative(const Strength& k, const Admissible& a) {
    std::array<Pack, 9> jacobian;
    jacobian.fill(0.0);
    for (int r = 0; r < regions; ++r)
        for (int e = 0; e < 9; ++e)
            jacobian[e] = select(a.returned.region == double(r), k.jacobian[r][e], jacobian[e]);
    constexpr int row[] = {0, 1, 2, 0, 1, 0},
                  column[] = {0, 1, 2, 1, 2, 2};                          // pairs 01, 12, 02 in both frames
    constexpr int of[] = {0, 1, 2, 0, 1, 2}, with[] = {0, 1, 2, 1, 2, 0}; // and xy, yz, zx of components
    Pack shrunk[3];
    for (int i = 0; i < 3; ++i) {
        const int p = row[i + 3], q = column[i + 3];
        const Pack before = a.trial.value[p] - a.trial.value[q], after = a.returned.s[p] - a.returned.s[q];
        const Pack ratio = after / gault::max(before, std::numeric_limits<double>::min());
        shrunk[i] = select(a.returned.region == double{inside}, 1.0, gault::min(gault::max(ratio, 0.0), 1.0));
    }
    Pack dyad[6][6]; // component j of the symmetric product of two directions; for i < 3 of one with itself
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) {
            const gault::Triple &u = a.trial.vector[row[i]], &v = a.trial.vector[column[i]];
            const Pack one = u[of[j]] * v[with[j]];
            dyad[i][j] = i < 3 ? one : one + u[with[j]] * v[of[j]];
        }
    Matrix m;
    for (int j = 0; j < 6; ++j) {
        Pack change[6];
        for (int i = 0; i < 3; ++i) {
            change[i] = 0.0;
            for (int p = 0; p < 3; ++p)
                change[i] += jacobian[3 * i + p] * (multiplicity[j] * dyad[p][j]);
            change[i + 3] = shrunk[i] * ((j < 3 ? 0.5 : 1.0) * dyad[i + 3][j]);
        }
        for (int c = 0; c < 6; ++c) {
            m[c][j] = 0.0;
            for (int i = 0; i < 6; ++i)
                m[c][j] += change[i] * dyad[i][c];
        }
    }
    return m;
}

} // namespace GAULT_ISA
} // namespace small_strain
