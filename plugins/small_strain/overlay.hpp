// The soil within its strength: elements side by side that share one strain (Iwan 1967). Each is a spring that slips when
// its elastic shear strain reaches a yield strain of its own; one never slips. Together they follow the modified hyperbola
// down to the unload-reload modulus, and Masing's rules.
#pragma once
#include "linear.hpp"

namespace small_strain {

constexpr int elements = 10;

struct Backbone {             // what follows from the parameters
    double yield[elements];   // r_i, of the norm of the elastic deviatoric strain
    double weight[elements];  // w_i, share of G_0
    double spring;            // w_inf = G_ur/G_0, of the spring that never slips
    double bulk, twice_shear; // K and 2 G_0 at the reference pressure, Pa
};

// Tangents to x/(1 + x), x = a gamma/gamma_07, at points that are equidistant in atan(sqrt x): the polyline that they
// form is above the curve by the square of that distance at every one of its corners, which are the yield strains. Yield
// strains less by half of that share it between both sides; the first and the last slope stay exact.
inline void discretise(Backbone& k, double unit_strain, double end) {
    const double step = std::atan(std::sqrt(end)) / elements;
    const auto touch = [step](int j) { return std::pow(std::tan(step * j), 2); };
    const auto slope = [&touch](int j) { return 1.0 / ((1.0 + touch(j)) * (1.0 + touch(j))); };
    for (int i = 0; i < elements; ++i) {
        const double a = touch(i), b = touch(i + 1), corner = (a + b + 2.0 * a * b) / (2.0 + a + b);
        k.yield[i] = corner * (1.0 - 0.5 * step * step) * unit_strain / std::sqrt(2.0);
        k.weight[i] = slope(i) - slope(i + 1);
    }
    k.spring = slope(elements);
}

inline namespace GAULT_ISA {

using Elements = std::array<SymmetricTensor, elements>; // elastic strains over their yield strains

struct Overlay { // at the start of the step
    Elements element;
    SymmetricTensor stress; // Pa
    Pack stiffness;         // lambda: moduli over those at the reference pressure; stays during the step
};

struct Response { // after a strain
    SymmetricTensor stress;
    Elements element;
    std::array<Pack, elements>
        kept; // 1: sticks; less: the part of its trial strain that a slipping element keeps
};

// Stress in, stress out: what the elements carry changes with their strains, the last spring with the whole.
inline Response respond(const Backbone& k, const Overlay& old, const SymmetricTensor& strain) {
    Response r;
    const SymmetricTensor shear = deviator(strain);
    SymmetricTensor sum;
    for (int c = 0; c < 6; ++c)
        sum[c] = k.spring * shear[c];
    for (int i = 0; i < elements; ++i) {
        const double inverse = 1.0 / k.yield[i], size = k.weight[i] * k.yield[i];
        SymmetricTensor& e = r.element[i];
        for (int c = 0; c < 6; ++c)
            e[c] = old.element[i][c] + inverse * shear[c];
        r.kept[i] = 1.0 / gault::max(norm(e), 1.0);
        for (int c = 0; c < 6; ++c) {
            e[c] *= r.kept[i];
            sum[c] += size * (e[c] - old.element[i][c]);
        }
    }
    const Pack twice_shear = k.twice_shear * old.stiffness, mean = k.bulk * old.stiffness * trace(strain);
    for (int c = 0; c < 6; ++c)
        r.stress[c] = old.stress[c] + (twice_shear * sum[c] + (c < 3 ? mean : Pack(0.0)));
    return r;
}

inline Response select_response(Mask where, const Response& yes, const Response& no) {
    Response r;
    r.stress = select_lanes(where, yes.stress, no.stress);
    for (int i = 0; i < elements; ++i) {
        r.element[i] = select_lanes(where, yes.element[i], no.element[i]);
        r.kept[i] = select(where, yes.kept[i], no.kept[i]);
    }
    return r;
}

// Share of the small-strain stiffness that slipping has taken.
inline Pack lost(const Backbone& k, const Response& r) {
    Pack share = 0.0;
    for (int i = 0; i < elements; ++i)
        share += select(r.kept[i] < 1.0, k.weight[i], 0.0);
    return share;
}

// d stress / d strain of respond(); symmetric but for the double weight of shear columns.
inline Matrix tangent(const Backbone& k, const Response& r, Pack stiffness) {
    Pack share = k.spring;
    for (int i = 0; i < elements; ++i)
        share += k.weight[i] * r.kept[i];
    const Pack shear = k.twice_shear * stiffness, diagonal = shear * share;
    const Pack direct = k.bulk * stiffness - diagonal / 3.0;
    Matrix t;
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            t[i][j] = (i < 3 && j < 3 ? direct : Pack(0.0)) + (i == j ? diagonal : Pack(0.0));
    for (int e = 0; e < elements; ++e) {
        const Pack slip = select(r.kept[e] < 1.0, shear * (k.weight[e] * r.kept[e]), 0.0);
        if (!gault::any(slip > 0.0)) continue;
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j)
                t[i][j] -= (multiplicity[j] * slip) * (r.element[e][i] * r.element[e][j]);
    }
    return t;
}

} // namespace GAULT_ISA
} // namespace small_strain
