// What differs between the two descriptions of motion; everything else of the solver is shared.
//   total    weights at the reference positions, from fixed cell coordinates; walls stay on the grid
//   updated  points move through the grid (Eq. 16), which is stretched so that its rim stays on the walls
// Equations with a number are those of [1] in docs/method.md.
#pragma once
#include "core/base/team.hpp"
#include "core/grid/grid.hpp"
#include "core/points/points.hpp"
#include "core/solver/material.hpp"
#include "core/transfer/kernels.hpp"

#include <array>
#include <chrono>
#include <memory>
#include <vector>

namespace gault::core {

struct PhaseClock { // seconds that the first thread spent, by phase
    double strain = 0, material = 0, force = 0, velocity = 0, sort = 0;
    bool on = false;
};

class Stopwatch { // adds the time since the last lap to a phase, if it is on
  public:
    explicit Stopwatch(bool on) : on_(on) {
        if (on_) last_ = std::chrono::steady_clock::now();
    }
    void lap(double& phase) {
        if (!on_) return;
        const auto now = std::chrono::steady_clock::now();
        phase += std::chrono::duration<double>(now - last_).count();
        last_ = now;
    }

  private:
    bool on_;
    std::chrono::steady_clock::time_point last_;
};

struct PointRecord { // of a point, for results
    std::array<double, 2> position, reference, velocity;
    double volume;
};

GridView view_of(const Grid& grid);

class Motion {
  public:
    Motion(Grid& grid, std::vector<Material>& materials, std::vector<Points>& points, int threads);
    virtual ~Motion() = default;

    // Node positions (control points), m.
    virtual double node_position(int i, int j, int component) const = 0;
    // Nodal masses now, without mass scaling, kg.
    virtual const Column& mass() const = 0;
    // Internal forces on the nodes at the present state, N.
    virtual void forces(VectorField& internal) = 0;

    // Stress update last: point velocities take `a` over dt (Eq. 10); the grid velocity is mapped from them
    // anew (Eq. 6).
    virtual void accelerate(const VectorField& a, double dt, VectorField& velocity) = 0;
    // Strains over dt from the grid velocity, new stresses, and (stress update last) new positions. Throws
    // RunError.
    virtual void deform(const VectorField& velocity, const Moment& moment) = 0;
    // Stress update first: the grid velocity at the start of the step, then point velocities and positions at
    // its end.
    virtual bool stress_first() const { return false; }
    virtual void map_velocity(VectorField&) {}
    virtual void advance(const VectorField&, const VectorField&, double) {}

    // For the stability limit: K v with the moduli given (per material, per slot), and the product of the
    // consistent mass with a nodal field, both at the present state.
    virtual void stiffness(const VectorField& v, const std::vector<std::array<Column, 2>>& moduli,
                           VectorField& out) = 0;
    virtual void consistent_mass(const VectorField& w, VectorField& out) = 0;

    virtual double kinetic_energy() = 0; // J, of the points, with mass scaling left out
    virtual PointRecord record(int material, std::size_t slot) const = 0;
    // In the updated frame only det F is right, unless the material wants F.
    virtual Deformation deformation(int material) const = 0;

    // ---- solvers without inertia: trial displacements of the nodes since the start of a step ----
    struct State { // all that a step changes
        std::vector<Points> points;
        Grid grid;
        State(std::vector<Points> all, Grid now) : points(std::move(all)), grid(std::move(now)) {}
        virtual ~State() = default;
    };
    virtual std::unique_ptr<State> save() const = 0;
    virtual void restore(const State& state) = 0;
    struct Site { // of a point, on the configuration that weights belong to: initial, or at the start of the
                  // step
        int i, j; // its cell, and first node
        Axis::Weights x, y;
        double radius, volume;             // there; m, m^3
        double start_radius;               // m, at the start of the step
        std::array<double, 4> gradient;    // of the configuration at the start of the step on it: xx xy yx yy
        std::array<double, 5> deformation; // F at the start of the step
    };
    virtual Site site(const State& start, int material, std::size_t slot) const = 0;
    virtual void attempt(const State& start,
                         const VectorField& du) = 0;           // nodes are displaced, points are not yet
    virtual void arrive(const VectorField& du, double dt) = 0; // points follow the nodes

    // Viscous moduli (lame, shear; Pa) of every material: stress of the step's strain that resists in the
    // forces only.
    void set_viscosity(std::vector<std::array<double, 2>> moduli) { viscosity_ = std::move(moduli); }

    int64_t configuration() const { return configuration_; }  // counts the times that anything moved
    double largest_strain() const { return largest_strain_; } // component of the last step
    // P-wave, of the last step in which soils were asked for their moduli, Pa; 0 before any.
    double largest_modulus(int material) const { return largest_modulus_[material]; }
    void ask_for_moduli(bool yes) { asks_ = yes; } // in the steps that follow
    int64_t updates() const { return updates_; }              // constitutive updates so far
    PhaseClock& clock() { return clock_; }
    const Grid& grid() const { return grid_; }
    const std::vector<Material>& materials() const { return materials_; }
    const std::vector<Points>& points() const { return points_; }
    std::size_t point_count() const;
    // f(row of nodes, index of its first node, index past its last), shared among the threads.
    template <class F>
    void each_row(F f) {
        const NodeLayout& layout = grid_.layout();
        team_.each(layout.ny, [&](int j, int) {
            f(j, layout.row_begin(j), layout.row_begin(j) + static_cast<std::size_t>(layout.row));
        });
    }
    std::string where(int material, std::size_t slot) const; // "point 17 of 'sand' at (0.02, 0.1) m"
    std::string sentence(int material, const UpdateFailure& failure) const; // who failed, and why

  protected:
    struct Task { // one batch
        int material, batch;
        std::size_t patch; // offset into patches_, for three components
    };
    void plan(); // after a change of layout
    bool plan_is_stale() const;
    GridView grid_view() const { return view_of(grid_); }
    BatchView view(const Task& task); // without workspace
    // Sums the patches into nodal fields, in a fixed order.
    void reduce(const std::vector<Column*>& fields);
    struct Outcome { // of a batch's strain and stress update
        StrainReport strain;
        UpdateFailure failure;
        double modulus = 0.0; // largest P-wave modulus, Pa
    };
    void update_stress(const Task& task, const BatchView& view, Workspace& workspace, const Moment& moment,
                       Outcome& outcome);
    void clear_patch(const Task& task, int components);
    // Points the view's stress at workspace columns with the elastic stress rate of the strains in the view.
    void elastic_stress(const std::array<Column, 2>& moduli, const Task& task, double dt, BatchView& view,
                        Workspace& workspace);
    double probe_step(const VectorField& v) const; // short enough for strains to be linear in v

    void settle(const std::vector<Outcome>& outcomes); // the first failure, or the largest of each

    static constexpr double strain_limit = 0.1; // of one step: beyond it the run is lost

    Grid& grid_;
    std::vector<Material>& materials_;
    std::vector<Points>& points_;
    const Kernels& kernels_;
    Team team_;
    std::vector<Task> tasks_;
    std::vector<std::vector<int>> tasks_of_row_; // by row of cells
    std::vector<int> versions_;                  // of the layouts that the plan is made for
    Column patches_;
    std::vector<Workspace> workspaces_; // one a thread
    std::vector<Outcome> outcomes_;
    std::vector<std::array<double, 2>> viscosity_;
    PhaseClock clock_;
    double largest_strain_ = 0.0;
    std::vector<double> largest_modulus_; // by material
    bool asks_ = false;
    int64_t updates_ = 0, configuration_ = 0;
};

std::unique_ptr<Motion> make_total_motion(Grid& grid, std::vector<Material>& materials,
                                          std::vector<Points>& points, int threads);
std::unique_ptr<Motion> make_updated_motion(Grid& grid, std::vector<Material>& materials,
                                            std::vector<Points>& points, int threads, bool stress_first);

} // namespace gault::core
