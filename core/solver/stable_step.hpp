// The largest time step that is stable on this grid, with these points, basis and moduli.
#pragma once
#include "core/solver/motion.hpp"

#include <utility>
#include <vector>

namespace gault::core {

// Which components of which nodes are prescribed: 0 where free, else a bit for each surface that holds it.
class FixedField : public VectorField {
  public:
    using VectorField::VectorField;
    static constexpr int symmetry = 52; // beside the surfaces: a double is exact for the bits 0 to 52

    void release() {
        for (const auto& [component, node] : held_)
            c[component][node] = 0.0;
        held_.clear();
    }
    void hold(int surface, int component, std::size_t node) {
        double& bits = c[component][node];
        if (bits == 0.0) held_.emplace_back(component, node);
        bits = static_cast<double>(static_cast<int64_t>(bits) | int64_t{1} << surface);
    }
    bool held_by(int surface, int component, std::size_t node) const {
        return static_cast<int64_t>(c[component][node]) >> surface & 1;
    }
    std::size_t count() const { return held_.size(); }                             // of prescribed components
    const std::vector<std::pair<int, std::size_t>>& held() const { return held_; } // component, node

  private:
    std::vector<std::pair<int, std::size_t>> held_;
};

// 2 / omega_max, s, of the linearised system that the explicit scheme integrates: w' = -M^-1 K v, v = M^-1 C
// w with lumped mass M and consistent mass C (the map of point velocities onto the grid damps short waves, so
// the limit lies above h/c). omega_max^2 is the largest eigenvalue, by Lanczos iteration in the inner product
// of C, to about 0.1 %. `moduli`: P-wave and shear modulus of every slot of every material, Pa.
// `mass_scaling` multiplies the mass. Where nothing is free, the limit as if all were.
double stable_step(Motion& motion, const std::vector<std::array<Column, 2>>& moduli, const FixedField& fixed,
                   double mass_scaling);

} // namespace gault::core
