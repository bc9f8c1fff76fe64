// Soils of a third party: a material that breaks the rules it is told to break, and one that shares its name
// with a program.
#include <gault/material.hpp>

template <bool is_namesake>
struct Soil {
    static constexpr const char* name = is_namesake ? "ramp" : "test_soil";
    static constexpr const char* version = "3.2.1";
    static constexpr const char* doc = "Linear elasticity that can be told to misbehave.";

    double young_modulus, poisson_ratio, said_share;
    std::optional<double> breaks_after, strength;
    double lame, shear; // Pa

    static constexpr std::array parameters{
        gault::parameter<&Soil::young_modulus>("young_modulus", "E", "Pa", "Young's modulus.").above(0),
        gault::parameter<&Soil::poisson_ratio>("poisson_ratio", "nu", "1", "Poisson's ratio.")
            .above(-1)
            .below(0.5),
        gault::parameter<&Soil::said_share>("said_share", "", "1",
                                            "The share of its stiffness that it tells the host.")
            .above(0)
            .fallback(1),
        gault::parameter<&Soil::breaks_after>("breaks_after", "", "s", "When it gives no result any more.")
            .at_least(0),
        gault::parameter<&Soil::strength>("strength", "", "Pa", "Below Young's modulus; otherwise unused.")
            .above(0)};

    void prepare() {
        shear = young_modulus / (2.0 * (1.0 + poisson_ratio));
        lame = 2.0 * shear * poisson_ratio / (1.0 - 2.0 * poisson_ratio);
        if (strength && *strength > young_modulus) throw gault::Invalid("strength", "is above young_modulus");
    }

    void update(gault::Point& p) const {
        const gault::Pack volumetric = lame * (p.strain[0] + p.strain[1] + p.strain[2]);
        for (int i = 0; i < 6; ++i)
            p.stress[i] =
                p.stress_old[i] + (i < 3 ? volumetric : gault::Pack(0.0)) + 2.0 * shear * p.strain[i];
        p.modulus = said_share * (lame + 2.0 * shear);
        p.shear_modulus = said_share * shear;
        if (breaks_after && p.time() > *breaks_after) p.fail(p.modulus > 0.0, "the soil broke");
    }
};

GAULT_MODULE("test_soils", "3.2.1", "A third party", "MIT", gault::Material<Soil<false>>,
             gault::Material<Soil<true>>)
