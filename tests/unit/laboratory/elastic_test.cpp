// Linear elasticity in every kind of test, against closed forms. What the constraints leave, 1e-9 of a step, and
// rounding, 1e-15 of the stiffness a step, are the tolerances: below 1e-8 of every result.
#include "tests/unit/laboratory/element.hpp"

namespace gault::core::test {
namespace {

constexpr double E = 10e6, nu = 0.3, G = E / (2 * (1 + nu)), K = E / (3 * (1 - 2 * nu));
constexpr double lame = K - 2 * G / 3, p0 = 100e3; // Pa
const std::string soil = "{model: linear_elastic, young_modulus: 10 MPa, poisson_ratio: 0.3}";
const std::string isotropic = "{isotropic: 100 kPa}";

void expect_close(double found, double expected, double scale = 0.0) {
    EXPECT_NEAR(found, expected, 1e-8 * std::max(std::abs(expected), scale));
}

Table elastic(const std::string& stages, const std::string& stress = isotropic) {
    Table table = carried_out(soil, stress, stages);
    EXPECT_EQ(table.failure, "");
    return table;
}

TEST(LinearElasticity, HasItsBulkModulusInIsotropicCompression) {
    const Table t = elastic("isotropic: {stress: 300 kPa}, isotropic: {volumetric_strain: -1 %}");
    expect_close(t.at_end_of(1, "volumetric_strain"), 200e3 / K);
    expect_close(t.end("mean_stress"), 300e3 - 0.01 * K);
    expect_close(t.end("deviator_stress"), 0.0, p0);
}

TEST(LinearElasticity, HasYoungsModulusAndPoissonsRatioInTriaxialCompression) {
    const Table t = elastic("triaxial: {axial_strain: 2 %}");
    expect_close(t.end("stress_yy"), p0 + 0.02 * E);
    expect_close(t.end("strain_xx"), -0.02 * nu);
    expect_close(t.end("strain_zz"), -0.02 * nu);
    expect_close(t.end("stress_xx"), p0);
    expect_close(t.end("deviator_stress"), 0.02 * E);
    expect_close(t.end("volumetric_strain"), 0.02 * (1 - 2 * nu));
    expect_close(t.end("deviatoric_strain"), 0.02 * 2 * (1 + nu) / 3);
}

TEST(LinearElasticity, TakesStressInTriaxialTestsInEveryWayOfWritingIt) {
    const Table t = elastic("triaxial: {axial_stress: 160 kPa}, triaxial: {deviator_stress: -30 kPa},"
                            "triaxial: {deviator_stress: 20 kPa, radial_stress: 250 kPa}");
    expect_close(t.at_end_of(1, "strain_yy"), 60e3 / E);
    expect_close(t.at_end_of(2, "stress_yy"), p0 - 30e3);
    expect_close(t.at_end_of(2, "deviator_stress"), 30e3);
    expect_close(t.end("stress_xx"), 250e3);
    expect_close(t.end("stress_yy"), 270e3);
    expect_close(t.end("strain_yy"), (170e3 - 2 * nu * 150e3) / E);
}

TEST(LinearElasticity, KeepsLateralOverAxialStressInAnOedometer) {
    const Table t = elastic("oedometer: {axial_stress: 400 kPa}, oedometer: {axial_strain: -1 %}");
    expect_close(t.at_end_of(1, "strain_yy"), 300e3 / (K + 4 * G / 3));
    expect_close((t.at_end_of(1, "stress_xx") - p0) / 300e3, nu / (1 - nu));
    expect_close(t.end("stress_yy"), 400e3 - 0.01 * (K + 4 * G / 3));
    expect_close(t.end("strain_xx"), 0.0, 0.01);
}

TEST(LinearElasticity, IsStifferInPlaneStrain) {
    const Table t = elastic("plane_strain: {axial_strain: 2 %}");
    expect_close(t.end("stress_yy"), p0 + 0.02 * E / (1 - nu * nu));
    expect_close(t.end("stress_xx"), p0);
    expect_close(t.end("stress_zz"), p0 + nu * 0.02 * E / (1 - nu * nu));
    expect_close(t.end("strain_zz"), 0.0, 0.02);
    expect_close(t.end("strain_xx"), -0.02 * nu / (1 - nu));
    const Table load = elastic("plane_strain: {deviator_stress: 50 kPa}");
    expect_close(load.end("strain_yy"), 50e3 * (1 - nu * nu) / E);
}

TEST(LinearElasticity, HasItsShearModulusInSimpleShearOfEngineeringStrain) {
    const Table t = elastic("simple_shear: {shear_strain: 2 %}, simple_shear: {shear_stress: -10 kPa}",
                            "{yy: 100 kPa, xx: 50 kPa, zz: 50 kPa}");
    expect_close(t.at_end_of(1, "stress_xy"), 0.02 * G);
    expect_close(t.at_end_of(1, "strain_xy"), 0.01); // the tensor's
    expect_close(t.end("strain_xy"), -10e3 / (2 * G));
    expect_close(t.end("stress_yy"), p0);
    expect_close(t.end("stress_xx"), 50e3);
}

TEST(LinearElasticity, KeepsBAndMeanOrMinorStressInATrueTriaxialTest) {
    for (const double b : {0.0, 0.25, 0.5, 1.0}) {
        const std::string given = "true_triaxial: {axial_strain: 1 %, b: " + std::to_string(b);
        const Table mean = elastic(given + "}");
        const double x = mean.end("stress_xx"), y = mean.end("stress_yy"), z = mean.end("stress_zz");
        expect_close(z - x, b * (y - x), p0);
        expect_close(mean.end("mean_stress"), p0);
        expect_close(y - p0, 2 * G * 0.01); // no volume: a deviator
        const Table minor = elastic(given + ", hold: minor_stress}");
        expect_close(minor.end("stress_xx"), p0);
        expect_close(minor.end("stress_yy"), p0 + 0.01 * E / (1 - b * nu));
        expect_close(minor.end("stress_zz"), p0 + b * 0.01 * E / (1 - b * nu));
    }
}

TEST(LinearElasticity, MeetsAnyMixtureOfStrainsAndStresses) {
    const Table t = elastic("mixed: {strain: {zz: 0.5 %, yz: -0.2 %, xy: held},"
                            "stress: {xx: 60 kPa, yy: 240 kPa, zx: 15 kPa}}",
                            "{xx: 90 kPa, yy: 120 kPa, zz: 100 kPa, xy: 20 kPa, yz: -10 kPa, zx: 5 kPa}");
    expect_close(t.end("stress_xx"), 60e3);
    expect_close(t.end("stress_yy"), 240e3);
    expect_close(t.end("stress_zx"), 15e3);
    expect_close(t.end("strain_zx"), 10e3 / (2 * G));
    expect_close(t.end("stress_xy"), 20e3);
    expect_close(t.end("stress_yz"), -10e3 - 0.002 * 2 * G);
    expect_close(t.end("strain_zz"), 0.005);
    // two equations for xx and yy
    const double a = -30e3 - lame * 0.005, b = 120e3 - lame * 0.005, m = lame + 2 * G;
    expect_close(t.end("strain_xx"), (a * m - b * lame) / (m * m - lame * lame));
    expect_close(t.end("strain_yy"), (b * m - a * lame) / (m * m - lame * lame));
    expect_close(t.end("stress_zz"), 100e3 + lame * (t.end("strain_xx") + t.end("strain_yy")) + m * 0.005);
}

TEST(LinearElasticity, KeepsAShearStressThatItWasGivenThroughATriaxialTest) {
    const Table t = elastic("triaxial: {axial_strain: 1 %}",
                            "{xx: 100 kPa, yy: 150 kPa, zz: 120 kPa, xy: 30 kPa, zx: -20 kPa}");
    expect_close(t.end("stress_xy"), 30e3);
    expect_close(t.end("stress_zx"), -20e3);
    expect_close(t.end("stress_zz"), 120e3);
    expect_close(t.end("stress_yy"), 150e3 + 0.01 * E);
    expect_close(t.end("strain_xy"), 0.0, 0.01);
}

// Skempton's A is 1/3 in a triaxial test and 1/2 in plane strain: the mean stress of what is strained stays.
TEST(LinearElasticity, HasSkemptonsPorePressureWhereNoWaterLeaves) {
    const Table t = elastic("triaxial: {axial_strain: 1 %, drainage: undrained},"
                            "triaxial: {deviator_stress: -60 kPa, drainage: undrained}");
    const double q = 0.01 * 3 * G;
    expect_close(t.at_end_of(1, "deviator_stress"), q);
    expect_close(t.at_end_of(1, "pore_pressure"), q / 3);
    expect_close(t.at_end_of(1, "stress_xx") + q / 3, p0); // total
    expect_close(t.at_end_of(1, "mean_stress"), p0);
    expect_close(t.end("pore_pressure"), -20e3);
    expect_close(t.end("volumetric_strain"), 0.0, 0.01);
    expect_close(*t.undrained_strength, q / 2);
    const Table plane = elastic("plane_strain: {axial_strain: 1 %, drainage: undrained}");
    expect_close(plane.end("stress_yy") - plane.end("stress_xx"), 0.01 * 4 * G);
    expect_close(plane.end("pore_pressure"), 0.01 * 2 * G);
    const Table shear = elastic("simple_shear: {shear_stress: 30 kPa, drainage: undrained}");
    expect_close(shear.end("pore_pressure"), 0.0, p0);
    expect_close(*shear.undrained_strength, 30e3);
}

// With e along y and no volume, z - x = b (y - x) makes the strain along x -e (1 + b)/(2 - b).
TEST(LinearElasticity, HoldsATotalStressInATrueTriaxialTestWithoutDrainage) {
    for (const double b : {0.0, 0.5, 1.0}) {
        const std::string given = "true_triaxial: {axial_strain: 1 %, drainage: undrained, b: " + std::to_string(b);
        const double lateral = 2 * G * 0.01 * (1 + b) / (2 - b);
        const Table mean = elastic(given + "}");
        expect_close(mean.end("pore_pressure"), 0.0, p0);
        expect_close(mean.end("stress_xx"), p0 - lateral);
        expect_close(mean.end("volumetric_strain"), 0.0, 0.01);
        const Table minor = elastic(given + ", hold: minor_stress}");
        expect_close(minor.end("stress_xx"), p0 - lateral); // effective
        expect_close(minor.end("pore_pressure"), lateral);
        expect_close(minor.end("stress_zz") - minor.end("stress_xx"),
                     b * (minor.end("stress_yy") - minor.end("stress_xx")), p0);
    }
}

TEST(LinearElasticity, KeepsThePorePressureOfAStageWithoutDrainageInADrainedOne) {
    const Table t =
        elastic("triaxial: {axial_strain: 1 %, drainage: undrained}, triaxial: {axial_strain: 1 %}");
    expect_close(t.end("pore_pressure"), 0.01 * G);
    expect_close(t.end("stress_xx"), p0 - 0.01 * G);
    expect_close(*t.undrained_strength, 0.015 * G); // of the first stage
}

TEST(LinearElasticity, WithoutUndrainedStagesHasNeitherPorePressureNorStrength) {
    const Table t = elastic("triaxial: {axial_strain: 1 %}");
    EXPECT_THROW(t.end("pore_pressure"), std::out_of_range);
    EXPECT_FALSE(t.undrained_strength);
}

TEST(LinearElasticity, NeedsOneCorrectionAStage) {
    const Table t = elastic("triaxial: {axial_strain: 1 %}, isotropic: {stress: 300 kPa},"
                            "mixed: {strain: {xx: 1 %}, stress: {yy: held, zz: 50 kPa, xy: 5 kPa}}");
    for (std::size_t row = 1; row < t.rows.size(); ++row)
        EXPECT_EQ(t.iterations[row], row % 100 == 1 ? 1 : 0) << row;
}

TEST(LinearElasticity, GoesToWhereItIsSentInOneStepAsInAHundred) {
    const std::string test = "true_triaxial: {axial_strain: 3 %, b: 0.5, hold: minor_stress, steps: ";
    const Table one = elastic(test + "1}"), many = elastic(test + "100}");
    ASSERT_EQ(one.rows.size(), 2u);
    ASSERT_EQ(many.rows.size(), 101u);
    for (const char* name : {"stress_yy", "stress_zz", "strain_xx", "strain_zz"})
        expect_close(one.end(name), many.end(name));
}

TEST(Stages, TakeTheirTimeAndCount) {
    const Table t = elastic("oedometer: {axial_strain: 1 %, duration: 1 h, steps: 4},"
                            "cycle: {count: 2, stages: [oedometer: {axial_strain: 1 %, steps: 1},"
                            "oedometer: {axial_strain: -1 %, steps: 2}]}");
    EXPECT_EQ(t.column("stage"), (std::vector<double>{0, 1, 1, 1, 1, 2, 3, 3, 4, 5, 5}));
    EXPECT_EQ(t.column("time"),
              (std::vector<double>{0, 900, 1800, 2700, 3600, 3601, 3601.5, 3602, 3603, 3603.5, 3604}));
}

} // namespace
} // namespace gault::core::test
