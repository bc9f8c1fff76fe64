// Modified Cam clay, stiffness and strength of which follow pressure: paths with a closed form.
#include "tests/unit/laboratory/element.hpp"

namespace gault::core::test {
namespace {

constexpr double M = 1.2, lambda = 0.15, kappa = 0.03, L = 1 - kappa / lambda, p0 = 120e3;

std::string clay(const std::string& overconsolidation) {
    return "{model: modified_cam_clay, critical_state_ratio: 1.2, compression_index: 0.15, swelling_index: "
           "0.03, "
           "poisson_ratio: 0.278, critical_state_volume: 2.74, overconsolidation_ratio: " +
           overconsolidation + "}";
}
const std::string isotropic = "{isotropic: 120 kPa}";

// The clay keeps v + kappa ln p' + (lambda - kappa) ln p'_c whatever the steps: without volume p'/p'_0 = (1 + t^2)^-L.
TEST(CamClay, FollowsItsUndrainedPath) {
    const Table t = carried_out(clay("1"), isotropic, "triaxial: {axial_strain: 5 %, drainage: undrained}");
    const auto p = t.column("mean_stress"), q = t.column("deviator_stress"), u = t.column("pore_pressure");
    for (std::size_t row = 0; row < p.size(); ++row) {
        EXPECT_NEAR(p[row] / p0, std::pow(1 + std::pow(q[row] / (M * p[row]), 2), -L), 1e-9);
        EXPECT_NEAR(u[row], p0 + q[row] / 3 - p[row], 1e-9 * p0); // total stress: p + u = p0 + q/3
    }
}

TEST(CamClay, HasTheUndrainedStrengthOfItsCriticalState) {
    for (const double R : {1.0, 3.0, 10.0}) {
        const std::string test = "{axial_strain: 30 %, drainage: undrained, steps: 300}";
        const double p = p0 * std::pow(R / 2, L);
        const Table triaxial = carried_out(clay(std::to_string(R)), isotropic, "triaxial: " + test);
        EXPECT_NEAR(triaxial.end("mean_stress"), p, 1e-4 * p) << R;
        EXPECT_NEAR(triaxial.end("deviator_stress"), M * p, 1e-4 * p) << R;
        const Table plane = carried_out(clay(std::to_string(R)), isotropic, "plane_strain: " + test);
        EXPECT_NEAR(0.5 * (plane.end("stress_yy") - plane.end("stress_xx")), M * p / std::sqrt(3.0), 1e-4 * p)
            << R;
        EXPECT_GE(*triaxial.undrained_strength, M * p / 2 * (1 - 1e-4)) << "dry of critical there is a peak";
        EXPECT_EQ(R < 2, *triaxial.undrained_strength < M * p / 2 * (1 + 1e-6)) << R;
    }
}

TEST(CamClay, GoesDrainedToItsCriticalState) {
    const double q = 3 * M * p0 / (3 - M);
    const Table t = carried_out(clay("1"), isotropic, "triaxial: {axial_strain: 80 %, steps: 200}");
    EXPECT_NEAR(t.end("deviator_stress"), q, 1e-3 * q);
    EXPECT_NEAR(t.end("stress_xx"), p0, 1e-3);
}

TEST(CamClay, IsStraightInVolumeOverLogarithmOfPressure) {
    const Table t = carried_out(clay("1"), isotropic,
                                "isotropic: {stress: 600 kPa, steps: 5}, isotropic: {stress: 60 kPa}");
    const double v0 = 2.74 - lambda * std::log(p0 / 2e3) + kappa * std::log(0.5);
    const double v1 = v0 - lambda * std::log(5.0), v2 = v1 + kappa * std::log(10.0);
    EXPECT_NEAR(t.rows.front()[t.index("specific_volume")], v0, 1e-9);
    EXPECT_NEAR(t.at_end_of(1, "specific_volume"), v1, 1e-9);
    EXPECT_NEAR(t.end("specific_volume"), v2, 1e-9);
    EXPECT_NEAR(t.end("volumetric_strain"), std::log(v0 / v2), 1e-9);
}

TEST(CamClay, ComesToItsRestPressureInAnOedometer) {
    const Table t =
        carried_out(clay("1"), "{yy: 50 kPa, xx: 40 kPa, zz: 40 kPa}", "oedometer: {axial_stress: 5 MPa}");
    EXPECT_NEAR(t.end("stress_xx") / t.end("stress_yy"), 0.64528, 1e-4); // plugins/modified_cam_clay
}

TEST(CamClay, NeedsAtMostThreeCorrectionsAStepWithItsTangent) {
    for (const char* test : {"triaxial: {axial_strain: 10 %}", "isotropic: {stress: 500 kPa}",
                             "plane_strain: {axial_strain: 10 %}", "oedometer: {axial_stress: 1 MPa}",
                             "simple_shear: {shear_strain: 10 %}"})
        EXPECT_LE(carried_out(clay("1.5"), isotropic, test).most_iterations(), 3) << test;
}

// A strain above 0.3 in one update is more than the clay takes.
TEST(CamClay, IsTakenInPartsThroughAStepThatIsFarTooLong) {
    const Table t =
        carried_out(clay("1"), isotropic, "triaxial: {axial_strain: 80 %, drainage: undrained, steps: 1}");
    ASSERT_EQ(t.failure, "");
    ASSERT_EQ(t.rows.size(), 2u);
    EXPECT_NEAR(t.end("strain_yy"), 0.8, 1e-12);
    EXPECT_NEAR(t.end("deviator_stress"), M * p0 * std::pow(0.5, L), 1e-3 * p0);
    const Table drained = carried_out(clay("1"), isotropic, "triaxial: {axial_strain: 80 %, steps: 1}");
    ASSERT_EQ(drained.failure, "");
    EXPECT_NEAR(drained.end("deviator_stress"), 3 * M * p0 / (3 - M), 0.02 * p0);
}

TEST(CamClay, EndsAtItsStrengthWhereMoreStressIsPrescribed) {
    const Table t =
        carried_out(clay("1"), isotropic, "triaxial: {deviator_stress: 100 kPa, drainage: undrained}");
    EXPECT_NE(t.failure.find("bears no more stress"), std::string::npos) << t.failure;
    EXPECT_NEAR(t.end("deviator_stress"), M * p0 * std::pow(0.5, L), 1e-3 * p0);
}

TEST(CamClay, SaysWhyItGivesNoResult) {
    const Table t = carried_out(clay("1"), isotropic, "isotropic: {stress: 1 GPa}");
    EXPECT_NE(
        t.failure.find("material 'modified_cam_clay': the soil was compressed until no voids were left"),
        std::string::npos)
        << t.failure;
}

TEST(CamClay, StartsFromStatesThatTheTestGives) {
    const Table t = carried_out(element(clay("1"), isotropic, "triaxial: {axial_strain: 1 %}",
                                        ", states: {preconsolidation_pressure: 300 kPa}"));
    EXPECT_EQ(t.rows.front()[t.index("preconsolidation_pressure")], 300e3);
    EXPECT_EQ(t.rows[1][t.index("plastic_strain")], 0.0) << "within the larger ellipse";
}

TEST(CamClay, RefusesAnInitialStressThatIsTension) {
    try {
        carried_out(clay("1"), "{isotropic: -5 kPa}", "triaxial: {axial_strain: 1 %}");
        FAIL();
    } catch (const RunError& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with("material 'modified_cam_clay': ")) << error.what();
    }
}

} // namespace
} // namespace gault::core::test
