#include <gault/material.hpp>
#include <gault/tensor.hpp>

// Isotropic Hooke's law in rate form, tension positive: d stress = lame tr(d strain) 1 + 2 G d strain.
struct LinearElastic {
    static constexpr const char* name = "linear_elastic";
    static constexpr const char* version = "1.0.0";
    static constexpr const char* doc = "Isotropic linear elasticity.";
    static constexpr const char* reference =
        "Timoshenko, S. P. and Goodier, J. N. (1970), Theory of Elasticity";

    double young_modulus, poisson_ratio;
    double lame, shear; // Pa

    static constexpr std::array parameters{
        gault::parameter<&LinearElastic::young_modulus>("young_modulus", "E", "Pa", "Young's modulus.")
            .above(0),
        gault::parameter<&LinearElastic::poisson_ratio>("poisson_ratio", "nu", "1", "Poisson's ratio.")
            .above(-1)
            .below(0.5)};
    static constexpr bool has_tangent = true;

    void prepare() {
        shear = young_modulus / (2.0 * (1.0 + poisson_ratio));
        lame = 2.0 * shear * poisson_ratio / (1.0 - 2.0 * poisson_ratio);
    }

    void update(gault::Point& p) const {
        p.stress = gault::add_elastic(p.stress_old, p.strain, lame, 2.0 * shear);
        p.modulus = lame + 2.0 * shear;
        p.shear_modulus = shear;
        if (p.wants_tangent()) p.set_elastic_tangent(lame, shear);
    }
};

GAULT_MODULE("linear_elastic", "1.0.0", "The Gault authors", "MIT", gault::Material<LinearElastic>)
