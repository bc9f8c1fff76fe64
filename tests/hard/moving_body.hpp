// A body made in memory and set in motion by an initial velocity; the explicit solver carries it on.
#pragma once
#include "tests/unit/solver/small_scene.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace gault::core::test {

struct MovingBody {
    Model model;
    ExplicitSolver solver;

    explicit MovingBody(const SmallScene& s, int threads = 1)
        : model(build_model(s.scene)), solver(s.scene, model, threads) {}

    // The velocity of the grid becomes f(place) -> {x, y}, half a step before the start. The points' velocities w are those
    // that are mapped to it, v = M^-1 C w, found by w += f - v. `walls`: sides whose normal velocity is prescribed; there w
    // is f, and nothing at the start, since the first step adds what is prescribed.
    template <class F>
    void launch(F f, const std::vector<int>& walls) {
        const VectorField target = interpolated(f);
        VectorField w = target, v(w), free(model.grid.layout());
        Motion& motion = solver.motion();
        for (int k = 0; k < 2; ++k)
            for (std::size_t n = 0; n < motion.mass().size(); ++n)
                free.c[k][n] = motion.mass()[n] > 0.0;
        for (const int side : walls)
            for (int n = 0; n < model.grid.side_nodes(side); ++n) {
                const auto [i, j] = model.grid.side_node(side, n);
                free.c[normal_axis(side)][model.grid.layout().index(i, j)] = 0.0;
            }
        const auto each_free = [&](auto change) { // change(component, node)
            for (int k = 0; k < 2; ++k)
                for (std::size_t n = 0; n < motion.mass().size(); ++n)
                    if (free.c[k][n] != 0.0) change(k, n);
        };
        for (int iteration = 0; iteration < 40; ++iteration) {
            motion.consistent_mass(w, v);
            each_free(
                [&](int k, std::size_t n) { w.c[k][n] += target.c[k][n] - v.c[k][n] / motion.mass()[n]; });
        }
        VectorField start(model.grid.layout());
        each_free([&](int k, std::size_t n) { start.c[k][n] = w.c[k][n]; });
        motion.accelerate(start, 1.0, v);
    }

    // Equal steps of at most `share` of the allowed one; returns their length.
    double to(double end, double share = 1.0) {
        const double left = end - solver.time();
        const int steps = static_cast<int>(std::ceil(left / (share * solver.allowed_step())));
        for (int n = 0; n < steps; ++n)
            solver.step(left / steps);
        return left / steps;
    }

    template <class F>
    void each_point(F f) { // f(columns, slot, record)
        for (int m = 0; m < static_cast<int>(model.points.size()); ++m)
            model.points[m].each_point([&](std::size_t slot) {
                f(model.points[m].columns(), slot, solver.motion().record(m, slot));
            });
    }

    // Relative L2 error of a field over the raw points: exact(record, component), found(columns, slot, record, component).
    template <class Found, class Exact>
    double error(int components, Found found, Exact exact) {
        double off = 0.0, size = 0.0;
        each_point([&](PointColumns& c, std::size_t slot, const PointRecord& r) {
            for (int k = 0; k < components; ++k) {
                const double e = exact(r, k);
                off += r.volume * std::pow(found(c, slot, r, k) - e, 2);
                size += r.volume * e * e;
            }
        });
        return std::sqrt(off / size);
    }

  private:
    template <class F>
    VectorField interpolated(F f) const { // at the places of the nodes
        const Axis &x = model.grid.axis(0), &y = model.grid.axis(1);
        const Eigen::MatrixXd from_x = collocation(x).inverse(), from_y = collocation(y).inverse();
        VectorField w(model.grid.layout());
        for (int k = 0; k < 2; ++k) {
            Eigen::MatrixXd values(x.nodes(), y.nodes());
            for (int i = 0; i < x.nodes(); ++i)
                for (int j = 0; j < y.nodes(); ++j)
                    values(i, j) = f(place(x, i), place(y, j))[k];
            const Eigen::MatrixXd nodal = from_x * values * from_y.transpose();
            for (int i = 0; i < x.nodes(); ++i)
                for (int j = 0; j < y.nodes(); ++j)
                    w.c[k][model.grid.layout().index(i, j)] = nodal(i, j);
        }
        return w;
    }
    // The axis of radial symmetry that has no extent has one function, 1.
    static double place(const Axis& axis, int i) { return axis.degree() ? axis.node(i) : axis.lower(); }
    static Eigen::MatrixXd collocation(const Axis& axis) { // N_j at the place of node i
        Eigen::MatrixXd n = Eigen::MatrixXd::Zero(axis.nodes(), axis.nodes());
        for (int i = 0; i < axis.nodes(); ++i) {
            const double x = place(axis, i);
            const int cell = axis.cell_of(x);
            const auto weights = axis.weights(cell, (x - axis.origin()[cell]) * axis.inverse_length()[cell]);
            for (int a = 0; a <= axis.degree(); ++a)
                n(i, cell + a) = weights.value[a];
        }
        return n;
    }
};

// The order of errors on grids, or with steps, each half as large as the one before: between the last two.
inline double last_order(const std::vector<double>& errors) {
    return std::log2(errors[errors.size() - 2] / errors.back());
}

} // namespace gault::core::test
