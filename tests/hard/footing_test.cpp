// A rough rigid strip on soil without friction: Prandtl (1920), q = (2 + pi) s_u.
#include "tests/hard/hard_scene.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

namespace gault::core::test {
namespace {

// Load over strength and width: n cells along each metre.
double bearing_capacity(int n, const char* basis, const std::vector<Override>& more = {}) {
    std::vector<Override> all{{"grid", "{cells: " + cells(2 * n, n) + ", basis: " + basis + "}"}};
    all.insert(all.end(), more.begin(), more.end());
    HardScene s("hard/footing", all);
    const double load = s.run().last("normal_force") / (20e3 * 0.5);
    std::printf("%-9s %2d cells a metre, volume %s: %.4f, exact %.4f\n", basis, n,
                s.scene.volumetric_strain == VolumetricStrain::cell_mean ? "of cells " : "of points", load,
                2.0 + std::numbers::pi);
    return load;
}

const Override of_points{"model.volumetric_strain", "pointwise"};

// The soil beside the footing begins to move within a cell, so it is wider by a share of one: of first order.
TEST(Footing, CarriesPrandtlsLoadWithTheVolumeOfCells) {
    const double prandtl = 2.0 + std::numbers::pi;
    EXPECT_NEAR(2.0 * bearing_capacity(16, "quadratic") - bearing_capacity(8, "quadratic"), prandtl,
                0.025 * prandtl);
    EXPECT_NEAR(bearing_capacity(16, "linear"), prandtl, 0.1 * prandtl); // of lower order
}

TEST(Footing, LocksWithTheVolumeOfPoints) {
    EXPECT_GT(bearing_capacity(8, "quadratic", {of_points}), 9.0);
    EXPECT_GT(bearing_capacity(8, "linear", {of_points}), 1000.0);
}

} // namespace
} // namespace gault::core::test
