// Soil whose water can neither leave nor enter (materials.NAME.pore_water), against closed forms of total stress and
// pore pressure.
#include "core/scheduler/palmer.hpp"
#include "tests/hard/ways.hpp"

#include <cmath>

namespace gault::core::test {
namespace {

constexpr double su = 50e3, p0 = 100e3, u0 = 40e3; // Pa

class Undrained : public EveryWay {};

// Of the load, water and skeleton bear their shares of the stiffness: Kw / n and the constrained modulus.
TEST_P(Undrained, SharesTheLoadOfABlockThatCannotWiden) {
    constexpr double pressure = 100.0, E = 100e6, nu = 0.3, water = 2.2e9 / 0.4;
    constexpr double constrained = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
    HardScene s("hard/uniaxial_compression",
                with({{"materials.soil.pore_water", "{bulk_modulus: 2.2 GPa, porosity: 40 %}"}}));
    s.run();
    const double skeleton = pressure * constrained / (constrained + water);
    expect_near("settlement (m)", s.last("displacement"), 2.0 * pressure / (constrained + water), 1e-5);
    const PointArrays p = s.points();
    const std::vector<double> u = collect_state(s.solver.motion(), "excess_pore_pressure");
    for (std::size_t i = 0; i < u.size(); ++i) {
        EXPECT_NEAR(u[i], pressure - skeleton, 1e-3 * pressure);
        EXPECT_NEAR(-p.stress[0][i] - u[i], skeleton * nu / (1 - nu), 1e-3 * pressure); // effective, lateral
    }
}

// Elastic soil of constant volume: Palmer's integral, and in a skeleton whose mean effective stress stays, water bears
// all change of the mean total stress, which is (sigma_r + sigma_theta) / 2 in the plane strain of such a soil.
TEST_P(Undrained, CavityInClayHasTheExactPressureAndPorePressure) {
    const std::vector<Override> clay =
        with({{"materials.clay",
               fmt::format("{{model: mohr_coulomb, density: 1900 kg/m^3, young_modulus: 12.5 MPa, "
                           "poisson_ratio: 0.25, cohesion: {} Pa, friction_angle: 0 deg, "
                           "dilation_angle: 0 deg, pore_water: {{bulk_modulus: 2.2 GPa, porosity: 45 %, "
                           "initial_pressure: {} Pa}}}}",
                           su, u0)}});
    HardScene s("hard/clay_cavity", clay);
    s.run();
    const PalmerSolution exact(s.scene, 0.1);
    expect_near("p(10 %) (kPa)", s.last("true_pressure") / 1e3, 282.34, has_inertia() ? 5e-3 : 1e-3);
    const PalmerSolution::Profile wall = exact.profile(0.1, 4000);
    const double cell =
        s.simulation.model().grid.axis(0).length()[0]; // the points lie half of it inside; du/dr = -2 su / r
    const double beside =
        0.5 * (wall.sigma_r[0] + wall.sigma_theta[0]) - p0 - 2.0 * su * cell / (2.0 * 0.022);
    if (!updated())
        expect_near("u beside the wall (kPa)", s.last("excess_pore_pressure") / 1e3, beside / 1e3, 2e-3);
    if (updated()) return; // stresses of nearly incompressible soil are not to be had in that frame
    const PalmerSolution::Profile profile = exact.profile(0.1, 4000);
    const PointArrays p = s.points();
    const std::vector<double> u = collect_state(s.solver.motion(), "excess_pore_pressure");
    double error = 0.0, size = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) {
        const double r0 = p.reference[0][i];
        const auto k = static_cast<std::size_t>(
            std::lower_bound(profile.radius.begin(), profile.radius.end(), r0) - profile.radius.begin());
        const double expected = 0.5 * (profile.sigma_r[k] + profile.sigma_theta[k]) - p0;
        error += p.volume[i] * std::pow(u[i] - expected, 2);
        size += p.volume[i] * expected * expected;
    }
    expect_below("L2 error of the pore pressure", std::sqrt(error / size), 0.01);
}

// The model's start() sees the effective stress.
TEST_P(Undrained, ModelStartsFromTheEffectiveStress) {
    const HardScene s("hard/clay_cavity",
                      with({{"materials.clay",
                             "{model: modified_cam_clay, density: 1900 kg/m^3, critical_state_ratio: 1.2, "
                             "compression_index: 0.15, swelling_index: 0.03, poisson_ratio: 0.278, "
                             "critical_state_volume: 2.74, overconsolidation_ratio: 3, pore_water: "
                             "{initial_pressure: 40 kPa}}"}}));
    for (const double p : collect_state(s.solver.motion(), "preconsolidation_pressure"))
        EXPECT_NEAR(p, 3.0 * (p0 - u0), 1e-6 * p0);
}

INSTANTIATE_TEST_SUITE_P(Ways, Undrained, every_way(), name_of_way);

} // namespace
} // namespace gault::core::test
