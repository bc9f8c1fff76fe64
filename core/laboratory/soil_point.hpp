// One material point by itself, strained step by step: what a soil answers away from any grid.
#pragma once
#include "core/laboratory/point_batch.hpp"

#include <Eigen/Core>

#include <map>

namespace gault::core {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

class SoilPoint {
  public:
    // `states`: by name, instead of what the soil starts with. `characteristic_length`: of a cell, m. RunError: the
    // soil refuses the initial stress.
    SoilPoint(const Material& material, const Tensor& stress,
              const std::map<std::string, std::vector<double>>& states = {},
              double characteristic_length = 0.01);

    // What the soil answers to an increment of logarithmic strain over dt, s, without rotation, its principal axes
    // those before. Nothing is kept until accept(). Not divided on RETRY.
    struct Answer {
        UpdateFailure failure; // status OK: there is none
        Tensor stress;         // Pa
        Matrix6 tangent;       // where asked for: d stress / d increment; tensor shear, as in gault.h
    };
    Answer answer(const Tensor& increment, double dt, bool tangent);
    void accept(); // the last answer

    // The same in one: divided where the soil asks for less, as in a run. RunError with the soil's reason.
    void strain(const Tensor& increment, double dt);

    Tensor stress() const { return batch_.get(batch_.stress_old, 0); }
    const Tensor& strain() const { return total_; } // so far
    double time() const { return batch_.time; }
    double state(int component) const { return batch_.state_old[static_cast<std::size_t>(component)][0]; }
    const Material& material() const { return batch_.material(); }
    const PointBatch& batch() const {
        return batch_;
    } // its first point is this one, `strain` the last increment
    double last_dt() const { return dt_; }
    int64_t updates() const { return updates_; } // of one point each

  private:
    void lay_out(const Tensor& increment, bool differences);
    Tensor shifted(const Tensor& increment, std::size_t lane) const;

    PointBatch batch_; // the point, and it once more for every component that is shifted
    Tensor total_{}, increment_{};
    double dt_ = 0.0;
    int64_t updates_ = 0;
};

} // namespace gault::core
