#include "core/solver/motion.hpp"

#include <algorithm>
#include <cmath>

namespace gault::core {
namespace {

// With constant weights the points' velocities are a nodal field w, v_p = sum N w: Eq. 10 becomes w += a dt,
// and Eq. 5-6 become v = M^-1 C w with the consistent mass C, once a node instead of once a point. Both
// orders of the stress update (first or last) are then the same sequence.
class TotalMotion final : public Motion {
  public:
    TotalMotion(Grid& grid, std::vector<Material>& materials, std::vector<Points>& points, int threads)
        : Motion(grid, materials, points, threads), displacement_(grid.layout()), flip_(grid.layout()),
          mass_(grid.layout().size), zero_(grid.layout()), first_forces_(true) {
        assemble_mass();
    }

    double node_position(int i, int j, int component) const override {
        return grid_.axis(component).node(component ? j : i) +
               displacement_.c[component][grid_.layout().index(i, j)];
    }
    const Column& mass() const override { return mass_; }

    void forces(VectorField& internal) override {
        if (first_forces_) sweep(zero_, {0.0, 0.0}, false);
        first_forces_ = false;
        reduce({&internal.c[0], &internal.c[1]});
    }

    void accelerate(const VectorField& a, double dt, VectorField& velocity) override {
        each_node([&](int k, std::size_t n) { flip_.c[k][n] += dt * a.c[k][n]; });
        stencil_rows(flip_, velocity, [&](int k, std::size_t n) { velocity.c[k][n] *= inverse_mass_[n]; });
    }

    void deform(const VectorField& velocity, const Moment& moment) override {
        sweep(velocity, moment, true);
        each_node([&](int k, std::size_t n) { displacement_.c[k][n] += moment.dt * velocity.c[k][n]; });
        ++configuration_;
    }

    void stiffness(const VectorField& v, const std::vector<std::array<Column, 2>>& moduli,
                   VectorField& out) override;

    void consistent_mass(const VectorField& w, VectorField& out) override {
        stencil_rows(w, out, [](int, std::size_t) {});
    }

    double kinetic_energy() override {
        VectorField product(grid_.layout());
        consistent_mass(flip_, product);
        double energy = 0.0;
        for (int k = 0; k < 2; ++k)
            for (std::size_t n = 0; n < mass_.size(); ++n)
                energy += 0.5 * flip_.c[k][n] * product.c[k][n];
        return energy;
    }

    struct TotalState final : State {
        VectorField displacement;
        explicit TotalState(const TotalMotion& m)
            : State(m.points_, m.grid_), displacement(m.displacement_) {}
    };
    std::unique_ptr<State> save() const override { return std::make_unique<TotalState>(*this); }
    void restore(const State& state) override {
        points_ = state.points;
        displacement_ = static_cast<const TotalState&>(state).displacement;
        ++configuration_;
    }
    Site site(const State& start, int material, std::size_t slot) const override;
    void attempt(const State& start, const VectorField& du) override {
        const VectorField& from = static_cast<const TotalState&>(start).displacement;
        each_node([&](int k, std::size_t n) { displacement_.c[k][n] = from.c[k][n] + du.c[k][n]; });
        ++configuration_;
    }
    void arrive(const VectorField& du, double dt) override {
        each_node([&](int k, std::size_t n) { flip_.c[k][n] = du.c[k][n] / dt; });
    }

    PointRecord record(int material, std::size_t slot) const override;
    Deformation deformation(int material) const override;

  private:
    template <class F>
    void each_node(F f) { // f(component, node)
        each_row([&](int, std::size_t begin, std::size_t end) {
            for (int k = 0; k < 2; ++k)
                for (std::size_t n = begin; n < end; ++n)
                    f(k, n);
        });
    }
    // out = C w with the consistent mass C, then finish(component, node) of every node.
    template <class F>
    void stencil_rows(const VectorField& w, VectorField& out, F finish) {
        each_row([&](int, std::size_t begin, std::size_t end) {
            const double* coefficient[25];
            for (std::size_t c = 0; c < stencil_.size(); ++c)
                coefficient[c] = stencil_[c].data() + begin;
            for (int k = 0; k < 2; ++k) {
                kernels_.stencil(coefficient, grid_.layout().row, w.c[k].data() + begin,
                                 out.c[k].data() + begin);
                for (std::size_t n = begin; n < end; ++n)
                    finish(k, n);
            }
        });
    }
    struct Basis2 { // the functions of a point
        int i, j;
        Axis::Weights x, y;
        std::array<double, 2> reference;
    };
    Basis2 basis(int material, std::size_t slot) const;
    std::array<double, 5> gradient(const Basis2& at, const VectorField& displacement) const; // F
    void assemble_mass();
    // Strains, stresses (unless only the geometry is wanted) and internal forces, batch by batch.
    void sweep(const VectorField& velocity, const Moment& moment, bool update);
    StrainInput strain_input(const VectorField& velocity, double dt, bool rotate) const {
        return {{velocity.c[0].data(), velocity.c[1].data()},
                {displacement_.c[0].data(), displacement_.c[1].data()},
                dt,
                strain_limit,
                rotate};
    }

    VectorField displacement_, flip_; // of the nodes: u, and w above
    Column mass_, inverse_mass_;
    std::vector<Column> stencil_; // consistent mass: (2 degree + 1) coefficients a node, along each axis
    VectorField zero_;
    bool first_forces_;
};

TotalMotion::Basis2 TotalMotion::basis(int material, std::size_t slot) const {
    const Points& points = points_[material];
    const std::size_t page = slot / page_slots;
    const auto& batches = points.layout().batches;
    const auto after =
        std::upper_bound(batches.begin(), batches.end(), page, [](std::size_t p, const Batch& b) {
            return p < static_cast<std::size_t>(b.first_page);
        });
    const int i = points.layout().page_column[page], j = std::prev(after)->cell_row;
    const double xi = points.columns().place[0][slot], eta = points.columns().place[1][slot];
    const Axis &x = grid_.axis(0), &y = grid_.axis(1);
    return {i,
            j,
            x.weights(i, xi),
            y.weights(j, eta),
            {x.origin()[i] + xi * x.length()[i], y.origin()[j] + eta * y.length()[j]}};
}

void TotalMotion::assemble_mass() {
    const int dx = grid_.degree(0), dy = grid_.degree(1), reach = 2 * dx + 1;
    const NodeLayout& layout = grid_.layout();
    stencil_.assign(static_cast<std::size_t>(reach * (2 * dy + 1)), Column(layout.size));
    for (int m = 0; m < static_cast<int>(points_.size()); ++m)
        points_[m].each_point([&](std::size_t slot) {
            const Basis2 at = basis(m, slot);
            const double r = grid_.axisymmetric() ? at.reference[0] : 1.0;
            const double point_mass = materials_[m].density() * points_[m].columns().measure[slot] * r;
            const auto value = [&](int a, int b) { return at.x.value[a] * at.y.value[b]; };
            for (int b = 0; b <= dy; ++b)
                for (int a = 0; a <= dx; ++a) {
                    const std::size_t n = layout.index(at.i + a, at.j + b);
                    const double share = point_mass * value(a, b);
                    mass_[n] += share;
                    for (int d = 0; d <= dy; ++d)
                        for (int c = 0; c <= dx; ++c)
                            stencil_[static_cast<std::size_t>((d - b + dy) * reach + c - a + dx)][n] +=
                                share * value(c, d);
                }
        });
    inverse_mass_.resize(mass_.size());
    for (std::size_t n = 0; n < mass_.size(); ++n)
        inverse_mass_[n] = mass_[n] > 0.0 ? 1.0 / mass_[n] : 0.0;
}

void TotalMotion::sweep(const VectorField& velocity, const Moment& moment, bool update) {
    const GridView grid = grid_view();
    team_.each(static_cast<int>(tasks_.size()), [&](int t, int thread) {
        const Task& task = tasks_[t];
        const Material& material = materials_[task.material];
        BatchView v = view(task);
        attach_workspace(material, workspaces_[thread], v);
        Stopwatch watch(clock_.on && thread == 0);
        Outcome& outcome = outcomes_[t];
        outcome.strain =
            kernels_.total_strain(grid, v, strain_input(velocity, moment.dt, !material.finite_strain()));
        watch.lap(clock_.strain);
        if (update && outcome.strain.bad < 0)
            update_stress(task, v, workspaces_[thread], moment, outcome);
        watch.lap(clock_.material);
        clear_patch(task, 2);
        kernels_.total_force(grid, v);
        watch.lap(clock_.force);
    });
    if (update) settle(outcomes_);
}

void TotalMotion::stiffness(const VectorField& v, const std::vector<std::array<Column, 2>>& moduli,
                            VectorField& out) {
    const GridView grid = grid_view();
    const double dt = probe_step(v);
    team_.each(static_cast<int>(tasks_.size()), [&](int t, int thread) {
        const Task& task = tasks_[t];
        BatchView probe = view(task);
        attach_workspace(materials_[task.material], workspaces_[thread], probe);
        kernels_.total_strain(grid, probe, strain_input(v, dt, true));
        elastic_stress(moduli[task.material], task, dt, probe, workspaces_[thread]);
        clear_patch(task, 2);
        kernels_.total_force(grid, probe);
    });
    reduce({&out.c[0], &out.c[1]});
}

std::array<double, 5> TotalMotion::gradient(const Basis2& at, const VectorField& displacement) const {
    std::array<double, 5> f = undeformed(0);
    double radial = 0.0;
    for (int b = 0; b <= grid_.degree(1); ++b)
        for (int a = 0; a <= grid_.degree(0); ++a) {
            const std::size_t n = grid_.layout().index(at.i + a, at.j + b);
            for (int k = 0; k < 2; ++k) {
                f[2 * k] += at.x.slope[a] * at.y.value[b] * displacement.c[k][n];
                f[2 * k + 1] += at.x.value[a] * at.y.slope[b] * displacement.c[k][n];
            }
            radial += at.x.value[a] * at.y.value[b] * displacement.c[0][n];
        }
    if (grid_.axisymmetric()) f[4] += radial / at.reference[0];
    return f;
}

Deformation TotalMotion::deformation(int material) const {
    return [this, material](std::size_t slot) { return gradient(basis(material, slot), displacement_); };
}

Motion::Site TotalMotion::site(const State& start, int material, std::size_t slot) const {
    const Basis2 at = basis(material, slot);
    const std::array<double, 5> f = gradient(at, static_cast<const TotalState&>(start).displacement);
    const double radius = at.reference[0], weight = grid_.axisymmetric() ? radius : 1.0;
    return {at.i,
            at.j,
            at.x,
            at.y,
            radius,
            points_[material].columns().measure[slot] * weight,
            radius * f[4],
            {f[0], f[1], f[2], f[3]},
            f};
}

PointRecord TotalMotion::record(int material, std::size_t slot) const {
    const Basis2 at = basis(material, slot);
    PointRecord r{at.reference, at.reference, {0.0, 0.0}, points_[material].columns().measure[slot]};
    for (int b = 0; b <= grid_.degree(1); ++b)
        for (int a = 0; a <= grid_.degree(0); ++a) {
            const std::size_t n = grid_.layout().index(at.i + a, at.j + b);
            const double value = at.x.value[a] * at.y.value[b];
            for (int k = 0; k < 2; ++k) {
                r.position[k] += value * displacement_.c[k][n];
                r.velocity[k] += value * flip_.c[k][n];
            }
        }
    const std::array<double, 5> f = deformation(material)(slot);
    r.volume *= f[0] * f[3] - f[1] * f[2];
    if (grid_.axisymmetric()) r.volume *= r.position[0];
    return r;
}

} // namespace

std::unique_ptr<Motion> make_total_motion(Grid& grid, std::vector<Material>& materials,
                                          std::vector<Points>& points, int threads) {
    return std::make_unique<TotalMotion>(grid, materials, points, threads);
}

} // namespace gault::core
