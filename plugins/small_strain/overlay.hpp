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
    double carried;           // most stress that the slipping elements carry there, Pa
};

// The modified hyperbola x/(1 + x), x = a gamma/gamma_07, up to where its slope is `least`, and then straight on, as a
// polyline whose error alternates between +ripple and -ripple of the value: every corner is at the one, every segment
// touches the other. The first slope is 1 and the last one `least`, exactly. Corners are the yield strains of elements.
struct Polyline {
    double corner[elements], slope[elements + 1];
};

// How the polyline of this ripple goes; false: it needs more corners than there are elements.
inline bool ripples(double ripple, double least, Polyline& line) {
    const double ratio = (1.0 + ripple) / (1.0 - ripple);
    double x = ripple;
    line.slope[0] = 1.0;
    for (int i = 0; i < elements; ++i) {
        line.corner[i] = x;
        const double c = ratio * x / (1.0 + x), root = c * c - (1.0 - c) * (x - c);
        if (c >= 1.0 || root < 0.0) return true;
        const double z = (c + std::sqrt(root)) / (1.0 - c); // touches there
        line.slope[i + 1] = (1.0 - ripple) / ((1.0 + z) * (1.0 + z));
        if (line.slope[i + 1] <= least) return true;
        const double b = 0.5 * (ratio * (1.0 + z) * (1.0 + z) - 1.0 - z * z);
        x = b + std::sqrt(std::fmax(b * b - z * z, 0.0));
    }
    return false;
}

inline void discretise(Backbone& k, double unit_strain, double least) {
    Polyline line{};
    double enough = 0.5, short_of = 0.0;
    for (int halving = 0; halving < 100; ++halving) { // the least ripple with which all corners suffice
        const double ripple = 0.5 * (enough + short_of);
        (ripples(ripple, least, line) ? enough : short_of) = ripple;
    }
    ripples(short_of, least, line);
    line.slope[elements] = least;
    for (int i = 0; i < elements; ++i) {
        k.yield[i] = line.corner[i] * unit_strain / std::sqrt(2.0);
        k.weight[i] = line.slope[i] - line.slope[i + 1];
    }
    k.spring = least;
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
