#include "laboratory.hpp"

#include <gtest/gtest.h>

#include <random>

namespace {
using namespace plugin_test;

constexpr double young_modulus = 100e6, poisson_ratio = 0.25, cohesion = 5e3; // Pa, 1, Pa
constexpr double shear = young_modulus / (2.0 * (1.0 + poisson_ratio));
constexpr double bulk = young_modulus / (3.0 * (1.0 - 2.0 * poisson_ratio));
constexpr double friction = 35.0 * degree, dilation = 10.0 * degree;

Component soil(const std::string& variant = "") {
    return {"drucker_prager",
            GAULT_MATERIAL,
            "drucker_prager",
            {{"young_modulus", young_modulus},
             {"poisson_ratio", poisson_ratio},
             {"cohesion", cohesion},
             {"friction_angle", friction},
             {"dilation_angle", dilation}},
            variant};
}

double mean(const Tensor& s) {
    return (s[0] + s[1] + s[2]) / 3.0;
}
double root_j2(const Tensor& s) {
    const double p = mean(s);
    double sum = 0.0;
    for (int i = 0; i < 3; ++i)
        sum += 0.5 * (s[i] - p) * (s[i] - p) + s[i + 3] * s[i + 3];
    return std::sqrt(sum);
}
double slope(double angle) {
    return 6.0 * std::sin(angle) / (std::sqrt(3.0) * (3.0 - std::sin(angle)));
}
double yield(const Tensor& s) {
    return root_j2(s) + slope(friction) * (mean(s) - cohesion / std::tan(friction));
}

// Random strains of up to 1 % from hydrostatic compression: the cone, its apex and the inside are all met.
void fill_at_random(Batch& b) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int64_t i = 0; i < b.count(); ++i) {
        const double size = 1e-2 * std::pow(10.0, -4.0 * std::abs(uniform(random)));
        const double pressure = 1e5 * (1.0 + uniform(random));
        Tensor strain;
        for (double& e : strain)
            e = size * uniform(random);
        b.set_strain(i, strain);
        b.set_stress_old(i, {-pressure, -pressure, -pressure, 0.0, 0.0, 0.0});
    }
}

TEST(DruckerPrager, FailsInTriaxialCompressionWhereMohrCoulombDoes) {
    const Component c = soil();
    Laboratory lab(c, {-100e3, -100e3, -100e3, 0.0, 0.0, 0.0});
    for (int step = 0; step < 200; ++step)
        lab.triaxial_drained(-1e-4, -100e3);
    const double ratio = (1.0 + std::sin(friction)) / (1.0 - std::sin(friction));
    const double expected = ratio * 100e3 + 2.0 * cohesion * std::sqrt(ratio);
    EXPECT_NEAR(-lab.stress()[0], expected, 1e-6 * expected);
    EXPECT_NEAR(-lab.stress()[1], 100e3, 1e-6 * expected);
}

TEST(DruckerPrager, NeverLeavesItsCone) {
    const Component c = soil();
    Batch b(c, 4000);
    fill_at_random(b);
    ASSERT_EQ(b.update(), GAULT_OK);
    int inside = 0, on_cone = 0, apex = 0;
    for (int64_t i = 0; i < b.count(); ++i) {
        const Tensor s = b.stress_at(i);
        EXPECT_LE(yield(s), 1e-9 * (1.0 + std::abs(mean(s)))) << i;
        (b.state[0][i] == 0.0 ? inside : root_j2(s) < 1e-6 ? apex : on_cone) += 1;
    }
    EXPECT_GT(inside, 100);
    EXPECT_GT(on_cone, 100);
    EXPECT_GT(apex, 100);
}

TEST(DruckerPrager, ReturnsToTheApexUnderIsotropicExtension) {
    const Component c = soil();
    Batch b(c, 1);
    b.set_strain(0, {1e-2, 1e-2, 1e-2, 0.0, 0.0, 0.0});
    ASSERT_EQ(b.update(), GAULT_OK);
    const double tension = cohesion / std::tan(friction);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(b.stress_at(0)[i], tension, 1e-9 * tension);
        EXPECT_EQ(b.stress_at(0)[i + 3], 0.0);
    }
}

TEST(DruckerPrager, FlowsAsItsDilationAngleSays) {
    const Component c = soil();
    Batch b(c, 1);
    b.set_stress_old(0, {-100e3, -100e3, -100e3, 0.0, 0.0, 0.0});
    b.set_strain(0, {0.0, 0.0, 0.0, 1e-2, 0.0, 0.0}); // far beyond yield
    ASSERT_EQ(b.update(), GAULT_OK);
    const Tensor s = b.stress_at(0);
    const double volumetric = -(mean(s) + 100e3) / bulk; // plastic = total - elastic, and the total is 0
    const double multiplier = 2.0 * 1e-2 - s[3] / shear; // engineering plastic shear: that of sqrt(J2)
    EXPECT_NEAR(volumetric / multiplier, slope(dilation), 1e-9);
    EXPECT_NEAR(b.state[0][0], multiplier / std::sqrt(3.0), 1e-12);
}

TEST(DruckerPrager, RefusesAnInitialStressBeyondItsCone) {
    // Triaxial compression, where it is Mohr-Coulomb: s_1 = N s_3 + 2 c sqrt(N), 56.1115 kPa beside 10 kPa.
    const Component c = soil();
    for (const auto& [along, status] : {std::pair{56.111e3, GAULT_OK}, {56.113e3, GAULT_FAILED}}) {
        Batch b(c, 1);
        b.set_stress_old(0, {-10e3, -along, -10e3, 0.0, 0.0, 0.0});
        EXPECT_EQ(b.start(), status);
        const bool said =
            std::string(b.error.text).find("exceeds the Drucker-Prager strength") != std::string::npos;
        EXPECT_EQ(said, status == GAULT_FAILED);
    }
}

TEST(DruckerPrager, GivesTheSameBitsOnEveryProcessor) {
    std::vector<Tensor> first;
    for (const std::string& variant : variants()) {
        const Component c = soil(variant);
        Batch b(c, 1001);
        fill_at_random(b);
        ASSERT_EQ(b.update(), GAULT_OK);
        std::vector<Tensor> result;
        for (int64_t i = 0; i < b.count(); ++i)
            result.push_back(b.stress_at(i));
        if (first.empty()) first = result;
        EXPECT_EQ(result, first) << variant;
    }
}

} // namespace
