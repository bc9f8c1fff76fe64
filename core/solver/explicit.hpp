// The explicit solver: the paper's Section 2.2, step by step, over either motion.
#pragma once
#include "core/solver/boundaries.hpp"
#include "core/solver/model.hpp"
#include "core/solver/motion.hpp"
#include "core/solver/stable_step.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gault::core {

struct Energies { // J, since the start
    double internal = 0.0, external = 0.0, damping = 0.0, kinetic = 0.0;
    double ratio() const; // kinetic over internal, 0 before any work was done
    double error() const; // |kinetic + internal - external - damping| over the largest of them
};

class ExplicitSolver {
  public:
    ExplicitSolver(const Scene& scene, Model& model, int threads);

    double time() const { return time_; } // s
    int64_t steps() const { return steps_; }
    // The length that the next step may have: the factor of the scene times the true limit, found anew when
    // the soil has been strained by another 2 %.
    double allowed_step();
    double stability_limit() const { return limit_; } // s
    void step(double dt);                             // throws RunError

    Motion& motion() { return *motion_; }
    Boundaries& boundaries() { return boundaries_; }
    Energies energies() const;
    // A measure of gault.h's list, of a surface where it belongs to one. nullopt: no such measure.
    std::optional<double> measure(const std::string& name, int side);
    static const std::vector<std::string>& measure_names();
    static bool measures_surface(const std::string& name);
    double largest_velocity() const; // m/s, of the grid

  private:
    void refresh_limit();
    void integrate(double dt, const VectorField& internal); // forces to accelerations, on the grid (Eq. 9)
    void account(double dt);
    double normal_force(int side) const;
    void impose_velocity();

    const SolverSettings& settings_;
    std::array<double, 2> gravity_;
    Model& model_;
    std::unique_ptr<Motion> motion_;
    Boundaries boundaries_;
    VectorField internal_, internal_before_, traction_, acceleration_, velocity_, velocity_before_, damping_,
        reaction_, value_;
    FixedField fixed_;
    std::array<double, 4> initial_area_, initial_radius_;
    Energies energies_;
    std::vector<Energies> energies_of_row_; // of the last step
    double time_ = 0.0, limit_ = 0.0, strained_ = 0.0;
    int64_t steps_ = 0;
};

} // namespace gault::core
