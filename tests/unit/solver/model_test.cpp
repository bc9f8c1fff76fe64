#include "tests/unit/solver/small_scene.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace gault::core::test {
namespace {

constexpr double lame = 40e6, shear = 30e6, pi = std::numbers::pi;

double power_integral(double low, double high, int power) {
    return (std::pow(high, power + 1) - std::pow(low, power + 1)) / (power + 1);
}

// The points of a scene integrate x^p y^q; the exact integral is over the whole body.
void expect_exact(const Shape& shape, int degree) {
    TestMaterial soil(lame, shear);
    SmallScene s(shape);
    s.add(soil, 1600.0);
    Body body(s.scene);
    const bool ring = shape.symmetry == Symmetry::axisymmetric;
    for (int p = 0; p <= degree; ++p)
        for (int q = 0; q <= degree; ++q) {
            double sum = 0.0;
            body.each_point([&](PointColumns&, std::size_t, const PointRecord& r) {
                sum += r.volume * std::pow(r.position[0], p - (ring ? 1 : 0)) * std::pow(r.position[1], q);
            });
            const double exact = (ring ? 2.0 * pi : 1.0) * power_integral(shape.lower[0], shape.upper[0], p) *
                                 power_integral(shape.lower[1], shape.upper[1], q);
            EXPECT_NEAR(sum, exact, 1e-12 * exact) << "x^" << p << " y^" << q;
        }
}

TEST(Points, OfAGaussRuleIntegratePolynomialsUpToTwiceTheirNumberLessOne) {
    for (const int n : {1, 2, 3, 4, 5, 6})
        for (const Symmetry symmetry : {Symmetry::plane_strain, Symmetry::axisymmetric})
            for (const Frame frame : {Frame::total, Frame::updated}) {
                Shape shape;
                shape.symmetry = symmetry;
                shape.frame = frame;
                shape.lower = {0.3, 0.2};
                shape.axes = {{{2, 1.5}, {1, 1.0}}};
                shape.per_cell = n * n;
                expect_exact(shape, 2 * n - 1);
            }
}

TEST(Points, AtEqualDistancesIntegratePolynomialsUpToTheirNumberLessOne) {
    for (const int n : {1, 2, 3, 4, 5, 6}) {
        Shape shape;
        shape.lower = {0.3, 0.2};
        shape.per_cell = n * n;
        shape.placement = Placement::uniform;
        expect_exact(shape, n - 1);
        TestMaterial soil(lame, shear);
        shape.axes = {{{1, 1.0}, {1, 1.0}}};
        SmallScene s(shape);
        s.add(soil, 1600.0);
        Body body(s.scene);
        std::vector<double> x;
        body.each_point([&](PointColumns& c, std::size_t slot, const PointRecord& r) {
            if (x.size() < static_cast<std::size_t>(n)) x.push_back(r.position[0]);
            EXPECT_GT(c.measure[slot], 0.0);
        });
        for (int i = 0; i < n; ++i)
            EXPECT_NEAR(x[i], 0.3 + 0.7 * (i + 0.5) / n, 1e-14);
    }
}

TEST(Points, CarryTheMassOfTheirMaterial) {
    for (const Frame frame : {Frame::total, Frame::updated}) {
        Shape shape;
        shape.symmetry = Symmetry::axisymmetric;
        shape.frame = frame;
        TestMaterial soft(lame, shear), hard(10 * lame, 10 * shear);
        SmallScene s(shape);
        s.scene.axes = {{{4, 1.0}, {3, 1.0}}};
        s.add(soft, 1000.0, "soft");
        s.add(hard, 3000.0, "hard");
        s.scene.regions.push_back({"core", 1, {{0, 0}, {2, 3}}, {}});
        Body body(s.scene);
        double nodal = 0.0;
        for (const double m : body.motion->mass())
            nodal += m;
        EXPECT_NEAR(nodal, pi * (0.25 * 3000.0 + 0.75 * 1000.0), 1e-10);
        EXPECT_EQ(body.model.points[0].count(), 6u * 16);
        EXPECT_EQ(body.model.points[1].count(), 6u * 16);
        EXPECT_EQ(body.model.description, (std::vector<std::string>{"region core: 6 cells of 'hard'"}));
    }
}

TEST(Region, TakesItsCellsAndTheLastOneWins) {
    TestMaterial a(lame, shear), b(lame, shear), c(lame, shear);
    SmallScene s{Shape{}};
    s.scene.axes = {{{4, 1.0}, {1, 1.0}}};
    s.add(a, 1.0, "a");
    s.add(b, 1.0, "b");
    s.add(c, 1.0, "c");
    s.scene.regions.push_back({"left", 1, {{0, 0}, {2, 1}}, {}});
    s.scene.regions.push_back({"middle", 2, {{1, 0}, {3, 1}}, {}});
    EXPECT_EQ(build_model(s.scene).material_of_cell, (std::vector<int>{1, 2, 2, 0}));
}

TEST(Material, ThatNoCellHasIsLeftAlone) {
    for (const Frame frame : {Frame::total, Frame::updated}) {
        Shape shape;
        shape.frame = frame;
        TestMaterial used(lame, shear), unused(1e3 * lame, 1e3 * shear);
        SmallScene s(shape);
        s.add(used, 1600.0, "used");
        s.add(unused, 1600.0, "unused");
        Model model = build_model(s.scene);
        ExplicitSolver solver(s.scene, model, 1);
        solver.step(solver.allowed_step());
        EXPECT_EQ(model.points[1].count(), 0u);
        EXPECT_GT(solver.stability_limit(), 0.2 * 0.17 / std::sqrt((lame + 2 * shear) / 1600.0));
    }
}

SmallScene& layered(SmallScene& s, TestMaterial& lower, TestMaterial& upper) {
    s.scene.axes = {{{2, 1.0}, {4, 1.0}}};
    s.add(lower, 2000.0, "lower");
    s.add(upper, 1500.0, "upper");
    s.scene.regions.push_back({"upper", 1, {{0, 2}, {2, 4}}, {}});
    s.scene.gravity = {0.0, -10.0};
    s.scene.initial_stress.gravity = true;
    s.scene.initial_stress.k0 = 0.4;
    s.scene.initial_stress.depth = 2.0;
    s.scene.initial_stress.vertical = 7e3;
    return s;
}

TEST(InitialStress, FollowsTheWeightOfTheLayersAbove) {
    for (const Frame frame : {Frame::total, Frame::updated}) {
        Shape shape;
        shape.frame = frame;
        TestMaterial lower(lame, shear), upper(lame, shear);
        SmallScene s(shape);
        Body body(layered(s, lower, upper).scene);
        const double top = 7e3 + 1500.0 * 10.0 * 2.0; // the surcharge and 2 m of what is uppermost
        body.each_point([&](PointColumns& c, std::size_t slot, const PointRecord& r) {
            const double y = r.position[1];
            const double vertical =
                top + 10.0 * (y > 0.5 ? 1500.0 * (1.0 - y) : 1500.0 * 0.5 + 2000.0 * (0.5 - y));
            ASSERT_NEAR(c.stress[1][slot], -vertical, 1e-9);
            ASSERT_NEAR(c.stress[0][slot], -0.4 * vertical, 1e-9);
            ASSERT_NEAR(c.stress[2][slot], -0.4 * vertical, 1e-9);
            for (const int k : {3, 4, 5})
                ASSERT_EQ(c.stress[k][slot], 0.0);
        });
    }
}

TEST(SoilBehind, IsThatOfTheCellAtTheSurface) {
    for (const Frame frame : {Frame::total, Frame::updated}) {
        Shape shape;
        shape.frame = frame;
        TestMaterial lower(lame, shear), upper(4 * lame, 4 * shear);
        SmallScene s(shape);
        Body body(layered(s, lower, upper).scene);
        const auto behind = body.model.behind(s.scene);
        const SoilBehind low = behind({1.0, 0.25}), high = behind({1.0, 0.75});
        EXPECT_EQ(low.shear_modulus, shear);
        EXPECT_EQ(high.shear_modulus, 4 * shear);
        EXPECT_NEAR(low.impedance_p, std::sqrt(2000.0 * (lame + 2 * shear)), 1e-6);
        EXPECT_NEAR(high.impedance_s, std::sqrt(1500.0 * 4 * shear), 1e-6);
        EXPECT_NEAR(high.stress[1], -(37e3 + 10.0 * 1500.0 * 0.25), 1e-9);
        EXPECT_NEAR(high.stress[0], 0.4 * high.stress[1], 1e-9);
    }
}

// A modulus that depends on the stress is that of the place, not of the first point.
TEST(SoilBehind, HasTheModulusOfItsDepth) {
    TestMaterial soil(lame, shear);
    soil.update = [&](gault_points& p, gault_error&) {
        for (int64_t i = 0; p.modulus && i < p.count; ++i) {
            p.shear_modulus[i] = -100.0 * p.stress_old[1][i];
            p.modulus[i] = 3.0 * p.shear_modulus[i];
        }
        return gault_status(GAULT_OK);
    };
    SmallScene s{Shape{}};
    s.scene.axes = {{{1, 1.0}, {10, 1.0}}};
    s.scene.gravity = {0.0, -10.0};
    s.scene.initial_stress.gravity = true;
    s.add(soil, 2000.0);
    Body body(s.scene);
    const auto behind = body.model.behind(s.scene);
    for (const double y : {0.05, 0.55, 0.85}) // to a cell's height
        EXPECT_NEAR(behind({1.0, y}).shear_modulus, 100.0 * 20e3 * (1.0 - y), 100.0 * 20e3 * 0.06);
}

} // namespace
} // namespace gault::core::test
