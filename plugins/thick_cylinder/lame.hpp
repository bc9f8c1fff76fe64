// Elastic thick cylinder in plane strain, small strain: Lame (1852). Stresses compression positive,
// displacement outward from the state under the isotropic initial stress.
#pragma once

namespace thick_cylinder {

struct Elastic {
    double young_modulus, poisson_ratio; // Pa, 1
    double shear() const { return young_modulus / (2.0 * (1.0 + poisson_ratio)); }
};

struct Stresses { // Pa, compression positive
    double radial, hoop;
};

struct Lame {
    double uniform, varying; // sigma_r, sigma_theta = uniform +- varying / r^2; Pa, Pa m^2

    Lame(double inner, double outer, double inner_pressure, double outer_pressure) { // m, m, Pa, Pa
        const double a2 = inner * inner, b2 = outer * outer;
        uniform = (outer_pressure * b2 - inner_pressure * a2) / (b2 - a2);
        varying = (inner_pressure - outer_pressure) * a2 * b2 / (b2 - a2);
    }
    Stresses at(double r) const { return {uniform + varying / (r * r), uniform - varying / (r * r)}; }

    double displacement(double r, const Elastic& soil, double initial_pressure) const { // m
        return (varying / r - (1.0 - 2.0 * soil.poisson_ratio) * r * (uniform - initial_pressure)) /
               (2.0 * soil.shear());
    }
};

} // namespace thick_cylinder
