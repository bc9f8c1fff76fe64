#include <gault/material.hpp>
#include <gault/tensor.hpp>

#include <cmath>
#include <optional>

using gault::Mask;
using gault::Pack;

// Sand whose strength and dilation follow its density and pressure. In this file p, q and volumetric strain are positive
// in compression; the contract's tensors are positive in tension. README.md has the equations and their sources.
struct NorSand {
    static constexpr const char *name = "norsand", *version = "1.0.0";
    static constexpr const char* doc =
        "Critical-state sand: NorSand, for loose and dense sand by one set of parameters.";
    static constexpr const char* reference = "Jefferies, M. and Shuttle, D. (2011), in Alarcon-Guzman et "
                                             "al., Geotechnical Engineering 42; Jefferies, M. and "
                                             "Been, K. (2016), Soil liquefaction, 2nd ed.";

    double shear_modulus, reference_pressure, stiffness_exponent, poisson_ratio;
    double critical_state_ratio, critical_state_volume, critical_state_slope;
    double volumetric_coupling, dilatancy, hardening, hardening_slope, overconsolidation_ratio;
    std::optional<double> void_ratio, state_parameter;
    using Self = NorSand;
    static constexpr std::array parameters{
        gault::parameter<&Self::shear_modulus>("shear_modulus", "G_ref", "Pa",
                                               "Elastic, at the reference pressure.")
            .above(0),
        gault::parameter<&Self::reference_pressure>("reference_pressure", "p_ref", "Pa",
                                                    "Of the shear modulus.")
            .above(0)
            .fallback(100e3),
        gault::parameter<&Self::stiffness_exponent>("stiffness_exponent", "n", "1",
                                                    "Of mean stress in the elastic stiffness.")
            .at_least(0)
            .at_most(0.95)
            .fallback(0.5),
        gault::parameter<&Self::poisson_ratio>("poisson_ratio", "nu", "1", "Elastic.")
            .above(-1)
            .below(0.5)
            .fallback(0.2),
        gault::parameter<&Self::critical_state_ratio>("critical_state_ratio", "M_tc", "1",
                                                      "q/p at critical state in triaxial compression.")
            .above(0)
            .below(3),
        gault::parameter<&Self::critical_state_volume>(
            "critical_state_volume", "Gamma", "1", "Void ratio at critical state at a mean stress of 1 kPa.")
            .above(0)
            .at_most(5),
        gault::parameter<&Self::critical_state_slope>("critical_state_slope", "lambda", "1",
                                                      "Of the critical state line, void ratio over ln p.")
            .above(0)
            .at_most(0.5),
        gault::parameter<&Self::volumetric_coupling>(
            "volumetric_coupling", "N", "1",
            "How the stress ratio at image state falls with the state parameter.")
            .at_least(0)
            .below(1)
            .fallback(0.3),
        gault::parameter<&Self::dilatancy>("dilatancy", "chi_tc", "1",
                                           "Least dilatancy over state parameter in triaxial compression.")
            .at_least(1)
            .at_most(10)
            .fallback(3.5),
        gault::parameter<&Self::hardening>("hardening", "H_0", "1",
                                           "Plastic hardening modulus at state parameter 0.")
            .above(0),
        gault::parameter<&Self::hardening_slope>("hardening_slope", "H_psi", "1",
                                                 "Fall of the hardening modulus with the state parameter.")
            .at_least(0)
            .fallback(0),
        gault::parameter<&Self::overconsolidation_ratio>(
            "overconsolidation_ratio", "R", "1", "Of the image pressure over that of yield at the start.")
            .at_least(1)
            .at_most(100)
            .fallback(1),
        gault::parameter<&Self::void_ratio>("void_ratio", "e", "1", "At the start; or state_parameter.")
            .above(0)
            .at_most(5),
        gault::parameter<&Self::state_parameter>(
            "state_parameter", "psi", "1",
            "Void ratio over that of critical state at the start; or void_ratio.")
            .at_least(-0.5)
            .at_most(0.5)};

    static constexpr std::array states{
        gault::scalar_state("void_ratio", "1", "Volume of voids over that of grains.", 1, 0),
        gault::scalar_state("image_pressure", "Pa",
                            "Mean stress of the image state: size of the yield surface.", 1, 0),
        gault::scalar_state("plastic_shear_strain", "1", "Accumulated, conjugate to q.", 0, 0)};
    static constexpr int voids = 0, image = 1, shear_strain = 2;

    double chi, bulk_ratio, slope_at_tc; // chi_i; K/G; M_tc^2 / (3 + M_tc)
    void prepare() {
        if (void_ratio.has_value() == state_parameter.has_value())
            throw gault::Invalid(void_ratio ? "state_parameter" : "void_ratio",
                                 "give either void_ratio or state_parameter, and not both");
        if (critical_state_slope * dilatancy > 0.9 * critical_state_ratio)
            throw gault::Invalid("dilatancy",
                                 "times critical_state_slope must be below 0.9 critical_state_ratio");
        chi = dilatancy / (1 - critical_state_slope * dilatancy / critical_state_ratio);
        bulk_ratio = 2 * (1 + poisson_ratio) / (3 * (1 - 2 * poisson_ratio));
        slope_at_tc = critical_state_ratio * critical_state_ratio / (3 + critical_state_ratio);
    }

    void start(gault::Point& p) const {
        const Invariants now = invariants(p.stress_old);
        p.fail(now.p < least_pressure, "NorSand needs compression: the initial mean stress is below 100 Pa");
        const Pack pressure = max(now.p, least_pressure), m = ratio_at(now.lode);
        const Pack critical = critical_state_volume - critical_state_slope * log(pressure * 1e-3);
        const Pack e = void_ratio ? Pack(*void_ratio) : critical + *state_parameter;
        Pack y = log(pressure); // ln of the image pressure: q = M_i p (1 + ln(p_i / p)) through the stress
        for (int turn = 0; turn < 60; ++turn)
            y = log(pressure) + now.q / (pressure * image_ratio(m, e, y).value) - 1;
        p.fail(e < least_voids, "the void ratio at the initial stress is below 0.05");
        p.fail(e - critical > 0.5, "the sand is looser than any: the state parameter exceeds 0.5");
        p.set_state(voids, max(e, 0));
        p.set_state(image, overconsolidation_ratio * exp(y));
    }

    void update(gault::Point& p) const {
        const Pack swelling = p.strain[0] + p.strain[1] + p.strain[2];
        const Invariants old = invariants(p.stress_old);
        const Step s = step(p, max(old.p, least_pressure), -swelling);
        const Pack strength = image_ratio(s.m, s.e, s.y).value * exp(s.x) * max(1 + s.y - s.x, 0);
        const Mask elastic = s.q <= strength, trial = elastic | s.at_floor;
        const Solution yields = solve(s);
        p.retry(!(trial | yields.found), 0.25);

        const Pack x = select(trial, s.x, yields.x), y = select(trial, s.y, yields.y);
        const Pack pressure = exp(x);
        const Pack q = select(trial, min(s.q, strength), max(s.q - 3 * s.shear * yields.gamma, 0));
        const Pack factor = q / max(s.q, 1e-9);
        for (int i = 0; i < 6; ++i)
            p.stress[i] = factor * s.deviator[i] - (i < 3 ? pressure : 0);
        p.set_state(voids, max(s.e, 0));
        p.set_state(image, select(trial, p.state_old(image), exp(y)));
        p.set_state(shear_strain, p.state_old(shear_strain) + (s.q - q) / (3 * s.shear));
        p.fail(s.e < least_voids, "the void ratio fell below 0.05");

        p.shear_modulus = shear_at(pressure);
        const Pack stiff = shear_at(max(max(pressure, exp(s.x)), max(old.p, least_pressure)));
        Pack turned = 0; // the largest strain: shear stiffness follows the pressure within a long step
        for (int i = 0; i < 6; ++i)
            turned = max(turned, abs(p.strain[i] - (i < 3 ? swelling / 3 : 0)));
        p.modulus =
            stiff * (bulk_ratio + 4.0 / 3.0 +
                     4 * stiffness_exponent * bulk_ratio * turned * stiff / max(old.p, least_pressure));
    }

  private:
    static constexpr double least_pressure = 100, least_voids = 0.05; // Pa, 1
    static constexpr int most_iterations = 40;

    struct Invariants {
        Pack p, q, lode; // lode: sin 3 theta, 1 in triaxial compression
        gault::Components s;
    };
    static Invariants invariants(gault::Components t) {
        Invariants out;
        const Pack mean = (t[0] + t[1] + t[2]) / 3;
        for (int i = 0; i < 3; ++i)
            t[i] -= mean;
        const Pack direct = t[0] * t[0] + t[1] * t[1] + t[2] * t[2];
        out.q = sqrt(1.5 * direct + 3.0 * (t[3] * t[3] + t[4] * t[4] + t[5] * t[5]));
        const Pack determinant = t[0] * (t[1] * t[2] - t[4] * t[4]) - t[3] * (t[3] * t[2] - t[4] * t[5]) +
                                 t[5] * (t[3] * t[4] - t[1] * t[5]);
        const Pack cubed = max(out.q * out.q * out.q, 1e-30);
        out.lode = max(-1, min(1, -13.5 * determinant / cubed));
        out.p = -mean;
        out.s = t;
        return out;
    }

    // M(theta) = M_tc - M_tc^2 / (3 + M_tc) cos(3 theta / 2 + pi / 4), whose corner at triaxial compression is rounded: by
    // it, M rises by less than 0.4 % near the corner and stays at both ends.
    Pack ratio_at(Pack lode) const {
        constexpr double corner = 0.02, top = 1.0001999800039990 - corner; // sqrt(1 + corner^2) - corner
        return critical_state_ratio - slope_at_tc * (sqrt(0.5 * (1 - lode) + corner * corner) - corner) / top;
    }
    Pack shear_at(Pack pressure) const {
        return shear_modulus * power(pressure / reference_pressure, stiffness_exponent);
    }
    static Pack power(Pack base, double exponent) { return exponent == 0 ? Pack(1) : pow(base, exponent); }

    // M_i = M (1 - N chi_i |psi_i| / M_tc), psi_i = e - Gamma + lambda ln p_i, with its slope over ln p_i.
    struct ImageRatio {
        Pack psi, value, slope, scale; // scale: M_i / M
    };
    ImageRatio image_ratio(Pack m, Pack e, Pack y) const {
        ImageRatio r;
        r.psi = e - critical_state_volume + critical_state_slope * (y - std::log(1e3));
        const double coupling = volumetric_coupling * chi / critical_state_ratio;
        const Pack scale = 1 - coupling * abs(r.psi);
        const Mask least = scale < 0.2;
        r.scale = select(least, 0.2, scale);
        r.value = m * r.scale;
        r.slope = select(least, 0, select(r.psi < 0, m * coupling, -m * coupling) * critical_state_slope);
        return r;
    }

    // The elastic trial: x = ln p, y = ln p_i.
    struct Step {
        Pack x, y, q, shear, compression, start, e, m;
        Mask at_floor;
        gault::Components deviator;
    };
    // p^(1-n), which is linear in elastic volumetric strain.
    Pack stretched(Pack pressure) const { return power(pressure, 1 - stiffness_exponent); }
    double compliance() const { // d stretched / d strain
        return (1 - stiffness_exponent) * bulk_ratio * shear_modulus /
               std::pow(reference_pressure, stiffness_exponent);
    }
    Step step(gault::Point& p, Pack old, Pack compression) const {
        const Pack trial = stretched(old) + compliance() * compression;
        const double floor = std::pow(least_pressure, 1 - stiffness_exponent);
        const Pack reached = power(max(trial, floor), 1 / (1 - stiffness_exponent));
        const Pack shear = shear_at(0.5 * (old + reached));
        gault::Components stress = p.stress_old;
        for (int i = 0; i < 6; ++i)
            stress[i] += 2 * shear * (p.strain[i] + (i < 3 ? compression / 3 : 0));
        const Invariants there = invariants(stress);
        Step out;
        out.x = log(reached);
        out.y = log(p.state_old(image));
        out.q = there.q;
        out.shear = shear;
        out.compression = compression;
        out.start = stretched(old);
        out.e = (1 + p.state_old(voids)) * exp(-compression) - 1;
        out.m = ratio_at(there.lode);
        out.at_floor = trial <= floor;
        out.deviator = there.s;
        return out;
    }

    // Backward Euler: with q = q_trial - 3 G gamma (none below 0: the tip of the surface), D = M_i - q/p,
    //   elastic strain(p) = compression - D gamma
    //   ln p_i = its old value + H (M / M_tc) (p/p_i)^2 [exp(-chi_i psi_i / M_i,tc) - p_i/p] gamma
    //   q / (M_i p) = 1 + ln(p_i / p)
    // by Newton's method on ln p, ln p_i and gamma. A lane that is done stays as it is.
    struct Solution {
        Pack x, y, gamma;
        Mask found;
    };
    Solution solve(const Step& s) const {
        Solution z{s.x, s.y, 0, s.q < 0};
        for (int iteration = 0; iteration < most_iterations; ++iteration) {
            const System at = system(s, z);
            const Mask open = !z.found,
                       near = (abs(at.r[0]) < 1e-12) & (abs(at.r[1]) < 1e-9) & (abs(at.r[2]) < 1e-9);
            const gault::Triple d = at.correction(); // of a lane that is near, the last: it squares the error
            const double far = 0.5;                  // of one correction, in ln p and ln p_i
            z.x = select(open, max(z.x + max(-far, min(far, d[0])), std::log(least_pressure)), z.x);
            z.y = select(open, z.y + max(-far, min(far, d[1])), z.y);
            z.gamma = select(open, max(z.gamma + d[2], 0), z.gamma);
            z.found = z.found | near;
            if (all(z.found | s.at_floor)) break;
        }
        return z;
    }

    struct System { // residuals, and their slopes over x, y, gamma
        gault::Triple r;
        std::array<gault::Triple, 3> j;
        gault::Triple correction() const { // by Cramer's rule
            const auto minor = [](const gault::Triple& a, const gault::Triple& b, const gault::Triple& c) {
                return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                       a[2] * (b[0] * c[1] - b[1] * c[0]);
            };
            gault::Triple column[3];
            for (int k = 0; k < 3; ++k)
                column[k] = {j[0][k], j[1][k], j[2][k]};
            const Pack whole = minor(column[0], column[1], column[2]);
            const Pack inverse = -1 / select(abs(whole) < 1e-300, 1e-300, whole);
            return {minor(r, column[1], column[2]) * inverse, minor(column[0], r, column[2]) * inverse,
                    minor(column[0], column[1], r) * inverse};
        }
    };
    System system(const Step& s, const Solution& z) const {
        const Pack pressure = exp(z.x), u = exp(z.y - z.x); // u = p_i / p
        const ImageRatio image_now = image_ratio(s.m, s.e, z.y);
        const Mask tip = s.q - 3 * s.shear * z.gamma <= 0;
        const Pack q = select(tip, 0, s.q - 3 * s.shear * z.gamma), dq = select(tip, 0, -3 * s.shear);
        const Pack eta = q / pressure, slope_gamma = dq / pressure;
        const Pack at_tc = critical_state_ratio * image_now.scale,
                   tc_slope = image_now.slope * at_tc / image_now.value;
        const Pack h0 =
            max(hardening - hardening_slope * image_now.psi, 0.1 * hardening) * s.m / critical_state_ratio;
        const Pack limit = exp(max(-20, min(20, -chi * image_now.psi / at_tc)));
        const Pack limit_slope =
            -limit * chi * (critical_state_slope / at_tc - image_now.psi * tc_slope / (at_tc * at_tc));
        const Pack h = h0 * (limit - u) / (u * u), h_x = h0 * (2 * limit - u) / (u * u);
        const Pack h_y = h0 * limit_slope / (u * u) - h_x;

        System out;
        out.r[0] = (stretched(pressure) - s.start) / compliance() - s.compression +
                   (image_now.value - eta) * z.gamma;
        out.j[0] = {(1 - stiffness_exponent) * stretched(pressure) / compliance() + eta * z.gamma,
                    image_now.slope * z.gamma, image_now.value - eta - slope_gamma * z.gamma};
        out.r[1] = z.y - s.y - h * z.gamma;
        out.j[1] = {-h_x * z.gamma, 1 - h_y * z.gamma, -h};
        out.r[2] = eta / image_now.value - 1 - (z.y - z.x);
        out.j[2] = {1 - eta / image_now.value,
                    -eta * image_now.slope / (image_now.value * image_now.value) - 1,
                    slope_gamma / image_now.value};
        return out;
    }
};
GAULT_MODULE("norsand", "1.0.0", "The Gault authors", "MIT", gault::Material<NorSand>)
