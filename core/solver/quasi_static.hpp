// The quasi-static solver: equilibrium at the end of every step by Newton's method, steps as long as the
// strain allows.
#pragma once
#include "core/solver/equilibrium.hpp"
#include "core/solver/solver.hpp"

#include <Eigen/UmfPackSupport>

namespace gault::core {

class QuasiStaticSolver final : public Solver {
  public:
    QuasiStaticSolver(const Scene& scene, Model& model, int threads);

    double allowed_step() override { return allowed_; }
    bool step(double dt) override;
    bool repeatable() const override { return true; }
    void undo(double fraction) override;
    int64_t iterations() const override { return iterations_; }
    // Of the last step, before each iteration and at the end: forces out of balance over all forces.
    const std::vector<double>& residuals() const { return residuals_; }
    int64_t updates() const override { return equilibrium_.updates(); }

  private:
    enum class Outcome { balanced, strained, diverged };
    Outcome iterate(const Moment& moment);
    Outcome evaluate(const Moment& moment);
    struct Imbalance {    // norm of the forces on free components, or the way left
        double of_all;    // over the norm of all forces
        double of_change; // over that of their change in the step, at least of the least that counts
        double forces;    // norm of all forces, at least of the least that count
    };
    Imbalance unbalanced() const;
    bool correct();
    bool shorten(double fraction, double dt);
    void restore(); // the start of the step
    double even_share(double ratio);
    void account(double dt);
    double inertia(int, std::size_t) const override { return 0.0; }
    template <class F>
    void each_component(F f) const; // f(row of the matrix, component, node)

    Equilibrium equilibrium_;
    Stiffness stiffness_;
    Eigen::UmfPackLU<Stiffness::Matrix> factors_;
    bool analysed_ = false;
    VectorField du_, du_before_, correction_,
        wanted_;    // displacement of the step, of the one before, m; at fixed components
    struct Before { // what measures read, at the start of the step
        VectorField internal, traction;
        FixedField fixed;
        Boundaries::Loads loads;
        Energies energies;
    } before_;
    const VectorField still_; // what loads see as velocity: without inertia there are no waves to absorb
    std::unique_ptr<Motion::State> start_;
    const bool rate_dependent_; // a soil's answer depends on the rate
    double allowed_, dt_before_ = 0.0, least_ = 0.0, largest_strain_ = 0.0;
    double way_ = 0.0, way_before_ = 0.0;      // of the fastest node in the step, m; of all steps before it
    double usual_ = 0.0;                       // length that was allowed before an event cut a step short, s
    double fraction_ = 0.5;                    // of the step, after one that failed
    std::string reason_;                       // why it failed
    std::shared_ptr<const PointError> failed_; // because a soil had no result
    int64_t iterations_ = 0;
    double largest_forces_ = 0.0; // norm of all forces in the steps so far
    std::vector<double> residuals_;
};

} // namespace gault::core
