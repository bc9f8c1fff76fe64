// Perfectly plastic soils at their limit, in every kind of test. Both return exactly to their surface, so that a strength
// is met to what the constraints leave: 1e-9 of a step of 1e-3, by a stiffness of 120 MPa, is below 1e-3 Pa.
#include "tests/unit/laboratory/element.hpp"

namespace gault::core::test {
namespace {

constexpr double c = 10e3, phi = 35 * degree, psi = 10 * degree, p0 = 100e3;
const double alpha = (1 + std::sin(phi)) / (1 - std::sin(phi)), Y = 2 * c * std::sqrt(alpha);
constexpr double precise = 1e-3; // Pa

std::string soil(const std::string& model, const std::string& dilation) {
    return "{model: " + model +
           ", young_modulus: 100 MPa, poisson_ratio: 0.25, cohesion: 10 kPa, friction_angle: 35 deg, "
           "dilation_angle: " +
           dilation + "}";
}
const std::string sand = soil("mohr_coulomb", "10 deg"), clay = soil("mohr_coulomb", "0 deg"),
                  cone = soil("drucker_prager", "10 deg"), isotropic = "{isotropic: 100 kPa}";

Table limit(const std::string& model, const std::string& stages, const std::string& stress = isotropic) {
    Table table = carried_out(model, stress, stages);
    EXPECT_EQ(table.failure, "");
    return table;
}

double slope(const Table& t, const std::string& y, const std::string& x) { // of the last step
    const auto a = t.column(y), b = t.column(x);
    return (a.back() - *(a.end() - 2)) / (b.back() - *(b.end() - 2));
}

TEST(MohrCoulomb, HasItsStrengthAndDilationInTriaxialCompressionAndExtension) {
    const Table compression = limit(sand, "triaxial: {axial_strain: 2 %}");
    EXPECT_NEAR(compression.end("stress_yy"), alpha * p0 + Y, precise);
    EXPECT_NEAR(slope(compression, "volumetric_strain", "strain_yy"),
                -2 * std::sin(psi) / (1 - std::sin(psi)), 1e-8);
    EXPECT_NEAR(compression.end("strain_xx"), compression.end("strain_zz"), 1e-12)
        << "on the edge: the least";
    const Table extension = limit(sand, "triaxial: {axial_strain: -2 %}");
    EXPECT_NEAR(extension.end("stress_yy"), (p0 - Y) / alpha, precise);
    EXPECT_NEAR(slope(extension, "volumetric_strain", "strain_yy"), 2 * std::sin(psi) / (1 + std::sin(psi)),
                1e-8);
}

TEST(MohrCoulomb, DoesNotSeeTheIntermediateStress) {
    EXPECT_NEAR(limit(sand, "plane_strain: {axial_strain: 2 %}").end("stress_yy"), alpha * p0 + Y, precise);
    for (const char* b : {"0", "0.3", "0.5", "1"}) {
        const std::string test = std::string("true_triaxial: {axial_strain: 2 %, b: ") + b;
        EXPECT_NEAR(limit(sand, test + ", hold: minor_stress}").end("stress_yy"), alpha * p0 + Y, precise);
        const Table mean = limit(sand, test + "}");
        EXPECT_NEAR(mean.end("stress_yy"), alpha * mean.end("stress_xx") + Y, precise);
        EXPECT_NEAR(mean.end("mean_stress"), p0, precise);
    }
}

// Davis (1968): no strain along x, so the Mohr circle is cut at 90 deg - psi. The limit is approached exponentially.
TEST(MohrCoulomb, HasDavisStrengthInSimpleShear) {
    const Table t = limit(sand, "simple_shear: {shear_strain: 10 %, steps: 200}",
                          "{yy: 100 kPa, xx: 50 kPa, zz: 50 kPa}");
    const double expected =
        (c * std::cos(phi) + p0 * std::sin(phi)) * std::cos(psi) / (1 - std::sin(phi) * std::sin(psi));
    EXPECT_NEAR(t.end("stress_xy"), expected, 1e-6 * expected);
    EXPECT_NEAR(t.end("stress_yy"), p0, precise);
    EXPECT_NEAR(slope(t, "volumetric_strain", "strain_xy"), -2 * std::tan(psi), 1e-6);
}

TEST(MohrCoulomb, KeepsItsMeanStressWithoutDrainageAndDilation) {
    const double q = 6 * (p0 * std::sin(phi) + c * std::cos(phi)) / (3 - std::sin(phi));
    const Table triaxial = limit(clay, "triaxial: {axial_strain: 2 %, drainage: undrained}");
    EXPECT_NEAR(triaxial.end("deviator_stress"), q, precise);
    EXPECT_NEAR(triaxial.end("pore_pressure"), q / 3, precise);
    EXPECT_NEAR(*triaxial.undrained_strength, q / 2, precise);
    const double s = p0 * std::sin(phi) + c * std::cos(phi);
    for (const char* test : {"plane_strain: {axial_strain: 2 %, drainage: undrained}",
                             "simple_shear: {shear_strain: 4 %, drainage: undrained}"}) {
        const Table plane = limit(clay, test);
        EXPECT_NEAR(*plane.undrained_strength, s, precise) << test;
        EXPECT_NEAR(plane.end("volumetric_strain"), 0.0, 1e-12) << test;
    }
}

TEST(MohrCoulomb, ComesBackToWhereItWasUnloaded) {
    for (const char* kind :
         {"triaxial: {axial_strain", "plane_strain: {axial_strain", "simple_shear: {shear_strain"}) {
        const auto stage = [&](const char* strain) { return std::string(kind) + ": " + strain + "}"; };
        const Table t = limit(sand, stage("1 %") + "," + stage("-0.1 %") + "," + stage("0.1 %"));
        for (const char* name : {"stress_xx", "stress_yy", "stress_zz", "stress_xy"})
            EXPECT_NEAR(t.end(name), t.at_end_of(1, name), precise) << kind << name;
        for (const char* name : {"strain_xx", "strain_yy", "strain_zz", "strain_xy", "plastic_strain"})
            EXPECT_NEAR(t.end(name), t.at_end_of(1, name), 1e-11) << kind << name;
    }
}

TEST(MohrCoulomb, GivesTheSameInCyclesAsInStagesWrittenOut) {
    const std::string stages =
        "triaxial: {axial_strain: 1 %, steps: 10}, triaxial: {axial_strain: -1.5 %, steps: 10}";
    const Table cycle = limit(sand, "cycle: {count: 3, stages: [" + stages + "]}");
    EXPECT_EQ(cycle.rows, limit(sand, stages + "," + stages + "," + stages).rows);
    EXPECT_EQ(cycle.rows.size(), 61u);
}

TEST(MohrCoulomb, HasItsStrengthWhereItStandsInclined) {
    const Table t = limit(sand, "triaxial: {axial_strain: 20 %, steps: 50}",
                          "{xx: 100 kPa, yy: 130 kPa, zz: 100 kPa, xy: 20 kPa, yz: -10 kPa}");
    // axes of stress turn into those of strain: shear stress goes, exponentially
    EXPECT_NEAR(t.end("stress_yy"), alpha * p0 + Y, 1.0);
    EXPECT_NEAR(t.end("stress_xy"), 0.0, 1.0);
    EXPECT_NEAR(t.end("stress_xx"), p0, precise);
}

TEST(MohrCoulomb, EndsAtItsLimitWhereMoreStressIsPrescribed) {
    const Table t = limit(sand, "triaxial: {axial_stress: 200 kPa, steps: 10}");
    ASSERT_EQ(t.rows.size(), 11u);
    const Table beyond = carried_out(sand, isotropic, "triaxial: {axial_stress: 1100 kPa, steps: 10}");
    EXPECT_TRUE(
        beyond.failure.starts_with("stage 1 (triaxial), 30.74 % done: no strain gives the stress that is "
                                   "prescribed; a soil at its limit bears no more stress"))
        << beyond.failure;
    ASSERT_EQ(beyond.rows.size(), 5u); // 100, 200, 300, 400 kPa, and as far as it came
    EXPECT_NEAR(beyond.at_end_of(0, "stress_yy"), p0, precise);
    EXPECT_NEAR(beyond.end("stress_yy"), alpha * p0 + Y, 2e-9 * 1000e3 + precise);
    EXPECT_NEAR(beyond.end("time"), (beyond.end("stress_yy") - p0) / 1000e3, 1e-8);
}

TEST(MohrCoulomb, RunsAwayFromAStressThatOnlyEndlessDilationWouldBear) {
    const Table t = carried_out(sand, isotropic, "simple_shear: {shear_stress: 150 kPa}");
    EXPECT_NE(t.failure.find("bears no more stress"), std::string::npos) << t.failure;
    EXPECT_LT(t.end("stress_xy"), 100e3);
    EXPECT_NEAR(t.end("stress_yy"), p0, 1.0);
}

TEST(MohrCoulomb, NeedsAtMostThreeCorrectionsAStepWithItsTangent) {
    for (const char* test : {"triaxial: {axial_strain: 2 %}", "triaxial: {axial_strain: -2 %}",
                             "plane_strain: {axial_strain: 2 %}", "simple_shear: {shear_strain: 5 %}",
                             "true_triaxial: {axial_strain: 2 %, b: 0.5}"})
        EXPECT_LE(limit(sand, test).most_iterations(), 3) << test;
}

// J2 and mean stress, tension positive.
struct Invariants {
    double tau, p;
    explicit Invariants(const Table& t)
        : tau(t.end("deviator_stress") / std::sqrt(3.0)), p(-t.end("mean_stress")) {}
};
const double eta = 6 * std::sin(phi) / (std::sqrt(3.0) * (3 - std::sin(phi))), k = eta * c / std::tan(phi),
             flow = 6 * std::sin(psi) / (std::sqrt(3.0) * (3 - std::sin(psi)));

// Without a tangent of its own: by differences.
TEST(DruckerPrager, MeetsMohrCoulombInTriaxialCompression) {
    const Table t = limit(cone, "triaxial: {axial_strain: 2 %}");
    EXPECT_NEAR(t.end("stress_yy"), alpha * p0 + Y, precise);
    EXPECT_LE(t.most_iterations(), 4);
    EXPECT_GT(t.updates, 7 * 100);
}

TEST(DruckerPrager, StaysOnItsConeInEveryTest) {
    for (const char* test :
         {"triaxial: {axial_strain: -1 %}", "plane_strain: {axial_strain: 5 %}",
          "simple_shear: {shear_strain: 5 %}", "true_triaxial: {axial_strain: 2 %, b: 0.5}",
          "triaxial: {axial_strain: 1 %, drainage: undrained}",
          "mixed: {strain: {xy: 2 %}, stress: {xx: held, yy: held, zz: held, zx: 5 kPa}}"}) {
        const Invariants s(limit(cone, test));
        EXPECT_NEAR(s.tau + eta * s.p, k, precise) << test;
    }
}

// At the limit elastic strain stands still, so the flow has no part along z: s_zz = -2/3 flow tau.
TEST(DruckerPrager, HasItsClosedFormInPlaneStrain) {
    const double z = -2 * flow / 3, half = 0.5 * std::sqrt(4 - 3 * z * z), x = -z / 2 + half,
                 y = -z / 2 - half;
    const double tau = (-p0 - k / eta) / (x - 1 / eta); // sigma_xx = x tau + (k - tau)/eta = -p0
    const Table t = limit(cone, "plane_strain: {axial_strain: 40 %}");
    EXPECT_NEAR(t.end("stress_yy"), -(y * tau + (k - tau) / eta), 1e-6 * p0);
    EXPECT_NEAR(t.end("stress_xx"), p0, precise);
}

} // namespace
} // namespace gault::core::test
