// The exact expansion of a cylindrical cavity in a soil that keeps its volume, whatever the soil: Palmer, A. C. (1972),
// Geotechnique 22, 451-457, with finite strain. With e = ln(r/r0), r^2 - r0^2 = a^2 - a0^2 and q(e) = sigma_r - sigma_theta of
// one point in plane-strain pure shear,
//     sigma_r(r) = p_ext + integral of q(e) / (exp(2 e) - 1) de from e at the outer radius (0 without bound) to e at r.
#pragma once
#include "core/config/scene.hpp"

#include <vector>

namespace gault::core {

class PalmerSolution {
  public:
    // `largest`: cavity strain to go to. InputError: the scene is no such cavity; RunError from the soil.
    PalmerSolution(const Scene& scene, double largest);

    double pressure(double cavity_strain) const; // true, Pa, compression positive
    struct Profile {
        std::vector<double> radius, sigma_r, sigma_theta; // initial radius, m; Pa, compression positive
    };
    Profile profile(double cavity_strain, int rings) const;

  private:
    double at(const std::vector<double>& values, double strain) const;
    double outer_strain(double cavity_strain) const; // e at the outer radius
    double radial_stress(double strain, double outer) const;

    double inner_ = 0.0, outer_ = 0.0, external_ = 0.0; // m; m, infinite without bound; Pa
    std::vector<double> strain_, q_, integral_;         // e; Pa; from 0 to e, Pa
};

} // namespace gault::core
