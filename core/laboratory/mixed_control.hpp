// Strain and stress of one point under mixed control: six linear constraints, each on strains, stresses or both, met at
// every step by Newton's method on the soil's tangent (Bardet and Choucair 1991, Int. J. Num. Anal. Meth. Geomech. 15,
// 1-23: constraints S d(stress) + E d(strain) = dY).
#pragma once
#include "core/config/element.hpp"
#include "core/laboratory/soil_point.hpp"

namespace gault::core {

class MixedControl {
  public:
    // The stage begins where the point stands.
    MixedControl(SoilPoint& point, const ElementStage& stage);

    // On to this share of the stage, 0 to 1, in one step or, where no step of that length can be made, in several.
    // RunError with the reason: no strain meets the constraints; the point is then as near to it as it came.
    void go_to(double share);
    int64_t iterations() const { return iterations_; } // corrections of an increment

  private:
    using Vector6 = Eigen::Matrix<double, 6, 1>;
    struct Trial {
        SoilPoint::Answer answer;
        Vector6 misfit; // of the constraints, as strains
    };

    double value(const Constraint& c, const Tensor& strain, const Tensor& stress) const;
    bool prescribes_stress() const; // one that changes
    Vector6 misfit(double share, const Tensor& increment, const Tensor& stress) const;
    Matrix6 jacobian(const Matrix6& tangent) const;
    bool ask(double share, double dt, const Tensor& increment, Trial& trial);
    bool is_met(const Tensor& increment, const Trial& trial) const;
    bool solve(double share, double dt, Tensor& increment);

    SoilPoint& point_;
    const ElementStage& stage_;
    Tensor begin_;                    // strain when the stage began
    std::array<double, 6> start_;     // values of the constraints then
    double share_ = 0.0, last_ = 0.0; // done; the last step
    Tensor increment_{};              // of the last step
    double stiffness_ = 0.0;          // Pa: makes stresses comparable with strains
    int64_t iterations_ = 0;
    std::string reason_; // why the last attempt failed
};

} // namespace gault::core
