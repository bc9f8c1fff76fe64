#include "core/solver/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gault::core {
namespace {

// The paper's algorithm: points carry position, volume and velocity, and cross cells. After every step the
// knots of each axis are stretched linearly so that the ends of the axis follow the walls: there are no cut
// cells.
class UpdatedMotion final : public Motion {
  public:
    UpdatedMotion(Grid& grid, std::vector<Material>& materials, std::vector<Points>& points, int threads,
                  bool stress_first)
        : Motion(grid, materials, points, threads), stress_first_(stress_first), shift_(grid.layout()),
          mass_(grid.layout().size), mapped_mass_(mass_) {
        for (int side = 0; side < 4; ++side)
            bend_[side].assign(grid.side_nodes(side), 0.0);
        for (int k = 0; k < 2; ++k)
            ends_[k] = {grid.axis(k).lower(), grid.axis(k).upper()};
        VectorField ignored(grid.layout());
        forces(ignored); // and the nodal masses
    }

    double node_position(int i, int j, int component) const override {
        return grid_.axis(component).node(component ? j : i) +
               shift_.c[component][grid_.layout().index(i, j)];
    }
    const Column& mass() const override { return mass_; }
    bool stress_first() const override { return stress_first_; }

    void forces(VectorField& internal) override {
        each_batch(3, clock_.force, [this](const GridView& grid, BatchView& v, const Task&) {
            kernels_.updated_force(grid, v);
        });
        reduce({&internal.c[0], &internal.c[1], &mass_});
    }

    void accelerate(const VectorField& a, double dt, VectorField& velocity) override {
        const double* acceleration[2] = {a.c[0].data(), a.c[1].data()};
        map(acceleration, nullptr, dt, velocity);
    }
    void map_velocity(VectorField& velocity) override { map(nullptr, nullptr, 0.0, velocity); }

    void advance(const VectorField& a, const VectorField& velocity, double dt) override {
        const double* acceleration[2] = {a.c[0].data(), a.c[1].data()};
        const double* moving[2] = {velocity.c[0].data(), velocity.c[1].data()};
        each_batch(0, clock_.velocity, [&](const GridView& grid, BatchView& v, const Task&) {
            kernels_.updated_velocity(grid, v, dt, acceleration, moving, false);
        });
        follow(velocity, dt);
    }

    void deform(const VectorField& velocity, const Moment& moment) override;
    void stiffness(const VectorField& v, const std::vector<std::array<Column, 2>>& moduli,
                   VectorField& out) override;
    void consistent_mass(const VectorField& w, VectorField& out) override;

    double kinetic_energy() override {
        double energy = 0.0;
        for (const Points& points : points_) {
            const PointColumns& c = points.columns();
            points.each_point([&](std::size_t s) {
                energy += 0.5 * c.mass[s] *
                          (c.velocity[0][s] * c.velocity[0][s] + c.velocity[1][s] * c.velocity[1][s]);
            });
        }
        return energy;
    }

    PointRecord record(int material, std::size_t slot) const override {
        const PointColumns& c = points_[material].columns();
        return {{c.place[0][slot], c.place[1][slot]},
                {c.reference[0][slot], c.reference[1][slot]},
                {c.velocity[0][slot], c.velocity[1][slot]},
                c.measure[slot]};
    }

    struct UpdatedState final : State {
        std::array<std::array<double, 2>, 2> ends;
        std::array<std::vector<double>, 4> bend;
        explicit UpdatedState(const UpdatedMotion& m)
            : State(m.points_, m.grid_), ends(m.ends_), bend(m.bend_) {}
    };
    std::unique_ptr<State> save() const override { return std::make_unique<UpdatedState>(*this); }
    void restore(const State& state) override {
        points_ = state.points;
        grid_ = state.grid;
        ends_ = static_cast<const UpdatedState&>(state).ends;
        bend_ = static_cast<const UpdatedState&>(state).bend;
        shift_.clear();
        plan();
        ++configuration_;
    }
    Site site(const State&, int material, std::size_t slot) const override;
    void attempt(const State&, const VectorField& du) override {
        shift_ = du;
        ++configuration_;
    }
    void arrive(const VectorField& du, double dt) override;

    Deformation deformation(int material) const override {
        return [&c = points_[material].columns(),
                density = materials_[material].density()](std::size_t s) -> std::array<double, 5> {
            if (c.deformation[0].empty())
                return {1.0, 0.0, 0.0, 1.0, c.mass[s] > 0.0 ? c.measure[s] * density / c.mass[s] : 1.0};
            std::array<double, 5> f;
            for (int k = 0; k < 5; ++k)
                f[k] = c.deformation[k][s];
            return f;
        };
    }

  private:
    template <class F>
    void each_batch(int components, double& phase, F f) {
        const GridView grid = grid_view();
        team_.each(static_cast<int>(tasks_.size()), [&](int t, int thread) {
            Stopwatch watch(clock_.on && thread == 0);
            BatchView v = view(tasks_[t]);
            if (components) clear_patch(tasks_[t], components);
            f(grid, v, tasks_[t]);
            watch.lap(phase);
        });
    }

    void map(const double* const* acceleration, const double* const* moving, double dt,
             VectorField& velocity);
    void follow(const VectorField& velocity,
                double dt); // moves the grid with its walls, then points to their new cells
    void move_walls(const VectorField& velocity, double dt);
    void resettle();

    bool stress_first_;
    VectorField shift_;                         // of the nodes, of a trial
    Column mass_, mapped_mass_;                 // of the nodes at the last forces, and at the last mapping
    std::array<std::array<double, 2>, 2> ends_; // of the axes, m
    std::array<std::vector<double>, 4> bend_;   // how far each wall node has left the straight wall, m
};

void UpdatedMotion::map(const double* const* acceleration, const double* const* moving, double dt,
                        VectorField& velocity) {
    each_batch(3, clock_.velocity, [&](const GridView& grid, BatchView& v, const Task&) {
        kernels_.updated_velocity(grid, v, dt, acceleration, moving, true);
    });
    reduce({&velocity.c[0], &velocity.c[1], &mapped_mass_});
    each_row([&](int, std::size_t begin, std::size_t end) {
        for (int k = 0; k < 2; ++k)
            for (std::size_t n = begin; n < end; ++n)
                velocity.c[k][n] = mapped_mass_[n] > 0.0 ? velocity.c[k][n] / mapped_mass_[n] : 0.0;
    });
}

void UpdatedMotion::deform(const VectorField& velocity, const Moment& moment) {
    const bool move = !stress_first_;
    const StrainInput base{
        {velocity.c[0].data(), velocity.c[1].data()}, {nullptr, nullptr}, moment.dt, strain_limit, true};
    const GridView grid = grid_view();
    team_.each(static_cast<int>(tasks_.size()), [&](int t, int thread) {
        const Task& task = tasks_[t];
        const Material& material = materials_[task.material];
        BatchView v = view(task);
        attach_workspace(material, workspaces_[thread], v);
        Stopwatch watch(clock_.on && thread == 0);
        StrainInput in = base;
        in.rotate = !material.finite_strain();
        Outcome& outcome = outcomes_[t];
        outcome = {};
        outcome.strain = kernels_.updated_strain(grid, v, in, true, move);
        if (v.volume_ratio)
            for (int i = 0; i < v.pages * page_slots; ++i)
                v.volume_ratio[i] = v.mass[i] > 0.0 ? v.measure[i] * material.density() / v.mass[i] : 1.0;
        watch.lap(clock_.strain);
        if (outcome.strain.bad < 0) update_stress(task, v, workspaces_[thread], moment, outcome);
        watch.lap(clock_.material);
    });
    settle(outcomes_);
    if (move) follow(velocity, moment.dt);
}

Motion::Site UpdatedMotion::site(const State&, int material, std::size_t slot) const {
    const Points& points = points_[material];
    const PointColumns& c = points.columns();
    const int i = points.layout().page_column[slot / page_slots], j = grid_.axis(1).cell_of(c.place[1][slot]);
    const Axis &x = grid_.axis(0), &y = grid_.axis(1);
    const double radius = c.place[0][slot];
    return {i,
            j,
            x.weights(i, (radius - x.origin()[i]) * x.inverse_length()[i]),
            y.weights(j, (c.place[1][slot] - y.origin()[j]) * y.inverse_length()[j]),
            radius,
            c.measure[slot],
            radius,
            {1.0, 0.0, 0.0, 1.0},
            deformation(material)(slot)};
}

// As the explicit step does it, with the strain of the whole step: positions, volumes and F, then the grid.
void UpdatedMotion::arrive(const VectorField& du, double dt) {
    VectorField velocity(du);
    for (Column& c : velocity.c)
        for (double& v : c)
            v /= dt;
    shift_.clear();
    const StrainInput in{
        {velocity.c[0].data(), velocity.c[1].data()}, {nullptr, nullptr}, dt, HUGE_VAL, false};
    const GridView grid = grid_view();
    for (const Task& task : tasks_) {
        BatchView v = view(task);
        attach_workspace(materials_[task.material], workspaces_[0], v);
        kernels_.updated_strain(grid, v, in, true, true);
    }
    follow(velocity, dt);
    VectorField ignored(grid_.layout());
    forces(ignored); // and the nodal masses
}

void UpdatedMotion::follow(const VectorField& velocity, double dt) {
    Stopwatch watch(clock_.on);
    move_walls(velocity, dt);
    resettle();
    watch.lap(clock_.sort);
}

void UpdatedMotion::move_walls(const VectorField& velocity, double dt) {
    for (int side = 0; side < 4; ++side) {
        const int axis = normal_axis(side), n = grid_.side_nodes(side);
        double momentum = 0.0, mass = 0.0;
        for (int k = 0; k < n; ++k) {
            const auto [i, j] = grid_.side_node(side, k);
            const std::size_t node = grid_.layout().index(i, j);
            momentum += mass_[node] * velocity.c[axis][node];
            mass += mass_[node];
        }
        const double mean = momentum / mass;
        ends_[axis][side % 2] += dt * mean;
        const Axis& across = grid_.axis(axis);
        const double allowed = 0.1 * across.length()[side % 2 ? across.cells() - 1 : 0];
        for (int k = 0; k < n; ++k) {
            const auto [i, j] = grid_.side_node(side, k);
            bend_[side][k] += dt * (velocity.c[axis][grid_.layout().index(i, j)] - mean);
            if (std::abs(bend_[side][k]) > allowed)
                throw RunError(fmt::format(
                    "the wall near ({:.6g}, {:.6g}) m has left its straight line by more than a tenth of "
                    "a cell; the updated frame keeps walls straight: use `frame: total`",
                    node_position(i, j, 0), node_position(i, j, 1)));
        }
    }
    for (int k = 0; k < 2; ++k)
        grid_.axis(k).move(ends_[k][0], ends_[k][1]);
    ++configuration_;
}

void UpdatedMotion::resettle() {
    const GridView grid = grid_view();
    const int n = static_cast<int>(tasks_.size());
    std::vector<std::vector<int64_t>> left(n);
    team_.each(n, [&](int t, int) {
        const BatchView v = view(tasks_[t]);
        int64_t few[64];
        const int64_t found = kernels_.leavers(grid, v, few, 64);
        if (found <= 64) {
            left[t].assign(few, few + found);
        } else {
            left[t].resize(found);
            kernels_.leavers(grid, v, left[t].data(), found);
        }
    });
    std::vector<std::vector<Points::Move>> moves(points_.size());
    for (int t = 0; t < n; ++t) {
        const Task& task = tasks_[t];
        const Points& points = points_[task.material];
        const std::size_t first =
            static_cast<std::size_t>(points.layout().batches[task.batch].first_page) * page_slots;
        for (const int64_t local : left[t]) {
            const std::size_t slot = first + static_cast<std::size_t>(local);
            const double x = points.columns().place[0][slot], y = points.columns().place[1][slot];
            const int column = grid_.axis(0).cell_of(x), row = grid_.axis(1).cell_of(y);
            const int cell = row * grid_.axis(0).cells() + column;
            const int now = points.layout().batches[task.batch].cell_row * grid_.axis(0).cells() +
                            points.layout().page_column[slot / page_slots];
            for (int k = 0; k < 2; ++k) {
                const double outside =
                    std::max(grid_.axis(k).lower() - (k ? y : x), (k ? y : x) - grid_.axis(k).upper());
                if (outside > 0.5 * grid_.axis(k).length()[k ? row : column])
                    throw InstabilityError(fmt::format("{} left the grid", where(task.material, slot)));
            }
            if (cell != now) moves[task.material].push_back({slot, cell});
        }
    }
    for (std::size_t m = 0; m < points_.size(); ++m)
        if (!moves[m].empty()) points_[m].relocate(moves[m]);
    if (plan_is_stale()) plan();
}

void UpdatedMotion::stiffness(const VectorField& v, const std::vector<std::array<Column, 2>>& moduli,
                              VectorField& out) {
    const GridView grid = grid_view();
    const double dt = probe_step(v);
    const StrainInput in{{v.c[0].data(), v.c[1].data()}, {nullptr, nullptr}, dt, strain_limit, true};
    team_.each(static_cast<int>(tasks_.size()), [&](int t, int thread) {
        const Task& task = tasks_[t];
        BatchView probe = view(task);
        for (double*& strain : probe.strain)
            strain = nullptr; // the points' own stays
        attach_workspace(materials_[task.material], workspaces_[thread], probe);
        kernels_.updated_strain(grid, probe, in, false, false);
        elastic_stress(moduli[task.material], task, dt, probe, workspaces_[thread]);
        clear_patch(task, 3);
        kernels_.updated_force(grid, probe);
    });
    reduce({&out.c[0], &out.c[1], &mapped_mass_});
}

void UpdatedMotion::consistent_mass(const VectorField& w, VectorField& out) {
    const double* gathered[2] = {w.c[0].data(), w.c[1].data()};
    const GridView grid = grid_view();
    for (const Task& task : tasks_) {
        BatchView probe = view(task);
        for (int k = 0; k < 2; ++k) {
            probe.velocity[k] = workspaces_[0].column(Workspace::probe + k);
            std::fill_n(probe.velocity[k], probe.pages * page_slots, 0.0);
        }
        clear_patch(task, 3);
        kernels_.updated_velocity(grid, probe, 1.0, gathered, nullptr, true);
    }
    reduce({&out.c[0], &out.c[1], &mapped_mass_});
}

} // namespace

std::unique_ptr<Motion> make_updated_motion(Grid& grid, std::vector<Material>& materials,
                                            std::vector<Points>& points, int threads, bool stress_first) {
    return std::make_unique<UpdatedMotion>(grid, materials, points, threads, stress_first);
}

} // namespace gault::core
