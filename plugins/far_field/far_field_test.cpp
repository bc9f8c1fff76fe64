#include "plugin_fixture.hpp"

#include <gtest/gtest.h>

namespace {
using namespace plugin_test;

constexpr double shear = 4e6, start = 0.28; // Pa, m

// One point of a cylinder's outside, and what the far field does there.
struct Rim {
    Component c{"far_field", GAULT_BOUNDARY, "far_field", {}};
    alignas(64) double position[3][8] = {}, normal[3][8] = {},
                       displacement[3][8] = {}, velocity[3][8] = {}, initial[3][8] = {}, traction[3][8] = {},
                       slope[9][8] = {}, impedance[2][8] = {}, modulus[8] = {}, pressure[8] = {};

    explicit Rim(double u) {
        position[0][0] = start + u;
        displacement[0][0] = u;
        normal[0][0] = 1.0;
        initial[0][0] = -90e3;
        modulus[0] = shear;
        impedance[0][0] = 4e5;
        impedance[1][0] = 2e5;
    }
    double load() {
        gault_facets f{};
        f.size = sizeof f;
        f.count = 1;
        f.padded = 8;
        for (int k = 0; k < 3; ++k) {
            f.position[k] = position[k];
            f.normal[k] = normal[k];
            f.displacement[k] = displacement[k];
            f.velocity[k] = velocity[k];
            f.initial_traction[k] = initial[k];
            f.traction[k] = traction[k];
        }
        for (int k = 0; k < 9; ++k)
            f.slope[k] = slope[k];
        f.impedance[0] = impedance[0];
        f.impedance[1] = impedance[1];
        f.shear_modulus = modulus;
        f.pressure = pressure;
        gault_error error{};
        EXPECT_EQ(c.api<gault_boundary_api>().load(c.self(), &f, &error), GAULT_OK) << error.text;
        return traction[0][0];
    }
};

TEST(FarField, KeepsTheInitialTractionAtRest) {
    Rim rim(0.0);
    EXPECT_EQ(rim.load(), -90e3);
    EXPECT_EQ(rim.traction[1][0], 0.0);
    EXPECT_EQ(rim.pressure[0], 0.0);
}

// An incompressible elastic soil in plane strain at finite strain: p = p0 + G Li2(x), x = 1 - (r0 / r)^2.
TEST(FarField, AnswersAsTheInfiniteSoil) {
    for (const double u : {1e-5, 1e-3, -1e-3}) {
        Rim rim(u);
        const double r = start + u, x = 1.0 - start * start / (r * r);
        const double exact = shear * (x + x * x / 4.0 + x * x * x / 9.0);
        EXPECT_NEAR(rim.load(), -90e3 - exact, 2e-2 * shear * std::abs(x * x * x) + 1e-6);
    }
}

TEST(FarField, GivesItsSlope) {
    const double u = 2e-3, h = 1e-6;
    Rim rim(u), more(u + h), less(u - h);
    rim.load();
    EXPECT_NEAR(rim.slope[0][0], -(more.load() - less.load()) / (2.0 * h), 1e-5 * shear);
    for (int k = 1; k < 9; ++k)
        EXPECT_EQ(rim.slope[k][0], 0.0);
}

TEST(FarField, TakesWavesWithTheImpedances) {
    Rim rim(0.0);
    rim.velocity[0][0] = 0.1;
    rim.velocity[1][0] = -0.2;
    EXPECT_NEAR(rim.load(), -90e3 - 4e5 * 0.1, 1e-9);
    EXPECT_NEAR(rim.traction[1][0], 2e5 * 0.2, 1e-9);
}

} // namespace
