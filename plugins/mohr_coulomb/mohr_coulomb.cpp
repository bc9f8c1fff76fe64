// Mohr-Coulomb with a tension cut-off and softening: see README.md for equations and signs.
#include "tangent.hpp"

#include <gault/material.hpp>

#include <string>

namespace mohr_coulomb {
inline namespace GAULT_ISA {
namespace {

constexpr std::array states{gault::scalar_state(
    "plastic_strain", "1", "Accumulated equivalent plastic strain, sum of sqrt(2/3 dep:dep).", 0.0, 0.0)};
constexpr int plastic_strain = gault::state_index(states, "plastic_strain");

struct Updated {
    gault::SymmetricTensor stress; // Pa
    Pack plastic_strain;           // increment
    Pack snap_back;                // see Softened
    Mask mobilised;
};

GAULT_INLINE Pack snap_back(const Returned&) {
    return 0.0;
}
GAULT_INLINE Pack snap_back(const Softened& r) {
    return r.snap_back;
}

// Trial stresses without yz and zx. Principal directions are not needed: see InPlaneSpectral.
template <class Strength>
GAULT_INLINE Updated update_in_plane(const Strength& k, const gault::SymmetricTensor& trial) {
    const gault::InPlaneSpectral p = gault::in_plane_spectral(trial);
    const Pack zz = trial[2];
    const Pack s1 = max(p.high, zz), s2 = max(p.low, min(p.high, zz)), s3 = min(p.low, zz);
    const Mask plastic = yields(k, s1, s3), mobilised = is_mobilised(k, s1, s3);
    if (!any(plastic)) return {trial, 0.0, 0.0, mobilised};

    const Pack inverse = 1.0 / max(p.radius, std::numeric_limits<double>::min());
    const auto r = return_to_surface(k, s1, s2, s3);
    const Mask zz_first = zz >= p.high, zz_last = zz <= p.low;
    const Pack high = select(zz_first, r.s2, r.s1);
    const Pack low = select(zz_last, r.s2, r.s3);
    const Pack mean = 0.5 * (high + low), scale = 0.5 * (high - low) * inverse;
    const Pack half = p.half_difference * scale;
    const Pack between = select(zz_first, r.s1, select(zz_last, r.s3, r.s2));
    return {{select(plastic, mean + half, trial[0]), select(plastic, mean - half, trial[1]),
             select(plastic, between, zz), select(plastic, trial[3] * scale, trial[3]), trial[4], trial[5]},
            r.plastic_strain,
            snap_back(r),
            mobilised};
}

template <class Strength>
__attribute__((noinline)) Updated update_in_space(const Strength& k, const gault::SymmetricTensor& trial) {
    const gault::Spectral s = gault::spectral(trial);
    const auto& [a, b, c] = s.value;
    const Pack s1 = max(max(a, b), c), s3 = min(min(a, b), c), s2 = max(min(a, b), min(max(a, b), c));
    const Mask plastic = yields(k, s1, s3), mobilised = is_mobilised(k, s1, s3);
    if (!any(plastic)) return {trial, 0.0, 0.0, mobilised};

    const auto r = return_to_surface(k, s1, s2, s3);
    gault::Triple value;
    for (int i = 0; i < 3; ++i)
        value[i] = select(s.value[i] == s1, r.s1, select(s.value[i] == s3, r.s3, r.s2));
    const gault::SymmetricTensor stress = gault::compose(value, s.vector);
    Updated u;
    for (int i = 0; i < 6; ++i)
        u.stress[i] = select(plastic, stress[i], trial[i]);
    u.plastic_strain = r.plastic_strain;
    u.snap_back = snap_back(r);
    u.mobilised = mobilised;
    return u;
}

GAULT_INLINE Mask oblique(const gault::SymmetricTensor& t) {
    return !((t[4] == 0.0) & (t[5] == 0.0));
}

// Lane by lane the one or the other, so that no lane's result depends on its neighbours.
template <class Strength>
GAULT_INLINE Updated update_stress(const Strength& k, const gault::SymmetricTensor& trial) {
    Updated u = update_in_plane(k, trial);
    const Mask turned = oblique(trial);
    if (any(turned)) {
        const Strength constants = k; // copies: whatever a call may see cannot stay in registers
        const gault::SymmetricTensor given = trial;
        const Updated v = update_in_space(constants, given);
        for (int i = 0; i < 6; ++i)
            u.stress[i] = select(turned, v.stress[i], u.stress[i]);
        u.plastic_strain = select(turned, v.plastic_strain, u.plastic_strain);
        u.snap_back = select(turned, v.snap_back, u.snap_back);
        u.mobilised = (turned & v.mobilised) | (!turned & u.mobilised);
    }
    return u;
}

template <class Strength>
__attribute__((noinline)) Tangent tangent_in_space(const Strength& k, double lame, double twice_shear,
                                                   const gault::SymmetricTensor& trial) {
    return tangent(k, lame, twice_shear, trial);
}

template <class Strength>
GAULT_INLINE void finish(const Updated& u, const Strength& k, double lame, double twice_shear,
                         double yielding_modulus, const gault::SymmetricTensor& trial, gault::Point& p) {
    p.stress = u.stress;
    p.set_state(plastic_strain, p.state_old(plastic_strain) + u.plastic_strain);
    p.modulus = select(u.mobilised, Pack(yielding_modulus), lame + twice_shear);
    p.shear_modulus = 0.5 * twice_shear;
    if (!p.wants_tangent()) return;
    const Strength constants = k;
    const gault::SymmetricTensor given = trial;
    const Tangent t = tangent_in_space(constants, lame, twice_shear, given);
    for (int row = 0; row < 6; ++row)
        for (int column = 0; column < 6; ++column)
            p.set_tangent(row, column, t[row][column]);
}

__attribute__((noinline)) void update_softening(const Softening& soil, double yielding_modulus, gault::Point& p) {
    const SofteningSurface k = softening_surface(soil, p.state_old(plastic_strain), p.input(0));
    const double lame = k.start.lame, twice_shear = k.start.twice_shear;
    const gault::SymmetricTensor trial = gault::add_elastic(p.stress_old, p.strain, lame, twice_shear);
    const Updated u = update_stress(k, trial);
    p.retry(u.snap_back == 1.0, 0.5);
    p.fail(u.snap_back == 2.0,
           "the soil snaps back: its strength falls faster with strain than stress can; take "
           "smaller cells (and a regularisation_length), or a longer softening_strain");
    finish(u, k, lame, twice_shear, yielding_modulus, trial, p);
}

} // namespace

struct Model {
    static constexpr const char* name = "mohr_coulomb";
    static constexpr const char* version = "1.0.0";
    static constexpr const char* doc =
        "Mohr-Coulomb with non-associated flow, a tension cut-off and, if wanted, "
        "softening; Tresca at friction angle 0.";
    static constexpr const char* reference =
        "Clausen, J., Damkilde, L. and Andersen, L. (2006), Int. J. Numer. Meth. Engng 66, 1036-1059";

    double young_modulus, poisson_ratio, cohesion, friction_angle, dilation_angle = 0.0;
    std::optional<double> tension_strength, ultimate_cohesion, ultimate_friction_angle,
        ultimate_dilation_angle, softening_strain, regularisation_length;
    PerfectSurface perfect; // of the peak
    Softening softening;
    bool softens;
    double yielding_modulus; // Pa; the largest of all strengths that softening passes

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
            .at_least(0),
        gault::parameter<&Model::ultimate_cohesion>("ultimate_cohesion", "c_ult", "Pa",
                                                    "Cohesion after softening; absent: it stays.")
            .at_least(0),
        gault::parameter<&Model::ultimate_friction_angle>("ultimate_friction_angle", "phi_ult", "rad",
                                                          "Friction angle after softening; absent: it stays.")
            .at_least(0)
            .below(0.5 * gault::pi),
        gault::parameter<&Model::ultimate_dilation_angle>("ultimate_dilation_angle", "psi_ult", "rad",
                                                          "Dilation angle after softening; absent: it stays.")
            .above(-0.5 * gault::pi)
            .below(0.5 * gault::pi),
        gault::parameter<&Model::softening_strain>(
            "softening_strain", "kappa_s", "1",
            "Plastic strain, as the state plastic_strain counts it, from peak to ultimate.")
            .above(0),
        gault::parameter<&Model::regularisation_length>("regularisation_length", "l", "m",
                                                        "Length of cells in which softening_strain holds; "
                                                        "elsewhere it is scaled with this over the cell's. "
                                                        "Absent: it holds in all.")
            .above(0)};
    static constexpr auto& states = mohr_coulomb::states;
    static constexpr std::array inputs{"characteristic_length"};
    static constexpr bool has_tangent = true;

    void prepare() {
        if (cohesion == 0.0 && friction_angle == 0.0)
            throw gault::Invalid("cohesion",
                                 "cohesion and friction_angle are both 0: the soil has no strength; one "
                                 "of them must be positive");
        const Soil soil{young_modulus,  poisson_ratio,  cohesion,
                        friction_angle, dilation_angle, tension_strength.value_or(gault::infinity)};
        check_dilation(soil, "dilation_angle");
        perfect.surface = surface(soil);
        perfect.jacobians = jacobians(perfect.surface);
        yielding_modulus = mohr_coulomb::yielding_modulus(perfect.surface, perfect.jacobians);
        softens = ultimate_cohesion || ultimate_friction_angle || ultimate_dilation_angle;
        if (softens || softening_strain || regularisation_length) prepare_softening(soil);
    }

    GAULT_INLINE void update(gault::Point& p) const {
        if (softens) { // with copies: whatever a call may see cannot stay in registers
            const Softening constants = softening;
            gault::Point point = p;
            update_softening(constants, yielding_modulus, point);
            p = point;
            return;
        }
        const double lame = perfect.surface.lame, twice_shear = perfect.surface.twice_shear;
        const gault::SymmetricTensor trial = gault::add_elastic(p.stress_old, p.strain, lame, twice_shear);
        finish(update_stress(perfect, trial), perfect, lame, twice_shear, yielding_modulus, trial, p);
    }

    // The initial stress must lie within the surface, up to what rounding and a person's digits leave.
    void start(gault::Point& p) const {
        const gault::Spectral s = gault::spectral(p.stress_old);
        const auto& [a, b, c] = s.value;
        const Pack s1 = max(max(a, b), c), s3 = min(min(a, b), c);
        const Pack slack = 1e-9 * (1.0 + max(gault::abs(s1), gault::abs(s3)));
        p.fail(s1 - perfect.surface.kappa * s3 - perfect.surface.y > slack,
               "the initial stress exceeds the Mohr-Coulomb strength: raise cohesion or friction_angle, or "
               "choose a less deviatoric initial stress");
        p.fail(s1 > Pack(perfect.surface.tension) + slack, "the initial stress exceeds tension_strength");
    }

  private:
    static void check_dilation(const Soil& soil, const char* parameter) {
        const double least = least_dilation(soil), degrees = 180.0 / gault::pi;
        if (soil.dilation_angle > least) return;
        char text[200];
        std::snprintf(text, sizeof text,
                      "%s is %.6g deg; with poisson_ratio %g and friction_angle %.6g deg it must be above "
                      "%.6g deg, or the stress has no unique solution",
                      parameter, soil.dilation_angle * degrees, soil.poisson_ratio,
                      soil.friction_angle * degrees, least * degrees);
        throw gault::Invalid(parameter, text);
    }

    void prepare_softening(const Soil& peak) {
        if (!softens)
            throw gault::Invalid(softening_strain ? "softening_strain" : "regularisation_length",
                                 "there is no ultimate_cohesion, ultimate_friction_angle or "
                                 "ultimate_dilation_angle for the soil to soften to");
        if (!softening_strain)
            throw gault::Invalid("softening_strain", "a soil with ultimate values needs a softening_strain");
        const double c = ultimate_cohesion.value_or(cohesion),
                     phi = ultimate_friction_angle.value_or(friction_angle),
                     psi = ultimate_dilation_angle.value_or(dilation_angle);
        if (c > cohesion) throw gault::Invalid("ultimate_cohesion", "it is above cohesion");
        if (phi > friction_angle)
            throw gault::Invalid("ultimate_friction_angle", "it is above friction_angle");
        if (c == 0.0 && phi == 0.0)
            throw gault::Invalid(
                ultimate_cohesion ? "ultimate_cohesion" : "ultimate_friction_angle",
                "ultimate cohesion and friction angle are both 0: nothing is left of the soil");
        constexpr int parts = 64;
        for (int i = 1; i <= parts; ++i) {
            const double share = double(i) / parts;
            Soil soil = peak;
            soil.friction_angle += share * (phi - friction_angle);
            soil.dilation_angle += share * (psi - dilation_angle);
            check_dilation(soil, "ultimate_dilation_angle");
            const Surface softer = surface(soil);
            yielding_modulus =
                std::fmax(yielding_modulus, mohr_coulomb::yielding_modulus(softer, jacobians(softer)));
        }
        const auto angle = [](double from, double to) {
            return Softening::Angle{std::sin(from), std::cos(from), to - from};
        };
        softening = {young_modulus,
                     poisson_ratio,
                     angle(friction_angle, phi),
                     angle(dilation_angle, psi),
                     cohesion,
                     c - cohesion,
                     peak.tension_strength,
                     *softening_strain,
                     regularisation_length.value_or(0.0)};
    }
};

} // namespace GAULT_ISA
} // namespace mohr_coulomb

GAULT_MODULE("mohr_coulomb", "1.0.0", "The Gault authors", "MIT", gault::Material<mohr_coulomb::Model>)
