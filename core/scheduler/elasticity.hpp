// Whether the soil still answers as the elastic material that it was at the start. For boundaries that stand for
// elastic soil beyond them. Total frame: elsewhere points do not keep their strain.
#pragma once
#include "core/solver/model.hpp"
#include "core/solver/motion.hpp"

#include <array>
#include <vector>

namespace gault::core {

class Elasticity {
  public:
    // At the start: remembers stress and moduli. Where the volume is that of cells, shear alone is judged.
    Elasticity(Model& model, const Motion& motion, VolumetricStrain volumetric_strain);

    // The largest initial distance to the axis, m, of a point whose change of stress is not, to 1 % of it, what
    // the moduli at the start make of its Hencky strain. 0: there is none.
    double largest_inelastic_radius(const Motion& motion) const;

    // Of a cylinder that yields up to its boundary at `outer`, m: the radius up to which it would have yielded had
    // the soil gone on. The points next to the boundary give the yield line sigma_theta = A sigma_r + B, which the
    // elastic soil beyond would meet at the hoop strain q / 2G, q = (p0 (1 - A) - B) / (1 + A), and the exponent
    // with which the hoop strain of the yielding soil falls until then. An estimate, good to some 10 %.
    double yielding_radius(const Motion& motion, double outer) const;

  private:
    struct Start { // of one material, by slot
        std::array<Column, 6> stress;
        Column p_wave, shear; // moduli, Pa
    };
    struct Place {
        int material;
        std::size_t slot;
        double radius; // initial, m
    };
    bool elastic(const Motion& motion, const Place& place) const;
    static double hoop_strain(const Motion& motion, const Place& place);

    std::vector<Start> start_;
    bool shear_only_;
};

} // namespace gault::core
