#include <gault/material.hpp>
#include <gault/tensor.hpp>

// Linear elasticity within the cylinder of von Mises: q <= sqrt(3) s_u, where q = sqrt(3/2 s:s), s is the
// deviatoric stress and s_u the undrained shear strength (the largest shear stress in plane strain). Tension
// positive. The return is radial and exact.
struct NewMaterial {
    static constexpr const char* name = "new_material";
    static constexpr const char* version = "1.0.0"; // in every result: raise it when a number changes
    static constexpr const char* doc =
        "Elastic, perfectly plastic, without volume change: saturated clay, loaded fast.";
    static constexpr const char* reference =
        "Wilkins, M. L. (1964), Calculation of elastic-plastic flow, UCRL-7322";

    double young_modulus, poisson_ratio, undrained_strength;
    static constexpr std::array parameters{
        gault::parameter<&NewMaterial::young_modulus>("young_modulus", "E", "Pa", "Young's modulus.")
            .above(0),
        gault::parameter<&NewMaterial::poisson_ratio>("poisson_ratio", "nu", "1", "Poisson's ratio.")
            .above(-1)
            .below(0.5)
            .fallback(0.49),
        gault::parameter<&NewMaterial::undrained_strength>("undrained_strength", "s_u", "Pa",
                                                           "Undrained shear strength.")
            .above(0)};

    static constexpr std::array states{
        gault::scalar_state("plastic_strain", "1", "Accumulated equivalent plastic strain.", 0, 0)};
    static constexpr int plastic_strain = gault::state_index(states, "plastic_strain");

    double lame, shear, yield; // Pa

    // Once, when the values are known. What bounds cannot say is said here.
    void prepare() {
        shear = young_modulus / (2 * (1 + poisson_ratio));
        lame = 2 * shear * poisson_ratio / (1 - 2 * poisson_ratio);
        yield = std::sqrt(3.0) * undrained_strength;
        if (undrained_strength > shear)
            throw gault::Invalid("undrained_strength",
                                 "is above the shear modulus: no soil yields at such a strain");
    }

    // One pack of material points. Every lane is a point; no branch, all of them take the same path.
    void update(gault::Point& p) const {
        const gault::Components trial = gault::add_elastic(p.stress_old, p.strain, lame, 2 * shear);
        const gault::Pack mean = (trial[0] + trial[1] + trial[2]) / 3;
        const gault::Pack q = equivalent_stress(trial, mean);
        const gault::Pack scale = gault::select(q > yield, yield / q, 1);
        for (int i = 0; i < 3; ++i) {
            p.stress[i] = mean + scale * (trial[i] - mean);
            p.stress[i + 3] = scale * trial[i + 3];
        }
        p.set_state(plastic_strain, p.state_old(plastic_strain) + gault::max(q - yield, 0) / (3 * shear));
        p.modulus = lame + 2 * shear;
        p.shear_modulus = shear;
    }

  private:
    static gault::Pack equivalent_stress(const gault::Components& stress, gault::Pack mean) {
        gault::Pack sum = 0; // s:s; shear counts twice
        for (int i = 0; i < 3; ++i)
            sum += (stress[i] - mean) * (stress[i] - mean) + 2 * stress[i + 3] * stress[i + 3];
        return gault::sqrt(1.5 * sum);
    }
};

GAULT_MODULE("new_material", "1.0.0", "Your name", "MIT", gault::Material<NewMaterial>)
