// The integral of a soil's own path against closed forms of Tresca soil: expansion without bound and in a cylinder.
#include "core/scheduler/palmer.hpp"
#include "tests/hard/hard_scene.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace gault::core::test {
namespace {

constexpr double su = 50e3, G = 5e6, p0 = 100e3;

Scene clay(const std::string& geometry, const std::vector<Override>& more = {}) {
    std::vector<Override> all{
        {"geometry.annulus", geometry},
        {"program", "{type: pressuremeter, on: inner, strain_rate: 1 1/s, until: {cavity_strain: 10 %}}"},
        {"reference.palmer", "{x: cavity_strain, y: true_pressure, range: [1 %, 10 %]}"}};
    all.insert(all.end(), more.begin(), more.end());
    return scene_of("field/menard", all);
}

double dilogarithm(double x) {
    double sum = 0.0, power = 1.0;
    for (int k = 1; k < 4000; ++k)
        sum += (power *= x) / (static_cast<double>(k) * k);
    return sum;
}

TEST(Palmer, WithoutBoundIsTheExactExpansionOfClay) {
    const PalmerSolution exact(clay("{inner_radius: 20 mm, outer_radius: auto, height: 1 m}"), 4.0);
    const double q = 1.0 - std::exp(-su / G);
    for (const double strain : {0.02, 0.1, 0.5, 1.0, 4.0}) {
        const double stretch = std::pow(1.0 + strain, 2), kk = 1.0 - 1.0 / stretch; // (a^2 - a0^2) / a^2
        const double expected = p0 + su * std::log(kk / q) + G * dilogarithm(q);
        EXPECT_NEAR(exact.pressure(strain), expected, 1e-5 * expected) << strain;
    }
}

TEST(Palmer, InACylinderFallsOnceAllOfItYields) {
    const Scene scene = clay("{inner_radius: 20 mm, outer_radius: 200 mm, height: 1 m}",
                             {{"boundaries.2", "{on: outer, type: pressure, value: 100 kPa}"}});
    const PalmerSolution exact(scene, 3.0);
    for (const auto& [strain, kilopascals] :
         {std::pair{0.01, 183.03}, {0.05, 256.49}, {0.1, 282.34}, {1.0, 262.42}, {3.0, 198.62}})
        EXPECT_NEAR(exact.pressure(strain) / 1e3, kilopascals, 5e-5 * kilopascals) << strain;
    const PalmerSolution::Profile profile = exact.profile(0.1, 100);
    EXPECT_NEAR(profile.sigma_r.front(), exact.pressure(0.1), 1.0);
    EXPECT_NEAR(profile.sigma_r.back(), p0, 1.0);
    EXPECT_NEAR(profile.sigma_r.front() - profile.sigma_theta.front(), 2.0 * su, 1e-3 * su);
}

TEST(Palmer, IsRefusedWhereItDoesNotHold) {
    const auto refusal = [](const std::vector<Override>& changes) -> std::string {
        try {
            PalmerSolution(clay("{inner_radius: 20 mm, outer_radius: 200 mm, height: 1 m}", changes), 0.1);
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_NE(refusal({{"initial.stress", "{vertical: 100 kPa, k0: 0.5}"}}).find("isotropic"),
              std::string::npos);
    EXPECT_NE(
        refusal({{"materials.clay",
                  "{model: viscoelastic, density: 1900 kg/m^3, young_modulus: 15 MPa, poisson_ratio: 0.4999, "
                  "viscosity: 1e12 Pa.s}"}})
            .find("rate"),
        std::string::npos);
}

} // namespace
} // namespace gault::core::test
