#include <gault/boundary.hpp>

// Springs behind the surface (Winkler 1867): along its normal it is pushed back by the stiffness times how far it
// has moved out of the soil, and pulled where it has moved in, on top of what balances the initial stress.
struct NewBoundary {
    static constexpr const char* name = "new_boundary";
    static constexpr const char* version = "1.0.0"; // in every result: raise it when a number changes
    static constexpr const char* doc = "Springs behind the surface, along its normal.";
    static constexpr const char* reference =
        "Winkler, E. (1867), Die Lehre von der Elasticitaet und Festigkeit";
    static constexpr uint32_t flags = gault::uniform; // the same anywhere along the axis of a cylinder

    double stiffness;
    static constexpr std::array parameters{
        gault::parameter<&NewBoundary::stiffness>("stiffness", "k", "Pa/m", "Of the springs.").at_least(0)};

    // At one quadrature point of the surface. The answer depends on the facet alone.
    void load(gault::Facet& facet) const {
        double outwards = 0; // m
        for (int axis = 0; axis < 3; ++axis)
            outwards += facet.displacement(axis) * facet.normal(axis);
        for (int i = 0; i < 3; ++i) {
            facet.set_traction(i, facet.initial_traction(i) - stiffness * outwards * facet.normal(i));
            if (!facet.wants_slope()) continue; // of an implicit solver
            for (int j = 0; j < 3; ++j)
                facet.set_slope(i, j, stiffness * facet.normal(i) * facet.normal(j));
        }
    }
};

GAULT_MODULE("new_boundary", "1.0.0", "Your name", "MIT", gault::Boundary<NewBoundary>)
