// What every solver has: the model in motion, its boundaries, time, energies, and the measures that programs
// read.
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
    // The part of `internal` that the change of stress did: without the initial stress.
    double straining = 0.0;
    double ratio() const; // kinetic over straining, 0 before any work was done
    double error() const; // |kinetic + internal - external - damping| over the largest of them
};

class Solver {
  public:
    virtual ~Solver() = default;

    double time() const { return time_; } // s
    int64_t steps() const { return steps_; }
    virtual double allowed_step() = 0; // s, that the next step may have
    // Throws RunError. false: the step was too long and nothing has changed; allowed_step() is shorter now.
    virtual bool step(double dt) = 0;
    virtual bool repeatable() const { return false; }
    // Takes back the last step, where steps are repeatable(), for a repetition at this fraction of its
    // length.
    virtual void undo(double /*fraction*/) {}
    virtual double stability_limit() const { return 0.0; }         // s, where there is one
    virtual int64_t iterations() const { return 0; }               // of all steps, where a step iterates
    virtual int64_t updates() const { return motion_->updates(); } // constitutive updates so far

    Motion& motion() { return *motion_; }
    Boundaries& boundaries() { return boundaries_; }
    virtual Energies energies() const { return energies_; }
    double largest_velocity() const; // m/s, of the grid
    // A measure of gault.h's list, of a surface where it belongs to one; radii and displacement at the gauge
    // where there is one. nullopt: no such measure.
    std::optional<double> measure(const std::string& name, int surface, Surface* gauge = nullptr);
    static const std::vector<std::string>& measure_names();
    static bool measures_surface(const std::string& name);

  protected:
    Solver(const Scene& scene, Model& model, int threads);
    virtual double inertia(int component, std::size_t node) const = 0; // force on a node, N
    void load(double dt);                                              // surface loads at time_, now
    void load_first(); // at the start, once a program had the chance to set its controls
    void impose_velocity();
    double weight(int component, std::size_t node) const {
        return motion_->mass()[node] * gravity_[component];
    }

    const SolverSettings& settings_;
    std::array<double, 2> gravity_;
    Model& model_;
    std::unique_ptr<Motion> motion_;
    Boundaries boundaries_;
    VectorField internal_, traction_, velocity_, value_; // at time_; value_: of the fixed components
    FixedField fixed_;
    Energies energies_;
    double time_ = 0.0;
    int64_t steps_ = 0;

  private:
    double normal_force(int surface);
    double excess_pore_pressure(const Surface& surface) const; // Pa

    bool loaded_ = false;
};

std::unique_ptr<Solver> make_solver(const Scene& scene, Model& model, int threads);

} // namespace gault::core
