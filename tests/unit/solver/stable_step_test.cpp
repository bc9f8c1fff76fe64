#include "tests/unit/solver/small_scene.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <numbers>
#include <tuple>

namespace gault::core::test {
namespace {

constexpr double lame = 40e6, shear = 30e6, density = 1600.0;

class EveryLimit : public testing::TestWithParam<std::tuple<Symmetry, Frame, Basis>> {
  protected:
    Shape shape() const {
        Shape s;
        std::tie(s.symmetry, s.frame, s.basis) = GetParam();
        s.lower = {std::get<0>(GetParam()) == Symmetry::axisymmetric ? 0.1 : 0.0, 0.0};
        s.axes = {{{3, 1.3}, {2, 1.0}}};
        return s;
    }
    bool ring() const { return std::get<0>(GetParam()) == Symmetry::axisymmetric; }
};

struct Dense { // operators of a body as matrices over its free components
    std::vector<std::pair<int, std::size_t>> free;
    Eigen::MatrixXd stiffness, consistent, inverse_mass;

    Dense(Body& body, const FixedField& fixed, const std::vector<std::array<Column, 2>>& moduli) {
        for (int k = 0; k < 2; ++k)
            for (int j = 0; j < body.layout().ny; ++j)
                for (int i = 0; i < body.layout().nx; ++i)
                    if (const std::size_t n = body.layout().index(i, j); fixed.c[k][n] == 0.0)
                        free.emplace_back(k, n);
        const auto size = static_cast<Eigen::Index>(free.size());
        stiffness = consistent = inverse_mass = Eigen::MatrixXd::Zero(size, size);
        for (Eigen::Index c = 0; c < size; ++c) {
            VectorField unit(body.layout()), k_unit(unit), c_unit(unit);
            unit.c[free[c].first][free[c].second] = 1.0;
            body.motion->stiffness(unit, moduli, k_unit);
            body.motion->consistent_mass(unit, c_unit);
            for (Eigen::Index r = 0; r < size; ++r) {
                stiffness(r, c) = -k_unit.c[free[r].first][free[r].second];
                consistent(r, c) = c_unit.c[free[r].first][free[r].second];
            }
            inverse_mass(c, c) = 1.0 / body.motion->mass()[free[c].second];
        }
    }
};

std::vector<std::array<Column, 2>> moduli_of(Body& body) {
    std::vector<std::array<Column, 2>> moduli(1);
    evaluate_moduli(body.model.materials[0], body.model.points[0], view_of(body.model.grid), undeformed, 0.0,
                    moduli[0][0], moduli[0][1]);
    return moduli;
}

TEST_P(EveryLimit, IsTwoOverTheHighestFrequencyOfTheSystem) {
    TestMaterial soil(lame, shear);
    SmallScene s(shape());
    s.add(soil, density);
    Body body(s.scene);
    FixedField fixed(body.layout());
    for (int k = 0; k < body.model.grid.side_nodes(low_y); ++k) { // held at the bottom
        const auto [i, j] = body.model.grid.side_node(low_y, k);
        fixed.c[1][body.layout().index(i, j)] = 1.0;
    }
    const auto moduli = moduli_of(body);
    const Dense dense(body, fixed, moduli);
    EXPECT_LT((dense.stiffness - dense.stiffness.transpose()).norm(), 1e-5 * dense.stiffness.norm());
    EXPECT_LT((dense.consistent - dense.consistent.transpose()).norm(), 1e-14 * dense.consistent.norm());

    const Eigen::MatrixXd system =
        dense.inverse_mass * dense.stiffness * dense.inverse_mass * dense.consistent;
    const double highest = Eigen::EigenSolver<Eigen::MatrixXd>(system, false).eigenvalues().real().maxCoeff();
    EXPECT_NEAR(stable_step(*body.motion, moduli, fixed, 1.0), 2.0 / std::sqrt(highest),
                2e-3 / std::sqrt(highest));
    EXPECT_NEAR(stable_step(*body.motion, moduli, fixed, 9.0), 6.0 / std::sqrt(highest),
                6e-3 / std::sqrt(highest));
}

// v . K v = sum V stress : strain rate, for a velocity whose strain rate is known everywhere
TEST_P(EveryLimit, StiffnessHoldsTheEnergyOfAnAffineVelocity) {
    TestMaterial soil(lame, shear);
    SmallScene s(shape());
    s.add(soil, density);
    Body body(s.scene);
    const VectorField v = body.field([&](double x, double y) {
        return std::array{2.0 * x + (ring() ? 0.0 : 1.0) * y, -1.0 * y + 0.5 * x};
    });
    VectorField force(body.layout());
    body.motion->stiffness(v, moduli_of(body), force);
    double power = 0.0;
    for (int k = 0; k < 2; ++k)
        for (std::size_t n = 0; n < body.layout().size; ++n)
            power -= force.c[k][n] * v.c[k][n];
    const double zz = ring() ? 2.0 : 0.0, xy = 0.5 * (0.5 + (ring() ? 0.0 : 1.0)), trace = 2.0 - 1.0 + zz;
    const double density_of_power = lame * trace * trace + 2 * shear * (4.0 + 1.0 + zz * zz + 2 * xy * xy);
    const double volume = ring() ? std::numbers::pi * (1.0 - 0.01) : 1.0;
    EXPECT_NEAR(power, volume * density_of_power, 1e-6 * power);
}

TEST_P(EveryLimit, RigidMotionCostsNothingAndCarriesAllMass) {
    TestMaterial soil(lame, shear);
    SmallScene s(shape());
    s.add(soil, density);
    Body body(s.scene);
    const VectorField v = body.field([](double, double) { return std::array{0.0, 1.0}; });
    VectorField force(body.layout()), momentum(force);
    body.motion->stiffness(v, moduli_of(body), force);
    body.motion->consistent_mass(v, momentum);
    double total = 0.0;
    for (std::size_t n = 0; n < body.layout().size; ++n) {
        EXPECT_NEAR(force.c[1][n], 0.0, 1e-6 * lame);
        EXPECT_NEAR(momentum.c[1][n], body.motion->mass()[n], 1e-13 * density); // rows of C sum to M
        total += momentum.c[1][n];
    }
    EXPECT_NEAR(total, density * (ring() ? std::numbers::pi * 0.99 : 1.0), 1e-12 * density);
}

INSTANTIATE_TEST_SUITE_P(Bodies, EveryLimit,
                         testing::Combine(testing::Values(Symmetry::plane_strain, Symmetry::axisymmetric),
                                          testing::Values(Frame::total, Frame::updated),
                                          testing::Values(Basis::linear, Basis::quadratic)),
                         [](const auto& instance) {
                             const auto& p = instance.param;
                             return std::string(std::get<0>(p) == Symmetry::axisymmetric ? "Ring" : "Block") +
                                    (std::get<1>(p) == Frame::total ? "Total" : "Updated") +
                                    (std::get<2>(p) == Basis::linear ? "Linear" : "Quadratic");
                         });

} // namespace
} // namespace gault::core::test
