// A manufactured solution at large strain, explicit and axisymmetric. The body moves as
//     r = R + A(t) g(R),   z = Z + B(t) h(Z),
// its elastic stress is C : ln V, and the soil adds the hoop and axial stress, functions of place and time, with which
// momentum balances. Walls go where the motion takes them, the top is free.
#include "tests/hard/moving_body.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace gault::core::test {
namespace {

constexpr double lame = 40e6, shear = 30e6, density = 1600.0;
constexpr double stiff = lame + 2.0 * shear;

struct Motion2 { // of a material point, and its derivatives
    double r, z, r_R, z_Z, r_RR, r_tt, z_tt;
};

struct Manufactured {
    double opened = 0.15, raised = 0.1;    // m: amplitudes of A and B
    double fast_r = 400.0, fast_z = 300.0; // 1/s
    static double g(double R) { return R - 0.4 * R * R; }
    static double h(double Z) { return Z - 0.5 * Z * Z; }
    double A(double t) const { return opened * std::sin(fast_r * t); }
    double B(double t) const { return raised * std::sin(fast_z * t); }

    Motion2 at(double R, double Z, double t) const {
        return {R + A(t) * g(R),
                Z + B(t) * h(Z),
                1.0 + A(t) * (1.0 - 0.8 * R),
                1.0 + B(t) * (1.0 - Z),
                -0.8 * A(t),
                -fast_r * fast_r * A(t) * g(R),
                -fast_z * fast_z * B(t) * h(Z)};
    }
    std::array<double, 2> start_velocity(double R, double Z) const {
        return {opened * fast_r * g(R), raised * fast_z * h(Z)};
    }
    static std::array<double, 3> elastic(const std::array<double, 3>& e) { // rr zz hoop
        const double volumetric = lame * (e[0] + e[1] + e[2]);
        return {volumetric + 2 * shear * e[0], volumetric + 2 * shear * e[1], volumetric + 2 * shear * e[2]};
    }
    static std::array<double, 3> strain(const Motion2& m, double R) {
        return {std::log(m.r_R), std::log(m.z_Z), std::log(m.r / R)};
    }
    std::array<double, 3> stress(double R, double Z, double t) const { // rr zz hoop
        const Motion2 m = at(R, Z, t);
        const double area = m.r_R * m.r / R, rho = density / (area * m.z_Z);
        const double radial = elastic(strain(m, R))[0];
        const double slope = (stiff * m.r_RR / m.r_R + lame * (m.r_R / m.r - 1.0 / R)) / m.r_R;
        const double integral = Z * Z / 2 - Z * Z * Z / 6 - 1.0 / 3.0; // of h, from the top
        return {radial, -fast_z * fast_z * B(t) * density * integral / area,
                radial + m.r * (slope - rho * m.r_tt)};
    }
};

// States: R, Z and the logarithmic strain so far. What is added to the elastic stress is exact.
void make(TestMaterial& soil, const Manufactured& solution) {
    for (const char* name : {"R", "Z", "rr", "zz", "hoop"})
        soil.states.push_back(
            {name, "1", "", GAULT_SCALAR, 0, name[0] == 'R' ? 1.0 : 0.0, -HUGE_VAL, HUGE_VAL});
    soil.update = [&soil, solution](gault_points& p, gault_error&) {
        for (int64_t i = 0; i < p.count; ++i) {
            const double R = p.state_old[0][i], Z = p.state_old[1][i];
            std::array<double, 3> e;
            constexpr int component[] = {0, 1, 2};
            for (int k = 0; k < 3; ++k)
                e[k] = p.state_old[2 + k][i] + p.strain[component[k]][i];
            const auto found = Manufactured::elastic(e), exact = solution.stress(R, Z, p.time),
                       part = Manufactured::elastic(Manufactured::strain(solution.at(R, Z, p.time), R));
            for (int k = 0; k < 6; ++k)
                p.stress[k][i] =
                    k < 3 ? found[k] + exact[k] - part[k] : p.stress_old[k][i] + 2 * shear * p.strain[k][i];
            for (int k = 0; k < 5; ++k)
                p.state[k][i] = k < 2 ? p.state_old[k][i] : e[k - 2];
            if (p.modulus) p.modulus[i] = stiff;
            if (p.shear_modulus) p.shear_modulus[i] = shear;
        }
        return gault_status(GAULT_OK);
    };
}

struct Errors {
    double displacement, stress;
};

struct Case {
    const char* name;
    Frame frame;
    Basis basis;
};

class ManufacturedMotion : public testing::TestWithParam<Case> {
  protected:
    Errors errors(int n, double size) {
        Manufactured solution;
        solution.opened *= size;
        solution.raised *= size;
        TestMaterial soil{lame, shear};
        make(soil, solution);
        Shape shape;
        shape.symmetry = Symmetry::axisymmetric;
        shape.frame = GetParam().frame;
        shape.basis = GetParam().basis;
        shape.lower = {0.5, 0.0};
        shape.upper = {1.5, 1.0};
        shape.axes = {{{n, std::pow(2.0, 1.0 / n)}, {n, 1.0}}};
        shape.per_cell = 4;
        SmallScene s(shape);
        s.add(soil, density);
        TestBoundary walls;
        walls.constrain = [&solution](gault_nodes& nodes) {
            for (int64_t i = 0; i < nodes.count; ++i) {
                const double R = nodes.normal[0][i] < 0.0 ? 0.5 : 1.5, dt = nodes.dt;
                const auto way = solution.A(nodes.time) - solution.A(nodes.time - dt);
                nodes.fixed[0][i] = 1.0;
                nodes.velocity[0][i] = Manufactured::g(R) * (dt > 0.0 ? way / dt : 0.0);
            }
        };
        s.add(walls, {0, 1});
        s.roll({2});
        MovingBody body(s);
        Column* state = body.model.points[0].columns().state.data();
        body.each_point([&](auto&, std::size_t slot, const PointRecord& r) {
            state[0][slot] = r.reference[0];
            state[1][slot] = r.reference[1];
        });
        for (std::size_t slot = 0; slot < body.model.points[0].slots(); ++slot)
            if (state[0][slot] == 0.0) state[0][slot] = 1.0; // empty
        body.launch([&](double R, double Z) { return solution.start_velocity(R, Z); }, {0, 1, 2});
        body.to(5e-3, 0.5); // s: the stiffness grows where the soil is compressed
        const double time = body.solver.time();
        return {body.error(
                    2, [](auto&, auto, auto& r, int k) { return r.position[k] - r.reference[k]; },
                    [&](const PointRecord& r, int k) {
                        const Motion2 m = solution.at(r.reference[0], r.reference[1], time);
                        return k ? m.z - r.reference[1] : m.r - r.reference[0];
                    }),
                body.error(
                    3, [](auto& c, auto slot, auto&, int k) { return c.stress[k][slot]; },
                    [&](const PointRecord& r, int k) {
                        return solution.stress(r.reference[0], r.reference[1], time)[k];
                    })};
    }
};

// The updated frame with so little motion that points stay in their cells.
TEST_P(ManufacturedMotion, Converges) {
    std::vector<double> displacement, stress;
    for (const int n : {8, 16, 32}) {
        const Errors e = errors(n, GetParam().frame == Frame::total ? 1.0 : 1e-3);
        std::printf("%s %2d cells: displacement %.3e stress %.3e\n", GetParam().name, n, e.displacement,
                    e.stress);
        displacement.push_back(e.displacement);
        stress.push_back(e.stress);
    }
    std::printf("%s: orders %.2f %.2f\n", GetParam().name, last_order(displacement), last_order(stress));
    EXPECT_GT(last_order(displacement), 1.9);
    EXPECT_GT(last_order(stress), GetParam().basis == Basis::linear ? 0.95 : 1.9);
}

// Points that have crossed integrate with an error that does not fall with the cell's size (docs/method.md), and that
// makes the steps of a gradient felt which linear functions have.
class CrossingPoints : public ManufacturedMotion {};

TEST_P(CrossingPoints, StayNearTheManufacturedMotion) {
    for (const int n : {8, 16, 32}) {
        const Errors e = errors(n, 1.0);
        std::printf("%s %2d cells, crossed: displacement %.3e stress %.3e\n", GetParam().name, n,
                    e.displacement, e.stress);
        EXPECT_LT(e.displacement, 5e-3);
        EXPECT_LT(e.stress, 1e-2);
    }
}

const Case quadratic_updated{"QuadraticUpdated", Frame::updated, Basis::quadratic};
const auto name = [](const auto& instance) { return std::string(instance.param.name); };
INSTANTIATE_TEST_SUITE_P(Bases, ManufacturedMotion,
                         testing::Values(Case{"LinearTotal", Frame::total, Basis::linear},
                                         Case{"LinearUpdated", Frame::updated, Basis::linear},
                                         Case{"QuadraticTotal", Frame::total, Basis::quadratic},
                                         quadratic_updated),
                         name);
INSTANTIATE_TEST_SUITE_P(Bases, CrossingPoints, testing::Values(quadratic_updated), name);

} // namespace
} // namespace gault::core::test
