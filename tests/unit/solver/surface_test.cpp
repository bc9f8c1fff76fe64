#include "tests/unit/solver/small_scene.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace gault::core::test {
namespace {

constexpr double pi = std::numbers::pi, a = 0.2, b = 1.2, height = 0.7;

class EverySurface : public testing::TestWithParam<Basis> {
  protected:
    TestMaterial soil{40e6, 30e6};
    Shape shape(Symmetry symmetry, Frame frame = Frame::total) const {
        Shape form;
        form.symmetry = symmetry;
        form.frame = frame;
        form.basis = GetParam();
        form.lower = {a, 0.0};
        form.upper = {b, height};
        return form;
    }
};

TEST_P(EverySurface, OfARingHasItsAreaRadiusAndVolume) {
    SmallScene s(shape(Symmetry::axisymmetric));
    s.add(soil, 1600.0);
    Body body(s.scene);
    const Surface inner(*body.motion, low_x), outer(*body.motion, high_x), bottom(*body.motion, low_y);
    EXPECT_NEAR(inner.projected_area(), 2 * pi * a * height, 1e-13);
    EXPECT_NEAR(outer.projected_area(), 2 * pi * b * height, 1e-13);
    EXPECT_NEAR(bottom.projected_area(), pi * (b * b - a * a), 1e-13);
    EXPECT_NEAR(inner.mean_radius(), a, 1e-14);
    EXPECT_NEAR(inner.enclosed_volume(), pi * a * a * height, 1e-14);
    EXPECT_EQ(inner.mean_displacement(), 0.0);
}

TEST_P(EverySurface, FollowsTheMotionOfTheWall) {
    for (const Frame frame : {Frame::total, Frame::updated}) {
        SmallScene s(shape(Symmetry::axisymmetric, frame));
        s.add(soil, 1600.0);
        Body body(s.scene);
        Surface inner(*body.motion, low_x), bottom(*body.motion, low_y);
        body.motion->deform(body.field([](double x, double y) {
            return std::array{0.05 * x, -0.02 * y};
        }),
                            {1.0, 1.0});
        inner.refresh(*body.motion);
        bottom.refresh(*body.motion);
        EXPECT_NEAR(inner.mean_radius(), 1.05 * a, 1e-14);
        EXPECT_NEAR(inner.mean_displacement(), 0.05 * a, 1e-14); // into the soil
        EXPECT_NEAR(inner.projected_area(), 2 * pi * 1.05 * a * 0.98 * height, 1e-13);
        EXPECT_NEAR(inner.enclosed_volume(), pi * 1.05 * a * 1.05 * a * 0.98 * height, 1e-14);
        EXPECT_NEAR(bottom.projected_area(), 1.05 * 1.05 * pi * (b * b - a * a), 1e-13);
        EXPECT_NEAR(inner.position(0)[0], 1.05 * inner.reference(0)[0], 1e-14);
    }
}

TEST_P(EverySurface, PointsOutOfTheSoil) {
    SmallScene s(shape(Symmetry::plane_strain));
    s.add(soil, 1600.0);
    Body body(s.scene);
    for (const int side : {low_x, high_x, low_y, high_y}) {
        const Surface surface(*body.motion, side);
        for (std::size_t q = 0; q < surface.size(); ++q) {
            EXPECT_GT(outward(side) * surface.area(q)[normal_axis(side)], 0.0);
            EXPECT_NEAR(surface.area(q)[1 - normal_axis(side)], 0.0, 1e-15);
        }
    }
}

// however the body is bent
TEST_P(EverySurface, AreasOfAClosedBoundaryCancel) {
    for (const Symmetry symmetry : {Symmetry::plane_strain, Symmetry::axisymmetric}) {
        SmallScene s(shape(symmetry));
        s.add(soil, 1600.0);
        Body body(s.scene);
        body.motion->deform(body.field([](double x, double y) {
            return std::array{0.008 * std::sin(7 * x + 3 * y), 0.008 * std::cos(5 * x - 2 * y)};
        }),
                            {1.0, 1.0});
        std::array<double, 2> sum{};
        VectorField force(body.layout());
        for (const int side : {low_x, high_x, low_y, high_y}) {
            const Surface surface(*body.motion, side);
            for (std::size_t q = 0; q < surface.size(); ++q) {
                surface.add_force(force, q, surface.area(q));
                for (int k = 0; k < 2; ++k)
                    sum[k] += surface.area(q)[k];
            }
        }
        EXPECT_NEAR(symmetry == Symmetry::plane_strain ? sum[0] : 0.0, 0.0, 1e-14);
        EXPECT_NEAR(sum[1], 0.0, 1e-14);
        double nodal = 0.0;
        for (const double f : force.c[1])
            nodal += f;
        EXPECT_NEAR(nodal, sum[1], 1e-14) << "nodal forces are the same force";
    }
}

TEST_P(EverySurface, UnderPressureIsPushedWithPressureTimesArea) {
    SmallScene s(shape(Symmetry::axisymmetric));
    s.add(soil, 1600.0);
    s.press({low_x}, 50e3);
    Body body(s.scene);
    Boundaries boundaries(s.scene, *body.motion, body.model.behind(s.scene));
    VectorField none(body.layout()), force(none);
    const auto radial = [&] {
        boundaries.load(*body.motion, 0.0, 1.0, none, force);
        double total = 0.0;
        for (const std::size_t n : boundaries.surface(low_x).nodes())
            total += force.c[0][n];
        return total;
    };
    EXPECT_NEAR(radial(), 50e3 * 2 * pi * a * height, 1e-8);
    body.motion->deform(body.field([](double x, double) { return std::array{0.1 * x, 0.0}; }), {1.0, 1.0});
    EXPECT_NEAR(radial(), 50e3 * 2 * pi * 1.1 * a * height, 1e-8);
}

TEST_P(EverySurface, InterpolatesWhatIsLinearExactly) {
    SmallScene s(shape(Symmetry::plane_strain));
    s.add(soil, 1600.0);
    Body body(s.scene);
    const VectorField field = body.field([](double x, double y) { return std::array{x - y, 2.0 + y}; });
    const Surface top(*body.motion, high_y);
    for (std::size_t q = 0; q < top.size(); ++q) {
        EXPECT_NEAR(top.interpolate(field, q)[0], top.position(q)[0] - height, 1e-14);
        EXPECT_NEAR(top.interpolate(field, q)[1], 2.0 + height, 1e-14);
    }
}

INSTANTIATE_TEST_SUITE_P(Bases, EverySurface, testing::Values(Basis::linear, Basis::quadratic),
                         [](const auto& instance) {
                             return instance.param == Basis::linear ? "Linear" : "Quadratic";
                         });

} // namespace
} // namespace gault::core::test
