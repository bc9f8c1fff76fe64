#include <gault/boundary.hpp>

#include <cmath>

// The infinite elastic soil outside a cylindrical boundary in plane strain: it answers a widening u with 2G
// u/r, r the radius now, and takes waves away with its impedances (Lysmer and Kuhlemeyer 1969).
struct FarField {
    static constexpr const char* name = "far_field";
    static constexpr const char* version = "1.0.0";
    static constexpr const char* doc =
        "The infinite elastic soil outside a cylinder: a spring, and dashpots for waves.";
    static constexpr const char* reference =
        "Lysmer, J. and Kuhlemeyer, R. L. (1969), J. Eng. Mech. Div. ASCE 95, 859-877";
    static constexpr uint32_t flags = gault::uniform | gault::elastic_behind;

    void load(gault::Facet& facet) const {
        const double r = facet.position(0), start = r - facet.displacement(0),
                     facing = std::abs(facet.normal(0));
        const double spring = 2.0 * facet.shear_modulus() * facing;
        double across = 0.0; // velocity along the normal
        for (int axis = 0; axis < 3; ++axis)
            across += facet.velocity(axis) * facet.normal(axis);
        const double pull = -spring * (r - start) / r * facet.normal(0);
        for (int axis = 0; axis < 3; ++axis) {
            const double along = facet.velocity(axis) - across * facet.normal(axis);
            facet.set_traction(axis, facet.initial_traction(axis) + (axis == 0 ? pull : 0.0) -
                                         facet.p_impedance() * across * facet.normal(axis) -
                                         facet.s_impedance() * along);
        }
        if (facet.wants_slope()) facet.set_slope(0, 0, spring * start / (r * r) * facing);
    }
};

GAULT_MODULE("far_field", "1.0.0", "The Gault authors", "MIT", gault::Boundary<FarField>)
