// NorSand: see README.md for equations and signs.
#include "integration.hpp"

#include <gault/material.hpp>

namespace norsand {
inline namespace GAULT_ISA {

struct Model {
    static constexpr const char *name = "norsand", *version = "1.0.0";
    static constexpr const char* doc =
        "Sand and silt, loose to dense, by one set of parameters: critical state "
        "soil mechanics with the state parameter.";
    static constexpr const char* reference =
        "Jefferies, M. G. (1993), Geotechnique 43, 91-103; Jefferies, M. and Been, K. (2016), Soil "
        "Liquefaction, 2nd ed., CRC Press";

    double critical_state_void_ratio, critical_state_slope, critical_state_ratio, volumetric_coupling;
    double dilatancy_coefficient, hardening_modulus, hardening_slope;
    double shear_modulus, shear_exponent, reference_pressure, poisson_ratio, overconsolidation_ratio;
    std::optional<double> void_ratio, state_parameter;
    bool undrained_softening, internal_cap;
    Sand sand;

    static constexpr std::array parameters{
        gault::parameter<&Model::critical_state_void_ratio>("critical_state_void_ratio", "Gamma", "1",
                                                            "Void ratio at the critical state at p' = 1 kPa.")
            .above(0)
            .at_most(10),
        gault::parameter<&Model::critical_state_slope>(
            "critical_state_slope", "lambda_e", "1",
            "Fall of the critical void ratio with ln p', natural logarithm: lambda_10/2.303.")
            .above(0)
            .at_most(1),
        gault::parameter<&Model::critical_state_ratio>("critical_state_ratio", "M_tc", "1",
                                                       "q/p' at the critical state in triaxial compression.")
            .at_least(0.2)
            .at_most(2),
        gault::parameter<&Model::volumetric_coupling>("volumetric_coupling", "N", "1",
                                                      "How much dilatancy lowers the image stress ratio.")
            .at_least(0)
            .at_most(0.5),
        gault::parameter<&Model::dilatancy_coefficient>(
            "dilatancy_coefficient", "chi_tc", "1",
            "Limiting dilatancy over state parameter, triaxial compression.")
            .at_least(0.5)
            .at_most(20),
        gault::parameter<&Model::hardening_modulus>("hardening_modulus", "H_0", "1",
                                                    "Plastic hardening at psi = 0.")
            .at_least(1)
            .at_most(1e4),
        gault::parameter<&Model::hardening_slope>(
            "hardening_slope", "H_psi", "1", "Fall of hardening with psi: H = H_0 - H_psi psi, 1 at least.")
            .at_least(0)
            .at_most(1e5)
            .fallback(0),
        gault::parameter<&Model::shear_modulus>("shear_modulus", "G_ref", "Pa",
                                                "Elastic, at the reference pressure.")
            .above(0),
        gault::parameter<&Model::shear_exponent>("shear_exponent", "n", "1", "G = G_ref (p'/p_ref)^n.")
            .at_least(0)
            .at_most(1)
            .fallback(0.5),
        gault::parameter<&Model::reference_pressure>("reference_pressure", "p_ref", "Pa", "Where G is G_ref.")
            .above(0)
            .fallback(100e3),
        gault::parameter<&Model::poisson_ratio>("poisson_ratio", "nu", "1", "Elastic.")
            .above(-1)
            .below(0.5)
            .fallback(0.2),
        gault::parameter<&Model::void_ratio>("void_ratio", "e_0", "1",
                                             "At the start, everywhere; give this or state_parameter.")
            .above(0)
            .at_most(10)
            .optional(),
        gault::parameter<&Model::state_parameter>(
            "state_parameter", "psi_0", "1",
            "Void ratio less that of the critical state, at the initial pressure; give this or void_ratio.")
            .at_least(-1)
            .at_most(1)
            .optional(),
        gault::parameter<&Model::overconsolidation_ratio>(
            "overconsolidation_ratio", "R", "1",
            "Image pressure over that of the surface through the initial stress, up to its limit p_mx.")
            .at_least(1)
            .fallback(1),
        gault::parameter<&Model::undrained_softening>("undrained_softening", "S", "1",
                                                      "The image pressure falls as undrained shear takes p' "
                                                      "from loose sand; only where volume is held.")
            .fallback(0),
        gault::parameter<&Model::internal_cap>("internal_cap", "", "1",
                                               "The image pressure follows p' down as the sand is unloaded.")
            .fallback(0)};

    static constexpr std::array states{
        gault::scalar_state("void_ratio", "1", "Volume of pores over that of grains.", 0.7, 0.0),
        gault::scalar_state("image_pressure", "Pa", "p_i: where the yield surface crosses M_i.", 36.0, 36.0),
        gault::scalar_state(
            "plastic_strain", "1",
            "Accumulated plastic shear strain eps_q; of compression at the tip, its volume over M_i.", 0.0,
            0.0),
        gault::scalar_state("state_parameter", "1", "psi, within -1 and 1 for plots.", 0.0, -1.0, 1.0)};
    static constexpr int void_ratio_state = gault::state_index(states, "void_ratio");
    static constexpr int image_pressure = gault::state_index(states, "image_pressure");
    static constexpr int plastic_strain = gault::state_index(states, "plastic_strain");
    static constexpr int psi_state = gault::state_index(states, "state_parameter");

    void prepare() {
        if (void_ratio && state_parameter)
            throw gault::Invalid("state_parameter",
                                 "void_ratio and state_parameter are both given; leave out one");
        if (!void_ratio && !state_parameter)
            throw gault::Invalid("void_ratio", "void_ratio or state_parameter must be given");
        const double share = critical_state_slope * dilatancy_coefficient / critical_state_ratio;
        if (share > 0.4)
            throw gault::Invalid(
                "dilatancy_coefficient",
                "chi_tc lambda_e/M_tc must be 0.4 at most: the image state would run away from "
                "the state of the sand");
        const double g = 1.5 * (1.0 - 2.0 * poisson_ratio) / (1.0 + poisson_ratio); // G / K
        if (12.0 * g <= critical_state_ratio * critical_state_ratio)
            throw gault::Invalid(
                "poisson_ratio",
                "is so large that K M_tc^2 reaches 12 G: loose sand would lose pressure faster "
                "than it yields, and the stress has no unique solution");
        sand = {critical_state_void_ratio,
                critical_state_slope,
                critical_state_ratio,
                volumetric_coupling,
                dilatancy_coefficient / (1.0 - share),
                hardening_modulus,
                hardening_slope,
                shear_modulus / g,
                reference_pressure,
                shear_exponent,
                g,
                undrained_softening ? 1.0 - share : 0.0,
                internal_cap};
    }

    void start(gault::Point& p) const {
        const Pack pressure = -trace(p.stress_old) / 3.0, at = max(pressure, least_pressure);
        p.fail(!(pressure >= least_pressure),
               "the initial mean effective stress must be a compression of 100 Pa or more");
        const Pack critical = critical_state_void_ratio - critical_state_slope * log(at / unit_pressure);
        const Pack e = void_ratio ? Pack(*void_ratio) : critical + *state_parameter;
        p.fail(!(e > 0.0),
               "the state parameter leaves no pores at the initial stress: the critical void ratio "
               "there is too small");
        const Pack psi = e - critical;
        const SymmetricTensor s = deviator(p.stress_old);
        const Pack scaled = deviator_size(s) / (friction(sand, s, at) * at);
        p.fail(scaled > strength(sand, psi) * (1.0 + 1e-9),
               "the initial stress is beyond the strength of the sand at its void ratio");
        const Pack through = log_ratio_through(sand, min(scaled, strength(sand, psi)), psi);
        const Pack limit = largest_log_ratio(sand, psi) - std::log(1.25);
        const Pack loose_limit =
            image_at(sand, psi / (1.0 + sand.lambda * sand.dilatancy / sand.ratio)).limit;
        const Pack most = select(psi > 0.0, loose_limit, limit);
        const Pack x = max(through, min(through + std::log(overconsolidation_ratio), most));
        p.set_state(void_ratio_state, e);
        p.set_state(image_pressure, at * exp(x));
        p.set_state(psi_state, max(-1.0, min(1.0, psi)));
    }

    void update(gault::Point& p) const {
        const Pack e_old = p.state_old(void_ratio_state), volumetric = -trace(p.strain);
        State state{max(-trace(p.stress_old) / 3.0, least_pressure), deviator(p.stress_old),
                    p.state_old(image_pressure), p.state_old(plastic_strain), Mask{}};
        const Increment increment{volumetric, deviator(p.strain)};
        const Pack shear = sqrt(inner(increment.deviator, increment.deviator));
        const Pack amount = abs(volumetric) + shear;
        const Mask number = (amount < gault::infinity) & (deviator_size(state.deviator) < gault::infinity) &
                            (state.pressure < gault::infinity);
        p.fail(!number, "strain or stress is not a number");
        const Mask large = number & (amount > largest_strain);
        p.retry(large, 0.1);
        const Pack e = void_ratio_at(e_old, volumetric, 1.0);
        const Mask closed = number & !large & !(e > 0.0);
        p.fail(closed, "the pores are closed");
        const Mask goes = number & !large & !closed;
        const Pack stiff = stiffness(state.pressure, shear);
        p.retry(integrate(sand, state, increment, e_old, goes), 0.25);

        for (int i = 0; i < 6; ++i)
            p.stress[i] = state.deviator[i] - (i < 3 ? state.pressure : Pack(0.0));
        p.set_state(void_ratio_state, select(goes, e, e_old));
        p.set_state(image_pressure, max(state.image, 36.0));
        p.set_state(plastic_strain, state.plastic_strain);
        const Pack psi = norsand::state_parameter(sand, state.pressure, select(goes, e, e_old));
        p.set_state(psi_state, max(-1.0, min(1.0, psi)));
        p.modulus = max(stiff, stiffness(state.pressure, shear));
        p.shear_modulus = sand.shear_per_bulk * bulk_modulus(sand, state.pressure);
    }

  private:
    static constexpr double largest_strain = 0.2; // of an update

    // Of the P wave; G grows with pressure, so a wave that compresses adds to what shear strain there is.
    Pack stiffness(Pack pressure, Pack shear) const {
        const Pack k = bulk_modulus(sand, pressure);
        return k * (1.0 + sand.shear_per_bulk * (4.0 / 3.0 + 4.0 * sand.power * shear * k / pressure));
    }
};

} // namespace GAULT_ISA
} // namespace norsand

GAULT_MODULE("norsand", "1.0.0", "The Gault authors", "MIT", gault::Material<norsand::Model>)
