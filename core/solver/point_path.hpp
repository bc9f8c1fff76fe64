// One material point by itself, strained step by step: what a soil answers away from any grid.
#pragma once
#include "core/solver/material.hpp"

#include <array>

namespace gault::core {

class PointPath {
  public:
    // xx yy zz xy yz zx: tension positive, tensor shear. RunError: the soil refuses the initial stress.
    PointPath(const Material& material, const std::array<double, 6>& stress);

    // An increment of logarithmic strain over dt, s, without rotation, its principal axes those before. Divided where
    // the soil asks for less, as in a run. RunError with the soil's reason.
    void strain(const std::array<double, 6>& increment, double dt);
    const std::array<double, 6>& stress() const { return stress_; }

  private:
    gault_points points(const std::array<double, 6>& increment, double dt);

    const Material& material_;
    double time_ = 0.0;
    std::array<double, 6> stress_, total_{}; // stress; strain so far
    std::array<Column, 6> increment_, old_stress_, new_stress_;
    std::array<Column, 9> old_gradient_, new_gradient_;
    std::vector<Column> old_state_, new_state_, input_;
    std::vector<double*> old_states_, new_states_, inputs_;
};

} // namespace gault::core
