#include <gault/material.hpp>
#include <gault/tensor.hpp>

using gault::Pack;

struct DruckerPrager { // f = sqrt(J2) + eta p - k, p the mean stress, tension positive
    static constexpr const char *name = "drucker_prager", *version = "1.0.0";
    static constexpr const char* doc = "Elastic, perfectly plastic cone with a flow rule of its own.";

    double young_modulus, poisson_ratio, cohesion, friction_angle, dilation_angle;
    using Self = DruckerPrager;
    static constexpr std::array parameters{
        gault::parameter<&Self::young_modulus>("young_modulus", "E", "Pa", "Stiffness.").above(0),
        gault::parameter<&Self::poisson_ratio>("poisson_ratio", "nu", "1", "Ratio.").above(-1).below(0.5),
        gault::parameter<&Self::cohesion>("cohesion", "c", "Pa", "Cohesion.").at_least(0),
        gault::parameter<&Self::friction_angle>("friction_angle", "phi", "rad", "Of strength.")
            .above(0)
            .below(0.5 * gault::pi),
        gault::parameter<&Self::dilation_angle>("dilation_angle", "psi", "rad", "Of flow.")
            .at_least(0)
            .below(0.5 * gault::pi)};
    static constexpr std::array states{
        gault::scalar_state("plastic_strain", "1", "Deviatoric, accumulated.", 0, 0)};

    double shear, bulk, eta, flow, k, elastic_modulus, yielding_modulus;
    static double slope(double angle) { return 6 * std::sin(angle) / (std::sqrt(3) * (3 - std::sin(angle))); }
    void prepare() { // the cone through the compression edges of Mohr-Coulomb
        shear = young_modulus / (2 * (1 + poisson_ratio));
        bulk = young_modulus / (3 * (1 - 2 * poisson_ratio));
        eta = slope(friction_angle);
        flow = slope(dilation_angle);
        k = eta * cohesion / std::tan(friction_angle);
        elastic_modulus = bulk + 4 * shear / 3;
        // The largest d s_i / d e_i of all deviators: above the elastic one where flow is not associated.
        const double s_i = std::max(-2 / std::sqrt(3), -bulk * (eta + flow) / (2 * shear)); // over tau
        const double lost =
            (shear * s_i + bulk * flow) * (shear * s_i + bulk * eta) / (shear + bulk * eta * flow);
        yielding_modulus = elastic_modulus - std::min(lost, 0.0);
    }

    void start(gault::Point& p) const {
        const auto& s = p.stress_old;
        const Pack mean = (s[0] + s[1] + s[2]) / 3, x = s[0] - mean, y = s[1] - mean, z = s[2] - mean;
        const Pack tau = sqrt(0.5 * (x * x + y * y + z * z) + s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
        p.fail(tau + eta * mean - k > 1e-9 * (1 + gault::abs(mean)), // a person's digits
               "the initial stress exceeds the Drucker-Prager strength");
    }

    void update(gault::Point& p) const {
        auto s = gault::add_elastic(p.stress_old, p.strain, bulk - 2 * shear / 3, 2 * shear);
        const Pack mean = (s[0] + s[1] + s[2]) / 3;
        for (int i = 0; i < 3; ++i)
            s[i] -= mean;
        const Pack j2 =
            0.5 * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) + s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
        const Pack tau = sqrt(j2);

        const Pack multiplier = max(0, (tau + eta * mean - k) / (shear + bulk * eta * flow));
        const auto apex = shear * multiplier > tau;
        const Pack new_tau = select(apex, 0, tau - shear * multiplier);
        const Pack new_mean = select(apex, k / eta, mean - bulk * flow * multiplier);

        for (int i = 0; i < 6; ++i)
            p.stress[i] = new_tau / max(tau, 1e-300) * s[i] + (i < 3 ? new_mean : 0);
        p.set_state(0, p.state_old(0) + (tau - new_tau) / (std::sqrt(3) * shear));
        p.modulus = select(tau + 0.75 * (eta * mean - k) > 0, Pack(yielding_modulus), elastic_modulus);
        p.shear_modulus = shear;
    }
};
GAULT_MODULE("drucker_prager", "1.0.0", "The Gault authors", "MIT", gault::Material<DruckerPrager>)
