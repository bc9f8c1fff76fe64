// Mohr-Coulomb with a tension cut-off: see README.md for equations and signs.
#include "tangent.hpp"

#include <gault/material.hpp>

#include <string>

namespace mohr_coulomb {
inline namespace GAULT_ISA {
namespace {

struct Updated {
    gault::SymmetricTensor stress; // Pa
    Pack plastic_strain;           // increment
};

// Trial stresses without yz and zx. Principal directions are not needed: see InPlaneSpectral.
GAULT_INLINE Updated update_in_plane(const Surface& k, const gault::SymmetricTensor& trial) {
    const gault::InPlaneSpectral p = gault::in_plane_spectral(trial);
    const Pack zz = trial[2];
    const Pack s1 = max(p.high, zz), s2 = max(p.low, min(p.high, zz)), s3 = min(p.low, zz);
    const Mask plastic = yields(k, s1, s3);
    if (!any(plastic)) return {trial, 0.0};

    const Pack inverse = 1.0 / max(p.radius, std::numeric_limits<double>::min());
    const Returned r = return_to_surface(k, s1, s2, s3);
    const Mask zz_first = zz >= p.high, zz_last = zz <= p.low;
    const Pack high = select(zz_first, r.s2, r.s1);
    const Pack low = select(zz_last, r.s2, r.s3);
    const Pack mean = 0.5 * (high + low), scale = 0.5 * (high - low) * inverse;
    const Pack half = p.half_difference * scale;
    const Pack between = select(zz_first, r.s1, select(zz_last, r.s3, r.s2));
    return {{select(plastic, mean + half, trial[0]), select(plastic, mean - half, trial[1]),
             select(plastic, between, zz), select(plastic, trial[3] * scale, trial[3]), trial[4], trial[5]},
            r.plastic_strain};
}

__attribute__((noinline)) Updated update_in_space(const Surface& k, const gault::SymmetricTensor& trial) {
    const gault::Spectral s = gault::spectral(trial);
    const auto& [a, b, c] = s.value;
    const Pack s1 = max(max(a, b), c), s3 = min(min(a, b), c), s2 = max(min(a, b), min(max(a, b), c));
    const Mask plastic = yields(k, s1, s3);
    if (!any(plastic)) return {trial, 0.0};

    const Returned r = return_to_surface(k, s1, s2, s3);
    gault::Triple value;
    for (int i = 0; i < 3; ++i)
        value[i] = select(s.value[i] == s1, r.s1, select(s.value[i] == s3, r.s3, r.s2));
    const gault::SymmetricTensor stress = gault::compose(value, s.vector);
    Updated u;
    for (int i = 0; i < 6; ++i)
        u.stress[i] = select(plastic, stress[i], trial[i]);
    u.plastic_strain = r.plastic_strain;
    return u;
}

GAULT_INLINE Mask oblique(const gault::SymmetricTensor& t) {
    return !((t[4] == 0.0) & (t[5] == 0.0));
}

// Lane by lane the one or the other, so that no lane's result depends on its neighbours.
GAULT_INLINE Updated update_stress(const Surface& k, const gault::SymmetricTensor& trial) {
    Updated u = update_in_plane(k, trial);
    const Mask turned = oblique(trial);
    if (any(turned)) {
        const Surface constants = k; // copies: whatever a call may see cannot stay in registers
        const gault::SymmetricTensor given = trial;
        const Updated v = update_in_space(constants, given);
        for (int i = 0; i < 6; ++i)
            u.stress[i] = select(turned, v.stress[i], u.stress[i]);
        u.plastic_strain = select(turned, v.plastic_strain, u.plastic_strain);
    }
    return u;
}

__attribute__((noinline)) Tangent tangent_in_space(const Surface& k, const gault::SymmetricTensor& trial) {
    return tangent(k, trial);
}

GAULT_INLINE void write_tangent(const Surface& k, const gault::SymmetricTensor& trial, gault::Point& p) {
    const Surface constants = k;
    const gault::SymmetricTensor given = trial;
    const Tangent t = tangent_in_space(constants, given);
    for (int row = 0; row < 6; ++row)
        for (int column = 0; column < 6; ++column)
            p.set_tangent(row, column, t[row][column]);
}

} // namespace

struct Model {
    static constexpr const char* name = "mohr_coulomb";
    static constexpr const char* version = "1.0.0";
    static constexpr const char* doc = "Perfectly plastic Mohr-Coulomb with non-associated flow and a "
                                       "tension cut-off; Tresca at friction angle 0.";
    static constexpr const char* reference =
        "Clausen, J., Damkilde, L. and Andersen, L. (2006), Int. J. Numer. Meth. Engng 66, 1036-1059";

    double young_modulus, poisson_ratio, cohesion, friction_angle, dilation_angle = 0.0;
    std::optional<double> tension_strength;
    Surface surface;

    static constexpr std::array parameters{
        gault::parameter<&Model::young_modulus>("young_modulus", "E", "Pa", "Young's modulus.").above(0),
        gault::parameter<&Model::poisson_ratio>("poisson_ratio", "nu", "1", "Poisson's ratio.")
            .above(-1)
            .below(0.5),
        gault::parameter<&Model::cohesion>("cohesion", "c", "Pa",
                                           "Cohesion; the undrained strength at friction angle 0.")
            .at_least(0),
        gault::parameter<&Model::friction_angle>("friction_angle", "phi", "rad",
                                                 "Friction angle; 0 is Tresca.")
            .at_least(0)
            .below(0.5 * gault::pi),
        gault::parameter<&Model::dilation_angle>("dilation_angle", "psi", "rad",
                                                 "Dilation angle; negative: the soil contracts as it shears.")
            .above(-0.5 * gault::pi)
            .below(0.5 * gault::pi)
            .fallback(0),
        gault::parameter<&Model::tension_strength>(
            "tension_strength", "t", "Pa",
            "Largest tensile principal stress; absent: the surface's own apex, c cot phi.")
            .at_least(0)};
    static constexpr std::array states{gault::scalar_state(
        "plastic_strain", "1", "Accumulated equivalent plastic strain, sum of sqrt(2/3 dep:dep).", 0.0, 0.0)};
    static constexpr int plastic_strain = gault::state_index(states, "plastic_strain");
    static constexpr bool has_tangent = true;

    void prepare() {
        if (cohesion == 0.0 && friction_angle == 0.0)
            throw gault::Invalid("cohesion",
                                 "cohesion and friction_angle are both 0: the soil has no strength; one "
                                 "of them must be positive");
        const Soil soil{young_modulus,  poisson_ratio,  cohesion,
                        friction_angle, dilation_angle, tension_strength.value_or(gault::infinity)};
        const double least = least_dilation(soil);
        if (dilation_angle <= least) {
            char text[200];
            std::snprintf(text, sizeof text,
                          "dilation_angle is %.6g deg; with poisson_ratio %g and friction_angle %.6g deg it "
                          "must be above "
                          "%.6g deg, or the stress has no unique solution",
                          dilation_angle * 180.0 / gault::pi, poisson_ratio,
                          friction_angle * 180.0 / gault::pi, least * 180.0 / gault::pi);
            throw gault::Invalid("dilation_angle", text);
        }
        surface = mohr_coulomb::surface(soil);
    }

    GAULT_INLINE void update(gault::Point& p) const {
        const gault::SymmetricTensor trial =
            gault::add_elastic(p.stress_old, p.strain, surface.lame, surface.twice_shear);
        const Updated u = update_stress(surface, trial);
        p.stress = u.stress;
        p.set_state(plastic_strain, p.state_old(plastic_strain) + u.plastic_strain);
        p.modulus = surface.lame + surface.twice_shear;
        p.shear_modulus = 0.5 * surface.twice_shear;
        if (p.wants_tangent()) write_tangent(surface, trial, p);
    }

    // The initial stress must lie within the surface, up to what rounding and a person's digits leave.
    void start(gault::Point& p) const {
        const gault::Spectral s = gault::spectral(p.stress_old);
        const auto& [a, b, c] = s.value;
        const Pack s1 = max(max(a, b), c), s3 = min(min(a, b), c);
        const Pack slack = 1e-9 * (1.0 + max(gault::abs(s1), gault::abs(s3)));
        p.fail(s1 - surface.kappa * s3 - surface.y > slack,
               "the initial stress exceeds the Mohr-Coulomb strength: raise cohesion or friction_angle, or "
               "choose a "
               "less deviatoric initial stress");
        p.fail(s1 > Pack(surface.tension) + slack, "the initial stress exceeds tension_strength");
    }
};

} // namespace GAULT_ISA
} // namespace mohr_coulomb

GAULT_MODULE("mohr_coulomb", "1.0.0", "The Gault authors", "MIT", gault::Material<mohr_coulomb::Model>)
