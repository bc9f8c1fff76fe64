#include "core/solver/quasi_static.hpp"
#include "tests/unit/solver/small_scene.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace gault::core::test {
namespace {

constexpr double pi = std::numbers::pi, lame = 40e6, shear = 30e6, density = 1600.0;
constexpr double a = 0.2, b = 1.2, height = 0.7;

struct Case {
    Basis basis;
    Frame frame;
};

std::string name_of(const testing::TestParamInfo<Case>& info) {
    return std::string(info.param.frame == Frame::total ? "Total" : "Updated") +
           (info.param.basis == Basis::linear ? "Linear" : "Quadratic");
}

// A ring of 4 by 6 cells.
class Parts : public testing::TestWithParam<Case> {
  protected:
    TestMaterial soil{lame, shear};
    SmallScene ring(Symmetry symmetry = Symmetry::axisymmetric) {
        Shape form;
        form.symmetry = symmetry;
        form.basis = GetParam().basis;
        form.frame = GetParam().frame;
        form.lower = {a, 0.0};
        form.upper = {b, height};
        form.axes = {{{4, 1.2}, {6, 0.9}}};
        form.per_cell = 9;
        SmallScene s(form);
        s.add(soil, density);
        return s;
    }
    // As far as the frame allows: the walls of the updated one stay straight.
    void deform(Body& body) const {
        const double bend = GetParam().frame == Frame::total ? 0.006 : 0.0;
        body.motion->deform(body.field([&](double x, double y) {
            return std::array{0.04 * x + bend * std::sin(5 * y), -0.04 * y + bend * std::cos(3 * x)};
        }),
                            {1.0, 1.0});
    }
};
INSTANTIATE_TEST_SUITE_P(Everywhere, Parts,
                         testing::Values(Case{Basis::linear, Frame::total},
                                         Case{Basis::quadratic, Frame::total},
                                         Case{Basis::linear, Frame::updated},
                                         Case{Basis::quadratic, Frame::updated}),
                         name_of);

TEST_P(Parts, ThatTileASideAddUpToIt) {
    SmallScene s = ring();
    Body body(s.scene);
    for (const int side : {low_x, high_x, low_y, high_y}) {
        const int n = normal_axis(side) == 0 ? 6 : 4;
        Surface whole(*body.motion, side), first(*body.motion, side, std::array{0, 1}),
            rest(*body.motion, side, std::array{1, n});
        EXPECT_EQ(first.size() + rest.size(), whole.size());
        EXPECT_NEAR(first.initial_area() + rest.initial_area(), whole.initial_area(), 1e-14);
    }
    Surface whole(*body.motion, low_x), lower(*body.motion, low_x, std::array{0, 2}),
        upper(*body.motion, low_x, std::array{2, 6});
    deform(body);
    for (Surface* surface : {&whole, &lower, &upper})
        surface->refresh(*body.motion);
    EXPECT_NE(whole.projected_area(), whole.initial_area());
    EXPECT_NEAR(lower.projected_area() + upper.projected_area(), whole.projected_area(), 1e-14);
    EXPECT_NEAR(lower.enclosed_volume() + upper.enclosed_volume(), whole.enclosed_volume(), 1e-14);
    EXPECT_GT(upper.position(0)[1], lower.position(lower.size() - 1)[1]);
}

TEST_P(Parts, HaveTheAreaOfTheirIntervalOfTheSide) {
    SmallScene s = ring();
    Body body(s.scene);
    const auto& y = body.model.grid.axis(1).knots();
    const auto& r = body.model.grid.axis(0).knots();
    EXPECT_NEAR(Surface(*body.motion, low_x, std::array{2, 5}).projected_area(), 2 * pi * a * (y[5] - y[2]),
                1e-14);
    EXPECT_NEAR(Surface(*body.motion, high_y, std::array{1, 3}).projected_area(),
                pi * (r[3] * r[3] - r[1] * r[1]), 1e-13);
    EXPECT_DOUBLE_EQ(Surface(*body.motion, low_x, std::array{2, 5}).mean_radius(), a);
}

TEST_P(Parts, UnderPressureArePushedAsTheSideTheyTile) {
    SmallScene whole = ring(), parts = ring();
    whole.press({low_x, high_y}, 50e3);
    parts.press({parts.part(low_x, 0, 2), parts.part(low_x, 2, 6)}, 50e3);
    parts.press({parts.part(high_y, 0, 3), parts.part(high_y, 3, 4)}, 50e3);
    Body body(whole.scene);
    Boundaries one(whole.scene, *body.motion, body.model.behind(whole.scene));
    Boundaries two(parts.scene, *body.motion, body.model.behind(parts.scene));
    deform(body);
    const VectorField still(body.layout());
    VectorField of_one(still), of_two(still);
    Stiffness k_one(body.model.grid), k_two(body.model.grid);
    one.load(*body.motion, 0.0, 1.0, still, of_one, &k_one);
    two.load(*body.motion, 0.0, 1.0, still, of_two, &k_two);
    for (int k = 0; k < 2; ++k)
        for (std::size_t n = 0; n < of_one.c[k].size(); ++n)
            ASSERT_NEAR(of_two.c[k][n], of_one.c[k][n], 1e-10 * 50e3);
    EXPECT_LT((k_one.matrix() - k_two.matrix()).norm(), 1e-12 * k_one.matrix().norm());
    for (const int side : {low_x, high_x, low_y, high_y}) // the sides see what their parts carry
        for (int k = 0; k < 2; ++k)
            EXPECT_NEAR(two.load_on(side)[k], one.load_on(side)[k], 1e-10 * 50e3);
    EXPECT_NEAR(two.load_on(4)[0] + two.load_on(5)[0], one.load_on(low_x)[0], 1e-10 * 50e3);
}

// The stresses of a run with the pressure on all of the inside, in one piece or two.
template <class S>
std::vector<double> stresses(SmallScene s, bool in_parts) {
    const double time = 2e-3;
    s.roll({low_y, high_y, high_x});
    if (in_parts) {
        s.press({s.part(low_x, 0, 3)}, 1e6);
        s.press({s.part(low_x, 3, 6)}, 1e6);
    } else {
        s.press({low_x}, 1e6);
    }
    Model model = build_model(s.scene);
    S solver(s.scene, model, 1);
    while (solver.time() < time)
        solver.step(std::min(solver.allowed_step(), time));
    std::vector<double> all{solver.measure("normal_force", low_x).value(),
                            solver.measure("displacement", low_x).value() * 1e9};
    model.points[0].each_point([&](std::size_t slot) {
        for (int k = 0; k < 4; ++k)
            all.push_back(model.points[0].columns().stress[k][slot]);
    });
    return all;
}

void expect_alike(const std::vector<double>& whole, const std::vector<double>& parts) {
    ASSERT_EQ(whole.size(), parts.size());
    for (std::size_t i = 0; i < whole.size(); ++i)
        ASSERT_NEAR(parts[i], whole[i], 1e-3) << i; // of 1 MPa
}

TEST_P(Parts, GiveTheSameRunAsTheSide) {
    expect_alike(stresses<ExplicitSolver>(ring(), false), stresses<ExplicitSolver>(ring(), true));
    const auto still = [&] {
        SmallScene s = ring();
        s.scene.solver.strain_step = 1.0;
        s.scene.solver.tolerance = 1e-10;
        return s;
    };
    expect_alike(stresses<QuasiStaticSolver>(still(), false), stresses<QuasiStaticSolver>(still(), true));
}

TEST_P(Parts, HoldTheNodesWhoseFunctionsReachThem) {
    SmallScene s = ring();
    s.roll({s.part(low_x, 2, 4)});
    Body body(s.scene);
    Boundaries boundaries(s.scene, *body.motion, body.model.behind(s.scene));
    FixedField fixed(body.layout());
    VectorField value(body.layout());
    boundaries.constrain(*body.motion, 0.0, 1.0, fixed, value);
    std::vector<int> held;
    for (int j = 0; j < body.layout().ny; ++j)
        if (fixed.held_by(4, 0, body.layout().index(0, j))) held.push_back(j);
    EXPECT_EQ(held, GetParam().basis == Basis::linear ? (std::vector{2, 3, 4}) : (std::vector{2, 3, 4, 5}));
    EXPECT_EQ(fixed.count(), static_cast<int>(held.size()));
}

// What pushes each of `surfaces` once the outside is under pressure, and the top under another.
std::vector<double> forces(const SmallScene& s, const std::vector<int>& surfaces) {
    Model model = build_model(s.scene);
    QuasiStaticSolver solver(s.scene, model, 1);
    EXPECT_TRUE(solver.step(1.0));
    std::vector<double> all;
    for (const int surface : surfaces)
        all.push_back(solver.measure("normal_force", surface).value());
    return all;
}

class HeldParts : public Parts {
  protected:
    SmallScene squeezed() {
        SmallScene s = ring();
        s.scene.solver.strain_step = 1.0;
        s.scene.solver.tolerance = 1e-10;
        s.press({high_x}, 1e6);
        s.press({high_y}, 3e5);
        s.roll({low_y});
        return s;
    }
};
INSTANTIATE_TEST_SUITE_P(TotalFrame, HeldParts,
                         testing::Values(Case{Basis::linear, Frame::total},
                                         Case{Basis::quadratic, Frame::total}),
                         name_of);

TEST_P(HeldParts, AddUpToTheHeldSide) {
    SmallScene whole = squeezed(), parts = squeezed();
    whole.roll({low_x});
    const int lower = parts.part(low_x, 0, 2), upper = parts.part(low_x, 2, 6);
    parts.roll({lower});
    parts.roll({upper});
    const double side = forces(whole, {low_x})[0];
    const std::vector<double> f = forces(parts, {low_x, lower, upper});
    EXPECT_GT(side, 0.5e6 * 2 * pi * a * height);
    EXPECT_NEAR(f[0], side, 1e-6 * side);
    EXPECT_NEAR(f[1] + f[2], f[0], 1e-12 * side);
    EXPECT_GT(f[1], 0.2 * side);
}

TEST_P(HeldParts, ShareTheForceOfAHeldSideThatIsOnlyMeasuredInParts) {
    SmallScene s = squeezed();
    const int lower = s.part(low_x, 0, 2), upper = s.part(low_x, 2, 6);
    s.roll({low_x});
    const std::vector<double> f = forces(s, {low_x, lower, upper});
    EXPECT_NEAR(f[1] + f[2], f[0], 1e-12 * f[0]);
}

TEST_P(HeldParts, LeaveAPartUnderPressureItsOwnForceAlone) {
    SmallScene s = squeezed();
    const int membrane = s.part(low_x, 0, 2), casing = s.part(low_x, 2, 6);
    s.press({membrane}, 8e5);
    s.roll({casing});
    Model model = build_model(s.scene);
    QuasiStaticSolver solver(s.scene, model, 1);
    ASSERT_TRUE(solver.step(1.0));
    const double force = solver.measure("normal_force", membrane).value();
    EXPECT_NEAR(force, 8e5 * solver.measure("area", membrane).value(), 1e-9 * force);
    EXPECT_NEAR(force + solver.measure("normal_force", casing).value(),
                solver.measure("normal_force", low_x).value(), 1e-9 * force);
    EXPECT_EQ(solver.measure("displacement", casing).value(), 0.0) << "it is held over all of its length";
    EXPECT_NE(solver.measure("displacement", membrane).value(), 0.0);
}

// Every part of a wall in a uniform stress bears pressure times its own area.
TEST_P(HeldParts, ShareAUniformPressureByTheirAreas) {
    SmallScene s = ring();
    s.scene.initial_stress.vertical = 2e5;
    s.roll({low_y, high_y, high_x});
    const int lower = s.part(low_x, 0, 2), upper = s.part(low_x, 2, 6), inner_disc = s.part(low_y, 0, 1);
    s.roll({lower, upper});
    Model model = build_model(s.scene);
    QuasiStaticSolver solver(s.scene, model, 1);
    for (const int surface : {lower, upper, inner_disc}) {
        const double area = solver.measure("area", surface).value();
        EXPECT_NEAR(solver.measure("normal_force", surface).value(), 2e5 * area, 1e-9 * 2e5 * area);
    }
}

TEST_P(Parts, AGaugeIsTheMeanWhereTheWallMovesAsOne) {
    SmallScene s = ring();
    Body body(s.scene);
    Surface inner(*body.motion, low_x), gauge = Surface::at(*body.motion, low_x, 0.31);
    EXPECT_DOUBLE_EQ(gauge.initial_radius(), a);
    EXPECT_EQ(gauge.mean_displacement(), 0.0);
    body.motion->deform(body.field([](double x, double y) {
        return std::array{0.05 * x, -0.02 * y};
    }),
                        {1.0, 1.0});
    inner.refresh(*body.motion);
    gauge.refresh(*body.motion);
    EXPECT_NEAR(gauge.mean_radius(), inner.mean_radius(), 1e-15);
    EXPECT_NEAR(gauge.mean_displacement(), inner.mean_displacement(), 1e-15);
    EXPECT_NEAR(gauge.position(0)[1], 0.98 * 0.31, 1e-15) << "it is the same place of the soil";
}

TEST_P(Parts, AGaugeReadsItsPlaceOfAWallThatTilts) {
    if (GetParam().frame == Frame::updated) return; // whose walls do not
    SmallScene s = ring();
    Body body(s.scene);
    std::vector<Surface> gauges;
    for (const double place : {0.0, 0.123, height})
        gauges.push_back(Surface::at(*body.motion, low_x, place));
    body.motion->deform(body.field([](double, double y) { return std::array{0.03 * y, 0.0}; }), {1.0, 1.0});
    for (Surface& gauge : gauges) {
        gauge.refresh(*body.motion);
        EXPECT_NEAR(gauge.mean_displacement(), 0.03 * gauge.reference(0)[1], 1e-16);
        EXPECT_NEAR(gauge.mean_radius(), a + 0.03 * gauge.reference(0)[1], 1e-15);
    }
    EXPECT_EQ(gauges[1].reference(0)[1], 0.123);
}

TEST_P(Parts, OfAUniformlyDrivenWallStayTogether) {
    SmallScene s = ring();
    TestBoundary wall;
    wall.constrain = [](gault_nodes& nodes) {
        for (int64_t i = 0; i < nodes.count; ++i) {
            nodes.fixed[0][i] = 1.0;
            nodes.velocity[0][i] = -0.5 * nodes.normal[0][i];
        }
    };
    const int lower = s.part(low_x, 0, 3), upper = s.part(low_x, 3, 6);
    s.add(wall, {lower, upper});
    s.roll({low_y, high_y, high_x});
    Model model = build_model(s.scene);
    ExplicitSolver solver(s.scene, model, 1);
    Surface gauge = Surface::at(solver.motion(), low_x, 0.4);
    for (int n = 0; n < 20; ++n)
        solver.step(solver.allowed_step());
    const double travel = 0.5 * solver.time();
    for (const int surface : {0, lower, upper})
        EXPECT_NEAR(solver.measure("displacement", surface).value(), travel, 1e-14);
    EXPECT_NEAR(solver.measure("displacement", lower, &gauge).value(), travel, 1e-14);
    EXPECT_NEAR(solver.measure("radius", lower, &gauge).value(), a + travel, 1e-14);
    EXPECT_NEAR(solver.measure("initial_radius", lower, &gauge).value(), a, 1e-15);
    EXPECT_NEAR(solver.measure("normal_force", lower).value() + solver.measure("normal_force", upper).value(),
                solver.measure("normal_force", low_x).value(),
                1e-12 * solver.measure("normal_force", low_x).value());
}

TEST(FixedField, KnowsEverySurfaceThatHoldsANode) {
    FixedField fixed{NodeLayout(2, 2)};
    constexpr int most = 4 + static_cast<int>(most_parts);
    for (int surface = 0; surface < most; surface += 3)
        fixed.hold(surface, 1, 20);
    fixed.hold(FixedField::symmetry, 1, 20);
    for (int surface = 0; surface < most; ++surface)
        EXPECT_EQ(fixed.held_by(surface, 1, 20), surface % 3 == 0) << surface;
    EXPECT_TRUE(fixed.held_by(FixedField::symmetry, 1, 20));
    EXPECT_FALSE(fixed.held_by(0, 0, 20));
    EXPECT_EQ(fixed.count(), 1);
}

} // namespace
} // namespace gault::core::test
