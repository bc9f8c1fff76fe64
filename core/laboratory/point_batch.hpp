// Material points away from any grid, handed to a soil model as a solver hands them: one batch, every array owned here.
#pragma once
#include "core/solver/material.hpp"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace gault::core {

using Tensor = std::array<double, 6>; // xx yy zz xy yz zx: tension positive, tensor shear
using Matrix = std::array<double, 9>; // row-major

class PointBatch {
  public:
    // States at their initial values, stress zero, no deformation, cells of a centimetre.
    PointBatch(const Material& material, std::size_t count);

    std::size_t count() const { return count_; }
    const Material& material() const { return *material_; }

    Tensor get(const std::array<Column, 6>& columns, std::size_t point) const;
    void set(std::array<Column, 6>& columns, std::size_t point, const Tensor& value);
    // The increment of strain, and what follows from it: F_new = exp(increment) F_old, volume ratio, density.
    void set_strain(std::size_t point, const Tensor& increment);
    // The old ones that are named; every one has as many values as its shape.
    void set_states(std::size_t point, const std::map<std::string, std::vector<double>>& states);
    // The old values, the increment and the inputs of a point of a batch of the same material.
    void take(std::size_t point, const PointBatch& from, std::size_t its_point);
    // The last point once more in every lane beyond `count`, as the contract promises.
    void pad();

    // The model's own `start` on stress_old; its states become state_old. The model's answer.
    UpdateFailure start();
    // One call, as it is: neither divided on RETRY nor differentiated. The model's answer. With `tangent` the model is
    // asked for its tangent, which it must have.
    UpdateFailure update(double dt, bool tangent = false);
    // The answer of the last update becomes the state that the next starts from.
    void accept();

    std::array<Column, 6> strain, stress_old, stress; // increments; Pa
    std::vector<Column> state_old, state, input;      // a column a component; a column an input
    std::array<Column, 9> F_old, F_new;               // where the model wants them
    std::array<Column, 36> tangent;                   // empty until asked for
    Column modulus, shear_modulus;                    // emptied: the model is not asked
    double time = 0.0;                                // s, of the accepted state
    double suggested = 0.5;                           // of the step, as the model left it

  private:
    UpdateFailure call(gault_status (*function)(const void*, gault_points*, gault_error*) noexcept, double dt,
                       bool wants_tangent);

    const Material* material_;
    std::size_t count_, padded_;
    std::vector<const double*> old_states_, inputs_;
    std::vector<double*> states_;
    Column volume_ratio_; // current over initial, of the accepted state
};

// exp(e), row-major: the deformation gradient of a logarithmic strain without rotation.
Matrix deformation_gradient(const Tensor& strain);

} // namespace gault::core
