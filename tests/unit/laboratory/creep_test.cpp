// A Burgers soil in tests that take time.
#include "tests/unit/laboratory/element.hpp"

namespace gault::core::test {
namespace {

constexpr double E = 25e9, nu = 0.25, G = E / (2 * (1 + nu)), K = E / (3 * (1 - 2 * nu));
constexpr double eta = 1e17, G_K = 5e9, eta_K = 1e16, q = 8e6; // Pa, Pa s
const std::string maxwell =
    "{model: viscoelastic, young_modulus: 25 GPa, poisson_ratio: 0.25, viscosity: 1e17 Pa s";
const std::string burgers = maxwell + ", delayed_shear_modulus: 5 GPa, delayed_viscosity: 1e16 Pa s}";
const std::string isotropic = "{isotropic: 10 MPa}";

double J(double t) {
    return 1 / G + t / eta - std::expm1(-t * G_K / eta_K) / G_K;
}

// Strain is straight within a step, that of the Kelvin element is not: its error is (dt/T)^2/12 of it at most.
TEST(Creep, UnderAHeldStressGoesWithTheCreepFunction) {
    constexpr double T = eta_K / G_K, held = 3 * T; // s
    const Table t = carried_out(burgers, isotropic,
                                "triaxial: {deviator_stress: 8 MPa, duration: 1 us, steps: 1},"
                                "triaxial: {deviator_stress: 8 MPa, duration: " +
                                    std::to_string(held) + " s, steps: 300}");
    const auto time = t.column("time"), axial = t.column("strain_yy"), lateral = t.column("strain_xx");
    const double error = std::pow(held / 300 / T, 2) / 12;
    for (std::size_t row = 1; row < time.size(); ++row) {
        EXPECT_NEAR(axial[row], q / (9 * K) + q / 3 * J(time[row]), error * q / 3 / G_K);
        EXPECT_NEAR(lateral[row], q / (9 * K) - q / 6 * J(time[row]), error * q / 3 / G_K);
    }
    EXPECT_NEAR(time.back(), held, 1e-9 * held);
    EXPECT_NEAR(t.end("deviator_stress"), q, 1e-9 * q);
}

// A Maxwell soil flows steadily under a held stress: exact in one step.
TEST(Creep, OfAMaxwellSoilUnderAHeldShearStressIsSteady) {
    const Table t = carried_out(
        maxwell + "}", isotropic,
        "simple_shear: {shear_stress: 2 MPa, duration: 1 us, steps: 1},"
        "mixed: {strain: {xx: held, zz: held}, stress: {yy: held, xy: held}, duration: 100 d, steps: 1}");
    EXPECT_NEAR(2 * t.at_end_of(1, "strain_xy"), 2e6 / G, 1e-9 * 2e6 / G);
    EXPECT_NEAR(2 * t.end("strain_xy"), 2e6 * (1 / G + 8.64e6 / eta), 1e-9 * 2e6 / G);
}

TEST(Creep, AtAHeldStrainIsRelaxation) {
    const Table t =
        carried_out(maxwell + "}", isotropic,
                    "mixed: {strain: {xx: -0.01 %, yy: 0.02 %, zz: -0.01 %}, duration: 1 us, steps: 1},"
                    "mixed: {strain: {xx: held, yy: held, zz: held}, duration: 1e7 s, steps: 7}");
    const auto time = t.column("time"), stress = t.column("deviator_stress");
    for (std::size_t row = 1; row < time.size(); ++row)
        EXPECT_NEAR(stress[row], 3 * G * 2e-4 * std::exp(-time[row] * G / eta), 1e-9 * G * 2e-4) << row;
    EXPECT_NEAR(t.end("mean_stress"), 10e6, 1e-3);
}

} // namespace
} // namespace gault::core::test
