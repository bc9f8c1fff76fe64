// Small-strain stiffness by an overlay of slipping elements, in series with Mohr-Coulomb: see README.md.
#include "series.hpp"

#include <gault/material.hpp>

#include <string>

namespace small_strain {
inline namespace GAULT_ISA {

constexpr gault_state element_state(const char* name) {
    return gault::symmetric_state(
        name, "1", "Elastic strain of an element over its yield strain; norm 1: slips.", 0.0, -1.0, 1.0);
}

struct Model {
    static constexpr const char* name = "small_strain";
    static constexpr const char* version = "1.0.0";
    static constexpr const char* doc =
        "Stiff at small strains and after every reversal, softer as strain grows "
        "(modified hyperbola, Masing's rules); Mohr-Coulomb strength.";
    static constexpr const char* reference =
        "Iwan, W. D. (1967), J. Appl. Mech. 34, 612-617; Benz, T., Vermeer, P. A. "
        "and Schwab, R. (2009), Int. J. Numer. Anal. Meth. Geomech. 33, 25-44";

    double initial_shear_modulus, reference_shear_strain, poisson_ratio = 0.2;
    std::optional<double> unload_reload_shear_modulus;
    double reference_pressure = 1e5, exponent = 0.0, cohesion, friction_angle, dilation_angle = 0.0;
    Backbone backbone;
    Strength failure;
    double attraction; // c cot phi, Pa

    static constexpr std::array parameters{
        gault::parameter<&Model::initial_shear_modulus>(
            "initial_shear_modulus", "G_0", "Pa",
            "Shear modulus at very small strain, at the reference pressure.")
            .above(0),
        gault::parameter<&Model::reference_shear_strain>(
            "reference_shear_strain", "gamma_07", "1",
            "Shear strain gamma at which the secant shear modulus has fallen to 72.2 % of G_0.")
            .above(0),
        gault::parameter<&Model::unload_reload_shear_modulus>(
            "unload_reload_shear_modulus", "G_ur", "Pa",
            "Least tangent shear modulus, at the reference pressure; absent: a third of G_0.")
            .above(0),
        gault::parameter<&Model::poisson_ratio>("poisson_ratio", "nu", "1",
                                                "Poisson's ratio at very small strain.")
            .above(-1)
            .below(0.5)
            .fallback(0.2),
        gault::parameter<&Model::reference_pressure>("reference_pressure", "p_ref", "Pa",
                                                     "Mean stress at which G_0 and G_ur are given.")
            .above(0)
            .fallback(1e5),
        gault::parameter<&Model::exponent>(
            "exponent", "m", "1", "Stiffness grows with mean stress to this power; 0: it is constant.")
            .at_least(0)
            .at_most(0.9)
            .fallback(0),
        gault::parameter<&Model::cohesion>("cohesion", "c", "Pa",
                                           "Cohesion; the undrained strength at friction angle 0.")
            .at_least(0),
        gault::parameter<&Model::friction_angle>("friction_angle", "phi", "rad",
                                                 "Friction angle; 0 is Tresca, without an exponent.")
            .at_least(0)
            .below(0.5 * gault::pi),
        gault::parameter<&Model::dilation_angle>("dilation_angle", "psi", "rad",
                                                 "Dilation angle, at most the friction angle.")
            .at_least(0)
            .below(0.5 * gault::pi)
            .fallback(0)};
    static constexpr std::array states{
        element_state("element_1"),
        element_state("element_2"),
        element_state("element_3"),
        element_state("element_4"),
        element_state("element_5"),
        element_state("element_6"),
        element_state("element_7"),
        element_state("element_8"),
        element_state("element_9"),
        element_state("element_10"),
        gault::scalar_state("stiffness_ratio", "1", "Moduli of now over those at the reference pressure.",
                            1.0, 0.01),
        gault::scalar_state("lost_stiffness", "1", "1 - G/G_0, G the tangent shear modulus of the last step.",
                            0.0, 0.0, 1.0),
        gault::scalar_state("plastic_strain", "1",
                            "Accumulated equivalent plastic strain, sum of sqrt(2/3 dep:dep).", 0.0, 0.0)};
    static constexpr int stiffness_ratio = gault::state_index(states, "stiffness_ratio");
    static constexpr int lost_stiffness = gault::state_index(states, "lost_stiffness");
    static constexpr int plastic_strain = gault::state_index(states, "plastic_strain");
    static_assert(stiffness_ratio == 6 * elements);
    static constexpr bool has_tangent = true;

    void prepare() {
        if (cohesion == 0.0 && friction_angle == 0.0)
            throw gault::Invalid("cohesion",
                                 "cohesion and friction_angle are both 0: the soil has no strength; one "
                                 "of them must be positive");
        if (exponent > 0.0 && friction_angle == 0.0)
            throw gault::Invalid("exponent", "a stiffness that grows with pressure needs a friction_angle");
        if (dilation_angle > friction_angle)
            throw gault::Invalid("dilation_angle",
                                 "is above the friction angle: shearing would create energy");
        const double ratio =
            unload_reload_shear_modulus.value_or(initial_shear_modulus / 3.0) / initial_shear_modulus;
        if (ratio > 0.999 || ratio < 1e-4)
            throw gault::Invalid("unload_reload_shear_modulus",
                                 "must lie between 0.0001 and 0.999 of initial_shear_modulus");
        discretise(backbone, reference_shear_strain / degradation, ratio);
        backbone.twice_shear = 2.0 * initial_shear_modulus;
        backbone.bulk = backbone.twice_shear * (1.0 + poisson_ratio) / (3.0 * (1.0 - 2.0 * poisson_ratio));
        backbone.carried = 0.0;
        for (int i = 0; i < elements; ++i)
            backbone.carried += backbone.twice_shear * backbone.weight[i] * backbone.yield[i];
        attraction = exponent > 0.0 ? cohesion / std::tan(friction_angle) : 0.0;
        failure = strength(cohesion, friction_angle, dilation_angle, backbone.bulk / return_shear(backbone));
    }

    // The initial stress is at rest: no element has been strained.
    void start(gault::Point& p) const {
        p.fail(excess(failure, p.stress_old) > 1e-9 * (1.0 + norm(p.stress_old)),
               "the initial stress exceeds the Mohr-Coulomb strength: raise cohesion or friction_angle, or "
               "choose a less deviatoric initial stress");
        for (int i = 0; i < stiffness_ratio; ++i)
            p.set_state(i, 0.0);
        p.set_state(stiffness_ratio, stiffness_at(p.stress_old));
        p.set_state(lost_stiffness, 0.0);
        p.set_state(plastic_strain, 0.0);
    }

    void update(gault::Point& p) const {
        Pack length = 0.0;
        for (const Pack& e : p.strain)
            length += gault::abs(e);
        p.fail(!(length < gault::infinity), "the strain increment is not finite");

        Overlay old;
        for (int i = 0; i < elements; ++i)
            old.element[i] = p.symmetric_state_old(6 * i);
        old.stress = p.stress_old;
        old.stiffness = p.state_old(stiffness_ratio);
        const Solution s = advance(backbone, failure, old, p.strain, p.wants_tangent());
        p.retry(s.unsolved | ((length < gault::infinity) & !(norm(s.stress) < gault::infinity)), 0.25);

        p.stress = s.stress;
        for (int i = 0; i < elements; ++i)
            p.set_symmetric_state(6 * i, s.overlay.element[i]);
        const Pack stiffness =
            exponent > 0.0 ? select(s.plastic, stiffness_at(s.stress), old.stiffness) : old.stiffness;
        p.set_state(stiffness_ratio, stiffness);
        p.set_state(lost_stiffness, lost(backbone, s.overlay));
        p.set_state(plastic_strain, p.state_old(plastic_strain) + std::sqrt(2.0 / 3.0) * s.plastic_strain);
        p.shear_modulus = 0.5 * backbone.twice_shear * stiffness;
        p.modulus = gault::max(stiffness, old.stiffness) * (backbone.bulk + 2.0 / 3.0 * backbone.twice_shear);
        if (p.wants_tangent())
            for (int row = 0; row < 6; ++row)
                for (int column = 0; column < 6; ++column)
                    p.set_tangent(row, column, s.tangent[row][column]);
    }

  private:
    GAULT_INLINE Pack stiffness_at(const gault::SymmetricTensor& stress) const {
        if (exponent == 0.0) return 1.0;
        const Pack ratio = (attraction - trace(stress) / 3.0) / (reference_pressure + attraction);
        return gault::pow(gault::max(ratio, least_pressure), exponent);
    }
    static constexpr double degradation = 0.385;   // Santos and Correia (2001)
    static constexpr double least_pressure = 0.01; // of the reference pressure: no softer below it
};

} // namespace GAULT_ISA
} // namespace small_strain

GAULT_MODULE("small_strain", "1.0.0", "The Gault authors", "MIT", gault::Material<small_strain::Model>)
