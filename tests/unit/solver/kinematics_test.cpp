#include "tests/unit/solver/small_scene.hpp"
#include "tests/unit/transfer/plain.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <tuple>

namespace gault::core::test {
namespace {

constexpr double lame = 40e6, shear = 30e6, pi = std::numbers::pi;

class EveryBody : public testing::TestWithParam<std::tuple<Symmetry, Frame, Basis>> {
  protected:
    Shape shape(double inner = 0.0) const {
        Shape s;
        std::tie(s.symmetry, s.frame, s.basis) = GetParam();
        s.lower = {inner, -0.4};
        s.upper = {inner + 1.1, 0.7};
        return s;
    }
    bool ring() const { return std::get<0>(GetParam()) == Symmetry::axisymmetric; }
    double axis() const { return ring() ? 0.0 : 0.3; } // where the body begins
};

// u = H X, with u_x = h_xx r in a ring, so that hoop and radial strain are equal
TEST_P(EveryBody, StrainsUniformlyUnderAnAffineDisplacement) {
    const double h[2][2] = {{2e-3, ring() ? 0.0 : 3e-3}, {-1e-3, 4e-3}};
    TestMaterial soil(lame, shear);
    SmallScene s(shape(axis()));
    s.add(soil, 1600.0);
    Body body(s.scene);
    const VectorField v = body.field([&](double x, double y) {
        return std::array{h[0][0] * x + h[0][1] * y, h[1][0] * x + h[1][1] * y};
    });
    body.motion->deform(v, {1.0, 1.0});

    const plain::Matrix f{
        {{1 + h[0][0], h[0][1], 0}, {h[1][0], 1 + h[1][1], 0}, {0, 0, ring() ? 1 + h[0][0] : 1.0}}};
    const auto strain = plain::step(plain::identity(), f, {}, true).strain;
    double expected[4];
    for (int k = 0; k < 4; ++k)
        expected[k] = (k < 3 ? lame * (strain[0] + strain[1] + strain[2]) : 0.0) + 2.0 * shear * strain[k];
    double volume = 0.0;
    body.each_point([&](PointColumns& c, std::size_t slot, const PointRecord& r) {
        for (int k = 0; k < 4; ++k)
            ASSERT_NEAR(c.stress[k][slot], expected[k], 1e-11 * lame) << k;
        volume += r.volume;
    });
    const double whole = 1.1 * 1.1 * (ring() ? pi * 1.1 : 1.0);
    EXPECT_NEAR(volume, whole * plain::determinant(f), 1e-13 * whole);
}

// sigma_rr = sigma_theta: the divergence of the stress vanishes, hoop term and axis included
TEST_P(EveryBody, IsInEquilibriumUnderAConstantStress) {
    for (const Placement placement : {Placement::gauss, Placement::uniform}) {
        TestMaterial soil(lame, shear);
        Shape form = shape(axis());
        form.placement = placement;
        SmallScene s(form);
        s.add(soil, 1600.0);
        s.scene.initial_stress.vertical = 80e3;
        s.scene.initial_stress.k0 = 1.5; // 120 kPa along x and z
        Body body(s.scene);
        VectorField internal(body.layout());
        body.motion->forces(internal);
        for (int j = 0; j < body.layout().ny; ++j)
            for (int i = 0; i < body.layout().nx; ++i) {
                const std::size_t n = body.layout().index(i, j);
                const bool side = i == body.layout().nx - 1 || (i == 0 && !ring());
                const bool end = j == 0 || j == body.layout().ny - 1;
                EXPECT_NEAR(side ? 0.0 : internal.c[0][n], 0.0, 1e-9) << i << ' ' << j;
                EXPECT_NEAR(end ? 0.0 : internal.c[1][n], 0.0, 1e-9) << i << ' ' << j;
            }
    }
}

// A pressure on every side balances the same stress inside, node by node, in any shape.
TEST_P(EveryBody, IsHeldByThePressureThatItIsUnder) {
    TestMaterial soil(0.0, 0.0); // the stress stays
    soil.update = [&](gault_points& p, gault_error&) {
        for (int k = 0; k < 6; ++k)
            for (int64_t i = 0; i < p.count; ++i)
                p.stress[k][i] = k < 3 ? -90e3 : 0.0;
        if (p.modulus) std::fill_n(p.modulus, p.count, 1e6), std::fill_n(p.shear_modulus, p.count, 1e5);
        return gault_status(GAULT_OK);
    };
    SmallScene s(shape(axis()));
    s.add(soil, 1600.0);
    s.press(ring() ? std::vector{1, 2, 3} : std::vector{0, 1, 2, 3}, 90e3);
    s.scene.initial_stress.vertical = 90e3;
    Body body(s.scene);
    Boundaries boundaries(s.scene, *body.motion, [](auto&) { return SoilBehind{}; });
    if (std::get<1>(GetParam()) == Frame::total) // bent; the updated frame keeps its walls straight
        body.motion->deform(body.field([](double x, double y) {
            return std::array{0.03 * x * (y + x), 0.05 * x * y};
        }),
                            {1.0, 1.0});
    VectorField internal(body.layout()), external(internal);
    body.motion->forces(internal);
    boundaries.load(*body.motion, 0.0, 1.0, internal, external);
    for (int k = 0; k < 2; ++k)
        for (std::size_t n = 0; n < body.layout().size; ++n)
            EXPECT_NEAR(internal.c[k][n] + external.c[k][n], 0.0, 1e-8) << k << ' ' << n;
}

INSTANTIATE_TEST_SUITE_P(Bodies, EveryBody,
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
