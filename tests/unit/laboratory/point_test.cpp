// What a point is given and what it answers, with soils that are functions of the test.
#include "tests/unit/laboratory/element.hpp"
#include "tests/unit/solver/small_scene.hpp"

#include <Eigen/Eigenvalues>

namespace gault::core::test {
namespace {

constexpr double lame = 40e6, shear = 30e6;

ElementTest test_of(TestMaterial& soil, const std::string& stages) {
    ElementTest test = element("{model: linear_elastic, young_modulus: 1 MPa, poisson_ratio: 0}",
                               "{isotropic: 100 kPa}", stages);
    test.material.name = "test soil";
    test.material.model = soil.use();
    return test;
}

TEST(SoilPoint, GivesASoilTheFieldsThatItAsksFor) {
    TestMaterial soil(lame, shear);
    soil.inputs = {"volume_ratio", "characteristic_length", "density"};
    double ratio = 0.0, length = 0.0, density = 0.0;
    soil.update = [&](gault_points& p, gault_error&) {
        ratio = p.input[0][0], length = p.input[1][0], density = p.input[2][0];
        return soil.elastic(p);
    };
    ElementTest test = test_of(soil, "isotropic: {volumetric_strain: 10 %, steps: 10}");
    test.characteristic_length = 0.25;
    carried_out(test);
    EXPECT_NEAR(ratio, std::exp(-0.1), 1e-12); // at the end of the step
    EXPECT_NEAR(density, 2000.0 * std::exp(0.1), 1e-8);
    EXPECT_EQ(length, 0.25);
}

// Cauchy stress of a logarithmic strain that the soil reads off F alone.
TEST(SoilPoint, GivesASoilOfFiniteStrainItsDeformationGradient) {
    TestMaterial soil(lame, shear);
    soil.flags = GAULT_FINITE_STRAIN;
    soil.update = [&](gault_points& p, gault_error&) {
        for (int64_t i = 0; i < p.count; ++i) {
            Eigen::Matrix3d F, F_old;
            for (int k = 0; k < 9; ++k)
                F(k / 3, k % 3) = p.F_new[k][i], F_old(k / 3, k % 3) = p.F_old[k][i];
            EXPECT_NEAR(std::log(F.determinant() / F_old.determinant()),
                        p.strain[0][i] + p.strain[1][i] + p.strain[2][i], 1e-12);
            const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(F);
            const Eigen::Matrix3d e = axes.eigenvectors() *
                                      axes.eigenvalues().array().log().matrix().asDiagonal() *
                                      axes.eigenvectors().transpose();
            const Eigen::Matrix3d s = lame * e.trace() * Eigen::Matrix3d::Identity() + 2 * shear * e -
                                      100e3 * Eigen::Matrix3d::Identity();
            const int row[] = {0, 1, 2, 0, 1, 2}, column[] = {0, 1, 2, 1, 2, 0};
            for (int k = 0; k < 6; ++k)
                p.stress[k][i] = s(row[k], column[k]);
            p.modulus[i] = lame + 2 * shear, p.shear_modulus[i] = shear;
        }
        return gault_status(GAULT_OK);
    };
    const Table t =
        carried_out(test_of(soil, "triaxial: {axial_strain: 20 %, steps: 5}, mixed: {strain: {xy: 20 %}, "
                                  "stress: {xx: held, yy: 200 kPa, zz: held, zx: 50 kPa}, steps: 5}"));
    ASSERT_EQ(t.failure, "");
    const double E = shear * (3 * lame + 2 * shear) / (lame + shear);
    EXPECT_NEAR(t.at_end_of(1, "stress_yy"), 100e3 + 0.2 * E, 10.0); // differences, 1e-9 of a step of 4 %
    EXPECT_NEAR(t.end("stress_xy"), 2 * shear * 0.2, 10.0);
    EXPECT_NEAR(t.end("strain_yy"), 100e3 / E, 1e-7);
    EXPECT_NEAR(t.end("strain_zx"), 50e3 / (2 * shear), 1e-7);
    EXPECT_LE(t.most_iterations(), 3) << "the differences are those of the strain that is controlled";
}

TEST(SoilPoint, IsStrainedInPartsWhereTheSoilAsks) {
    TestMaterial soil(lame, shear);
    std::vector<double> steps;
    soil.update = [&](gault_points& p, gault_error&) {
        if (std::abs(p.strain[1][0]) > 0.003) return gault_status(GAULT_RETRY);
        steps.push_back(p.dt);
        return soil.elastic(p);
    };
    const Material material({"soil", soil.use(), 2000.0, {}, ""});
    SoilPoint point(material, {-1e5, -1e5, -1e5, 0, 0, 0});
    point.strain({0, -0.01, 0, 0, 0, 0}, 2.0);
    EXPECT_EQ(steps, (std::vector<double>{0.5, 0.5, 0.5, 0.5}));
    EXPECT_NEAR(point.stress()[1], -1e5 - 0.01 * (lame + 2 * shear), 1e-6);
    EXPECT_EQ(point.time(), 2.0);
}

TEST(MixedControl, ShortensItsStepsWhereTheSoilAsks) {
    TestMaterial soil(lame, shear);
    soil.states = {{"steps", "1", "", GAULT_SCALAR, 0, 0.0, 0.0, HUGE_VAL}};
    soil.update = [&](gault_points& p, gault_error&) {
        if (std::abs(p.strain[1][0]) > 0.003) return gault_status(GAULT_RETRY);
        soil.elastic(p);
        for (int64_t i = 0; i < p.count; ++i)
            p.state[0][i] += 1.0;
        return gault_status(GAULT_OK);
    };
    const Table t = carried_out(test_of(soil, "triaxial: {axial_strain: 1 %, steps: 1, duration: 2 s}"));
    EXPECT_EQ(t.failure, "");
    EXPECT_EQ(t.rows.size(), 2u);
    EXPECT_EQ(t.end("steps"), 4.0);
    EXPECT_EQ(t.end("time"), 2.0);
    EXPECT_NEAR(t.end("strain_yy"), 0.01, 1e-12);
}

TEST(MixedControl, SaysThatASoilAsksForEverSmallerSteps) {
    TestMaterial soil(lame, shear);
    soil.update = [&](gault_points& p, gault_error&) {
        return p.strain[1][0] != 0.0 ? gault_status(GAULT_RETRY) : soil.elastic(p);
    };
    const Table t = carried_out(test_of(soil, "oedometer: {axial_strain: 1 %}"));
    EXPECT_EQ(t.failure, "stage 1 (oedometer), 0 % done: material 'test soil' asks for ever smaller steps");
    EXPECT_EQ(t.rows.size(), 1u);
}

TEST(MixedControl, SaysThatASoilAnswersWithWhatIsNoNumber) {
    TestMaterial soil(lame, shear);
    soil.update = [&](gault_points& p, gault_error&) {
        soil.elastic(p);
        if (p.strain[1][0] != 0.0) p.stress[0][0] = NAN;
        return gault_status(GAULT_OK);
    };
    const Table t = carried_out(test_of(soil, "oedometer: {axial_strain: 1 %}"));
    EXPECT_EQ(
        t.failure,
        "stage 1 (oedometer), 0 % done: material 'test soil' answered with a number that is not finite");
}

TEST(MixedControl, LetsNoStateReachATableThatIsNoNumber) {
    TestMaterial soil(lame, shear);
    soil.states = {{"damage", "1", "", GAULT_SCALAR, 0, 0.0, 0.0, 1.0}};
    soil.update = [&](gault_points& p, gault_error&) {
        soil.elastic(p);
        if (p.strain[1][0] != 0.0) p.state[0][0] = NAN;
        return gault_status(GAULT_OK);
    };
    EXPECT_EQ(carried_out(test_of(soil, "oedometer: {axial_strain: 1 %}")).failure,
              "stage 1: column 'damage' is nan");
}

TEST(MixedControl, RefusesASoilWithoutStiffness) {
    TestMaterial soil(0.0, 0.0);
    EXPECT_EQ(carried_out(test_of(soil, "oedometer: {axial_strain: 1 %}")).failure,
              "material 'test soil' has no stiffness here");
}

TEST(Replay, AsksTheCallAndPartsOfItAgain) {
    TestMaterial soil(lame, shear);
    soil.states = {{"damage", "1", "", GAULT_SCALAR, 0, 0.0, 0.0, 1.0}};
    soil.inputs = {"density"};
    std::vector<double> times;
    soil.update = [&](gault_points& p, gault_error& error) {
        EXPECT_EQ(p.state_old[0][0], 0.25);
        EXPECT_EQ(p.input[0][0], 1800.0);
        times.push_back(p.time);
        soil.elastic(p);
        if (p.strain[1][0] >= -0.005) return gault_status(GAULT_OK);
        error.point = 0;
        std::snprintf(error.text, sizeof error.text, "it broke");
        return gault_status(GAULT_FAILED);
    };
    ElementTest test = test_of(soil, "oedometer: {axial_strain: 1 %}");
    test.replay = ElementReplay{{-1e5, -1e5, -1e5, 0, 0, 0},
                                {0, -0.01, 0, 0, 0, 0},
                                {{"damage", {0.25}}},
                                {{"density", {1800.0}}},
                                {},
                                {},
                                5.0,
                                2.0};
    const auto answers = replay(test);
    ASSERT_EQ(answers.size(), 7u);
    EXPECT_EQ(answers[0].failure.status, gault_status(GAULT_FAILED));
    EXPECT_EQ(answers[0].failure.text, "it broke");
    EXPECT_EQ(times[0], 5.0);
    EXPECT_EQ(answers[1].failure.status, gault_status(GAULT_OK));
    EXPECT_EQ(answers[1].stress[1], -1e5 - (lame + 2 * shear) * 0.005);
    EXPECT_EQ(answers[1].state, std::vector<double>{0.25});
    EXPECT_EQ(times[1], 4.0);
}

TEST(Speed, IsThatOfTheLastStepOnceMoreOrNone) {
    TestMaterial soil(lame, shear);
    double strain = 0.0, dt = 0.0, old = 0.0;
    bool refuses = false;
    soil.update = [&](gault_points& p, gault_error&) {
        strain = p.strain[1][p.count - 1], dt = p.dt, old = p.stress_old[1][p.count - 1];
        return refuses ? gault_status(GAULT_RETRY) : soil.elastic(p);
    };
    const ElementTest test = test_of(soil, "oedometer: {axial_strain: 1 %, steps: 10, duration: 5 s}");
    ElementRun run(test);
    run.go([](const auto&) {});
    const auto seconds = seconds_per_update(run.point(), 64);
    ASSERT_TRUE(seconds);
    EXPECT_GT(*seconds, 0.0);
    EXPECT_LT(*seconds, 1e-5);
    EXPECT_NEAR(strain, -0.001, 1e-15);
    EXPECT_NEAR(dt, 0.5, 1e-12);
    EXPECT_EQ(old, run.point().stress()[1]);
    refuses = true;
    EXPECT_FALSE(seconds_per_update(run.point(), 64));
}

} // namespace
} // namespace gault::core::test
