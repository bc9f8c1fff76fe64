// A Burgers soil, elastic in volume: see README.md for equations and signs.
#include <gault/material.hpp>

using gault::Components;
using gault::Pack;

namespace {

// What is left after x relaxation times, on average over them: (1 - exp(-x)) / x.
double average(double x) {
    return x > 0.0 ? -std::expm1(-x) / x : 1.0;
}

struct Split { // a symmetric tensor: deviator + mean 1
    Components deviator;
    Pack mean;
};

GAULT_INLINE Split split(const Components& t) {
    Split parts{t, (t[0] + t[1] + t[2]) / 3.0};
    for (int i = 0; i < 3; ++i)
        parts.deviator[i] -= parts.mean;
    return parts;
}

} // namespace

struct Viscoelastic {
    static constexpr const char* name = "viscoelastic";
    static constexpr const char* version = "1.0.0";
    static constexpr const char* doc =
        "Burgers soil: elastic at once, delayed, and flowing; elastic in volume.";
    static constexpr const char* reference =
        "Findley, W. N., Lai, J. S. and Onaran, K. (1976), Creep and Relaxation of Nonlinear Viscoelastic "
        "Materials, chapter 5";

    static constexpr bool rate_dependent = true;

    double young_modulus, poisson_ratio;
    std::optional<double> viscosity, delayed_shear_modulus, delayed_viscosity;

    using Self = Viscoelastic;
    static constexpr std::array parameters{
        gault::parameter<&Self::young_modulus>("young_modulus", "E", "Pa", "Young's modulus, instantaneous.")
            .above(0),
        gault::parameter<&Self::poisson_ratio>("poisson_ratio", "nu", "1", "Poisson's ratio, instantaneous.")
            .above(-1)
            .below(0.5),
        gault::parameter<&Self::viscosity>("viscosity", "eta", "Pa s",
                                           "Shear viscosity of the Maxwell element; absent: no flow.")
            .above(0),
        gault::parameter<&Self::delayed_shear_modulus>("delayed_shear_modulus", "G_K", "Pa",
                                                       "Shear modulus of the Kelvin element; absent: none.")
            .above(0),
        gault::parameter<&Self::delayed_viscosity>("delayed_viscosity", "eta_K", "Pa s",
                                                   "Shear viscosity of the Kelvin element; absent: none.")
            .above(0)};
    static constexpr std::array states{gault::symmetric_state(
        "delayed_strain", "1", "Deviatoric strain of the Kelvin element, tensor shear.")};
    static constexpr int delayed_strain = gault::state_index(states, "delayed_strain");
    static constexpr bool has_tangent = true;

    double bulk, shear;                   // Pa
    double growth, recovery;              // of the delayed strain: G / eta_K, G_K / eta_K; 1/s
    double fast, slow, distance;          // relaxation rates and their difference; 1/s
    double fast_share, slow_share, share; // of G in the two rates; growth over their difference

    void prepare() {
        if (delayed_shear_modulus && !delayed_viscosity)
            throw gault::Invalid("delayed_shear_modulus", "needs delayed_viscosity beside it, or neither");
        if (delayed_viscosity && !delayed_shear_modulus)
            throw gault::Invalid("delayed_viscosity", "needs delayed_shear_modulus beside it, or neither");
        bulk = young_modulus / (3.0 * (1.0 - 2.0 * poisson_ratio));
        shear = young_modulus / (2.0 * (1.0 + poisson_ratio));
        growth = delayed_viscosity ? shear / *delayed_viscosity : 0.0;
        recovery = delayed_viscosity ? *delayed_shear_modulus / *delayed_viscosity : 0.0;
        find_rates(viscosity ? shear / *viscosity : 0.0);
    }

    // At a held strain the soil relaxes as two Maxwell elements side by side. No share is a difference of
    // close numbers.
    void find_rates(double flow) {
        const double difference = flow + growth - recovery, product = growth * recovery;
        distance = std::hypot(difference, 2.0 * std::sqrt(product));
        fast = 0.5 * (flow + growth + recovery + distance);
        slow = fast > 0.0 ? flow * recovery / fast : 0.0;
        const double sum = distance * (distance + std::abs(difference));
        const double lesser = sum > 0.0 ? 2.0 * product / sum : 0.0;
        fast_share = difference >= 0.0 ? 1.0 - lesser : lesser;
        slow_share = difference >= 0.0 ? lesser : 1.0 - lesser;
        share = distance > 0.0 ? growth / distance : 0.0;
    }

    // The end of a step from its start, for a constant strain rate: s is the deviatoric stress, k the delayed
    // strain, e the increment of deviatoric strain.
    struct Transition {
        double s_of_s, s_of_k, s_of_e, k_of_s, k_of_k, k_of_e;
    };
    Transition over(double dt) const {
        const double fast_left = std::exp(-fast * dt), slow_left = std::exp(-slow * dt);
        const double fast_average = average(fast * dt), slow_average = average(slow * dt);
        const double exchange = dt * slow_left * average(distance * dt); // (slow_left - fast_left) / distance
        return {fast_share * fast_left + slow_share * slow_left,
                2.0 * shear * recovery * exchange,
                2.0 * shear * (fast_share * fast_average + slow_share * slow_average),
                growth * exchange / (2.0 * shear),
                slow_share * fast_left + fast_share * slow_left,
                share * (slow_average - fast_average)};
    }

    void update(gault::Point& p) const {
        const Transition t = over(p.dt());
        const auto [s, mean] = split(p.stress_old);
        const auto [e, third_of_volume] = split(p.strain);
        const Components k = p.symmetric_state_old(delayed_strain);
        const Pack new_mean = mean + 3.0 * bulk * third_of_volume;
        Components new_k;
        for (int i = 0; i < 6; ++i) {
            const Pack new_s = t.s_of_s * s[i] + t.s_of_k * k[i] + t.s_of_e * e[i];
            p.stress[i] = i < 3 ? new_mean + new_s : new_s;
            new_k[i] = t.k_of_s * s[i] + t.k_of_k * k[i] + t.k_of_e * e[i];
        }
        p.set_symmetric_state(delayed_strain, new_k);
        p.modulus = bulk + 4.0 * shear / 3.0;
        p.shear_modulus = shear;
        if (p.wants_tangent()) p.set_elastic_tangent(bulk - t.s_of_e / 3.0, 0.5 * t.s_of_e);
    }
};

GAULT_MODULE("viscoelastic", "1.0.0", "The Gault authors", "MIT", gault::Material<Viscoelastic>)
