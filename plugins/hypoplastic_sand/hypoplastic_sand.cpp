// Sand that remembers its last strains: see README.md for equations and signs.
#include "integration.hpp"

using gault::Components;
using gault::Mask;
using gault::Pack;
namespace model = hypoplastic_sand;

struct HypoplasticSand {
    static constexpr const char *name = "hypoplastic_sand", *version = "1.0.0";
    static constexpr const char* doc =
        "Sand whose stiffness and strength follow from pressure and density; hypoplastic, with "
        "intergranular strain.";
    static constexpr const char* reference =
        "von Wolffersdorff (1996), Mech. Cohes.-Frict. Mater. 1, 251-271; Niemunis and Herle (1997), ibid. "
        "2, 279-299";

    double friction_angle, granular_hardness, exponent, e_d0, e_c0, e_i0, alpha, beta;
    double initial_void_ratio, minimum_pressure;
    std::optional<double> intergranular_radius, m_r, m_t, beta_r, chi;

    using Self = HypoplasticSand;
    static constexpr std::array parameters{
        gault::parameter<&Self::friction_angle>("friction_angle", "phi_c", "rad", "In the critical state.")
            .above(0)
            .below(gault::pi / 3.0),
        gault::parameter<&Self::granular_hardness>("granular_hardness", "h_s", "Pa",
                                                   "Pressure that scales compression of the skeleton.")
            .above(0),
        gault::parameter<&Self::exponent>("exponent", "n", "1", "Of the compression law.").above(0).below(1),
        gault::parameter<&Self::e_d0>("e_d0", "e_d0", "1", "Void ratio, densest, at no pressure.").above(0),
        gault::parameter<&Self::e_c0>("e_c0", "e_c0", "1", "Void ratio, critical, at no pressure.").above(0),
        gault::parameter<&Self::e_i0>("e_i0", "e_i0", "1", "Void ratio, loosest, at no pressure.").above(0),
        gault::parameter<&Self::alpha>("alpha", "alpha", "1", "Exponent of density in peak strength.")
            .above(0)
            .at_most(1),
        gault::parameter<&Self::beta>("beta", "beta", "1", "Exponent of density in stiffness.").at_least(0),
        gault::parameter<&Self::initial_void_ratio>("initial_void_ratio", "e_0", "1",
                                                    "Void ratio at the start.")
            .above(0),
        gault::parameter<&Self::minimum_pressure>(
            "minimum_pressure", "p_t", "Pa",
            "Added to the pressure in the law: keeps stiffness at no stress.")
            .above(0)
            .fallback(100),
        gault::parameter<&Self::intergranular_radius>(
            "intergranular_radius", "R", "1",
            "Largest intergranular strain; absent with the next four: none.")
            .above(0)
            .at_most(0.01),
        gault::parameter<&Self::m_r>("m_r", "m_R", "1", "Stiffness after a reversal, over that of loading.")
            .at_least(1),
        gault::parameter<&Self::m_t>("m_t", "m_T", "1", "Stiffness after a turn by 90 deg, over the same.")
            .at_least(1),
        gault::parameter<&Self::beta_r>("beta_r", "beta_r", "1", "Exponent: how fast the memory fades.")
            .above(0),
        gault::parameter<&Self::chi>("chi", "chi", "1", "Exponent: how fast the stiffness falls.").above(0)};

    static constexpr std::array states{
        gault::scalar_state("void_ratio", "1", "Volume of pores over that of grains.", 0.5, 0.0),
        gault::symmetric_state("intergranular_strain", "1", "Memory of the last strains, tensor shear.", 0.0,
                               -0.01, 0.01),
        gault::scalar_state("mobilised_friction_angle", "rad", "After Matsuoka and Nakai.", 0.0, 0.0,
                            0.5 * gault::pi)};
    static constexpr int void_ratio = gault::state_index(states, "void_ratio");
    static constexpr int intergranular_strain = gault::state_index(states, "intergranular_strain");
    static constexpr int mobilised = gault::state_index(states, "mobilised_friction_angle");

    model::Constants k;

    void prepare() {
        if (e_c0 <= e_d0) throw gault::Invalid("e_c0", "has to be above e_d0");
        if (e_i0 <= e_c0) throw gault::Invalid("e_i0", "has to be above e_c0");
        const double s = std::sin(friction_angle), a = std::sqrt(3.0 / 8.0) * (3.0 - s) / s;
        const double most_f_d = (3.0 + a * a) / (std::sqrt(3.0) * a);
        const double looseness = (e_i0 - e_d0) / (e_c0 - e_d0);
        const double stiff = 3.0 + a * a - std::sqrt(3.0) * a * std::pow(looseness, alpha);
        if (stiff <= 0.0) throw gault::Invalid("alpha", "is so large that the loosest sand has no stiffness");
        const double barotropy = granular_hardness / exponent * std::pow(e_i0 / e_c0, beta) / stiff;
        prepare_memory();
        k = {granular_hardness,
             exponent,
             e_d0,
             e_c0,
             e_i0,
             alpha,
             beta,
             minimum_pressure,
             a,
             barotropy,
             most_f_d,
             intergranular_radius.has_value(),
             intergranular_radius.value_or(1.0),
             m_r.value_or(1.0),
             m_t.value_or(1.0),
             beta_r.value_or(1.0),
             chi.value_or(1.0)};
    }
    void prepare_memory() const {
        const bool given = intergranular_radius.has_value();
        const char* names[] = {"m_r", "m_t", "beta_r", "chi"};
        int i = 0;
        for (const auto* value : {&m_r, &m_t, &beta_r, &chi}) {
            if (!given && value->has_value())
                throw gault::Invalid(names[i], "needs intergranular_radius beside it");
            if (given && !value->has_value())
                throw gault::Invalid("intergranular_radius", std::string("needs ") + names[i] + " beside it");
            ++i;
        }
        if (given && *m_t > *m_r) throw gault::Invalid("m_t", "is above m_r");
    }

    void start(gault::Point& p) const {
        const Pack e = initial_void_ratio, mean = model::trace(p.stress_old) / 3.0;
        p.fail(!(mean <= 0.0), "the initial mean stress is tensile");
        const Components nearest = model::admissible(k, p.stress_old);
        Mask moved = mean > 0.0;
        for (int i = 0; i < 6; ++i)
            moved = moved | !(nearest[i] == p.stress_old[i]);
        p.fail(moved, "an initial stress is tensile, or all but lacks lateral pressure");
        const model::Bounds b = model::bounds(k, k.shift - mean);
        p.fail(e < b.densest, "the initial void ratio is less than the densest at the initial stress");
        p.fail(e > b.loosest, "the initial void ratio is more than the loosest at the initial stress");
        const model::Law at = model::law(k, nearest, e);
        p.fail(at.overstress(k) > 1.0, "the initial stress is beyond the strength at the void ratio");
        p.set_state(void_ratio, e);
        p.set_symmetric_state(intergranular_strain, Components{0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
        p.set_state(mobilised, mobilised_angle(at));
    }

    void update(gault::Point& p) const {
        model::State y{model::admissible(k, p.stress_old),
                       model::within_radius(k, p.symmetric_state_old(intergranular_strain))};
        model::Increment increment{p.strain, model::trace(p.strain), p.state_old(void_ratio)};
        const Pack size = model::norm(p.strain), load = model::norm(y.stress) + model::norm(y.memory);
        const Mask number = (size < gault::infinity) & (load < gault::infinity);
        p.fail(!number, "strain or stress is not a number");
        const Mask large = size > largest_strain;
        p.retry(number & large, 0.1);

        const Pack e = increment.void_ratio_at(1.0);
        p.fail(number & !large & !(e > 0.0), "the pores are closed");
        const Mask goes = number & !large & (e > 0.0);
        model::Law at = model::law(k, y.stress, increment.void_ratio);
        const Pack bound = at.stiffness_bound(k);
        p.retry(model::integrate(k, increment, goes, y, at), 0.25);

        p.stress = y.stress;
        p.set_state(void_ratio, select(goes, e, increment.void_ratio));
        p.set_symmetric_state(intergranular_strain, y.memory);
        p.set_state(mobilised, mobilised_angle(at));
        p.modulus = max(bound, at.stiffness_bound(k));
        p.shear_modulus = 0.5 * at.linear * model::linear_factor(k, y.memory);
    }

  private:
    static constexpr double largest_strain = 0.2; // of an update, as a norm

    static Pack mobilised_angle(const model::Law& at) {
        const Pack t = at.tan_psi;
        return gault::map([](double s) { return std::asin(s); },
                          min(1.0, 3.0 * t / (t + std::sqrt(8.0) * at.f)));
    }
};

GAULT_MODULE("hypoplastic_sand", "1.0.0", "The Gault authors", "MIT", gault::Material<HypoplasticSand>)
