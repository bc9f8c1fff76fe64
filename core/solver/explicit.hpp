// The explicit solver, step by step, over either motion: Section 2.2 of the paper, [1] in docs/method.md.
#pragma once
#include "core/solver/solver.hpp"

namespace gault::core {

class ExplicitSolver final : public Solver {
  public:
    ExplicitSolver(const Scene& scene, Model& model, int threads);

    // The factor of the scene times the true limit, which is found anew when the soil has been strained by
    // another 2 %, has said in a step that it is stiffer by 5 % (it is asked in every eighth), or is held
    // otherwise.
    double allowed_step() override;
    bool step(double dt) override;
    double stability_limit() const override { return limit_; }
    Energies energies() const override;

  private:
    using Moduli = std::vector<std::array<Column, 2>>; // P-wave and shear, by material
    Moduli moduli();
    bool limit_is_stale();
    void refresh_limit(Moduli moduli);
    void integrate(double dt, const VectorField& internal); // forces to accelerations, on the grid (Eq. 9)
    void account(double dt);
    double inertia(int component, std::size_t node) const override {
        return settings_.mass_scaling * motion_->mass()[node] * acceleration_.c[component][node];
    }

    VectorField internal_initial_, internal_before_, traction_before_, acceleration_, velocity_before_,
        damping_;
    struct RowWork : Energies {
        double power = 0.0; // of all forces, W
    };
    std::vector<RowWork> work_of_row_; // of the last step
    double to_full_step_ = 0.0;        // what velocities half a step old lack of the kinetic energy, J
    double limit_ = 0.0, strained_ = 0.0;
    std::vector<double> stiffest_; // by material, Pa, when the limit was found
    std::size_t fixed_count_ = 0;
    std::vector<std::pair<int, std::size_t>> held_; // when the loads were evaluated
    double dt_before_ = 0.0;
};

} // namespace gault::core
