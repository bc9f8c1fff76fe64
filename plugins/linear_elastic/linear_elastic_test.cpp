#include "plugin_fixture.hpp"

#include <gtest/gtest.h>

#include <random>

namespace {
using namespace plugin_test;

Component soil(double young_modulus, double poisson_ratio, const std::string& variant = "") {
    return {"linear_elastic",
            GAULT_MATERIAL,
            "linear_elastic",
            {{"young_modulus", young_modulus}, {"poisson_ratio", poisson_ratio}},
            variant};
}

TEST(LinearElastic, StretchesUniaxiallyWithYoungsModulusAndPoissonsRatio) {
    const Component c = soil(70e6, 0.3);
    Batch b(c, 3);
    b.set_strain(1, {1e-3, -0.3e-3, -0.3e-3, 0.0, 0.0, 0.0});
    b.set_stress_old(1, {1e3, 2e3, 3e3, 4e3, 5e3, 6e3});
    ASSERT_EQ(b.update(), GAULT_OK);
    const Tensor expected{71e3, 2e3, 3e3, 4e3, 5e3, 6e3};
    for (int i = 0; i < 6; ++i)
        EXPECT_NEAR(b.stress_at(1)[i], expected[i], 1e-9) << i;
}

TEST(LinearElastic, ShearsByTwiceTheShearModulusTimesTensorShear) {
    const Component c = soil(26e6, 0.3);
    Batch b(c, 1);
    b.set_strain(0, {0.0, 0.0, 0.0, 1e-3, 2e-3, 3e-3});
    ASSERT_EQ(b.update(), GAULT_OK);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(b.stress_at(0)[i + 3], 2.0 * 10e6 * (i + 1) * 1e-3, 1e-9);
        EXPECT_EQ(b.stress_at(0)[i], 0.0);
    }
}

TEST(LinearElastic, StatesTheModuliThatWavesTravelWith) {
    const Component c = soil(100e6, 0.25);
    Batch b(c, 9);
    ASSERT_EQ(b.update(), GAULT_OK);
    for (int64_t i = 0; i < b.count(); ++i) {
        EXPECT_DOUBLE_EQ(b.shear_modulus[i], 40e6);
        EXPECT_DOUBLE_EQ(b.modulus[i], 120e6);
    }
}

TEST(LinearElastic, HasTheTangentThatItsUpdateFollows) {
    const Component c = soil(100e6, -0.4);
    for (int column = 0; column < 6; ++column) {
        Batch b(c, 1, true);
        b.strain[column][0] = 1e-3;
        ASSERT_EQ(b.update(), GAULT_OK);
        for (int row = 0; row < 6; ++row)
            EXPECT_NEAR(b.tangent[6 * row + column][0] * 1e-3, b.stress[row][0], 1e-9) << row << column;
    }
}

TEST(LinearElastic, GivesTheSameBitsOnEveryProcessor) {
    std::vector<Tensor> first;
    for (const std::string& variant : variants()) {
        const Component c = soil(123e6, 0.37, variant);
        Batch b(c, 37);
        std::mt19937_64 random(1);
        std::uniform_real_distribution<double> uniform(-1.0, 1.0);
        for (int64_t i = 0; i < b.count(); ++i)
            for (int k = 0; k < 6; ++k)
                b.strain[k][i] = 1e-3 * uniform(random), b.stress_old[k][i] = 1e5 * uniform(random);
        ASSERT_EQ(b.update(), GAULT_OK);
        std::vector<Tensor> result;
        for (int64_t i = 0; i < b.count(); ++i)
            result.push_back(b.stress_at(i));
        if (first.empty()) first = result;
        EXPECT_EQ(result, first) << variant;
    }
}

} // namespace
