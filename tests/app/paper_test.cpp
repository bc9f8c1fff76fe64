// The four scenes of the paper, as they are shipped, have the errors that docs/method.md states under
// "Measured": the bounds are about twice those; "required" is what the project set out to reach. Numbers are
// read from what a run writes.
#include "tests/app/child.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace gault::test {
namespace {

class PaperScenes : public App {
  protected:
    nlohmann::json cylinder() const { return summary(results)["derived"]["thick_cylinder"]; }

    void expect_cylinder(double sigma_r, double sigma_theta, double displacement) const {
        const auto c = cylinder();
        EXPECT_LE(c["sigma_r_l2"], sigma_r);
        EXPECT_LE(c["sigma_theta_l2"], sigma_theta);
        EXPECT_LE(c["inner_displacement_error"], displacement);
    }

    void expect_fahey(double largest_curve_error, double largest_profile_error) const {
        const auto reference = summary(results)["reference"];
        const auto& curve = reference["curves"][0];
        EXPECT_EQ(curve["y"], "true_pressure");
        EXPECT_EQ(curve["from"], 0.005);
        EXPECT_EQ(curve["to"], 0.1);
        EXPECT_LE(curve["largest_relative_error"], largest_curve_error);
        EXPECT_LE(curve["noise_about_cubic"], 4e-5) << "over 4 to 10 %; required: 3e-3";
        ASSERT_EQ(reference["profiles"].size(), 4u);
        for (int k = 0; k < 4; ++k) {
            EXPECT_NEAR(reference["profiles"][k]["value"].get<double>(), 0.025 * (k + 1), 1e-12);
            EXPECT_LE(reference["profiles"][k]["sigma_r_l2"], largest_profile_error);
            EXPECT_LE(reference["profiles"][k]["sigma_theta_l2"], largest_profile_error);
        }
    }

    // The share of points that end in another cell than they began in. The grid is geometric, and its knots
    // are stretched with the walls.
    double share_that_crossed(int cells, double inner, double outer) const {
        const auto frames = core::test::members(results / "results.h5", "/frames");
        const std::string last = "/frames/" + frames.back();
        const auto now = core::test::numbers(results / "results.h5", last + "/position");
        const auto before = core::test::numbers(results / "results.h5", last + "/reference_position");
        const double inner_now = history(results, "cavity_radius_m").back();
        std::size_t outermost = 0, crossed = 0;
        for (std::size_t i = 0; i < now.shape[0]; ++i)
            if (before.values[3 * i] > before.values[3 * outermost]) outermost = i;
        const double outer_now = outer + now.values[3 * outermost] - before.values[3 * outermost];
        for (std::size_t i = 0; i < now.shape[0]; ++i) {
            const double back =
                inner + (now.values[3 * i] - inner_now) * (outer - inner) / (outer_now - inner_now);
            const auto cell = [&](double r) {
                return std::floor(cells * std::log(r / inner) / std::log(outer / inner));
            };
            crossed += cell(back) != cell(before.values[3 * i]);
        }
        return static_cast<double>(crossed) / static_cast<double>(now.shape[0]);
    }
};

TEST_F(PaperScenes, CaseOneIsLamesCylinderUnderOuterPressure) {
    run("configs/paper/case1.yaml");
    expect_cylinder(1.8e-4, 0.8e-4, 4e-4); // required: stresses 1e-3
}

TEST_F(PaperScenes, CaseTwoIsLamesCylinderUnderBothPressures) {
    run("configs/paper/case2.yaml");
    expect_cylinder(1.7e-4, 0.9e-4, 4.4e-4); // required: stresses 1e-3
    // The load sets in at once and is damped: what the run says of it.
    const auto time = history(results, "time_s"), ratio = history(results, "kinetic_ratio");
    std::size_t last = ratio.size();
    while (last > 0 && ratio[--last] <= 1e-3) {
    }
    ASSERT_LT(time[last], 0.5 * time.back());
    const auto cautions = summary(results)["cautions"];
    ASSERT_EQ(cautions.size(), 1u);
    const std::string said = cautions[0], until = fmt::format("above 0.1 % of it until {:.4g} s", time[last]);
    EXPECT_NE(said.find(until), std::string::npos) << said;
}

TEST_F(PaperScenes, CaseThreeIsTheClosedFormOnTheDeformedCylinder) {
    run("configs/paper/case3.yaml");
    const auto c = cylinder();
    expect_cylinder(6e-4, 6.5e-4, 3.2e-4); // required: stresses 5e-3, displacement 1e-3
    EXPECT_NEAR(c["inner_radius_exact"].get<double>(), 2.042547, 1e-6);
    const double cell_at_the_plastic_radius = 0.16; // m
    EXPECT_NEAR(c["plastic_radius"].get<double>(), 8.056, cell_at_the_plastic_radius);
    // Beside them, the errors that a comparison on the initial cylinder would state.
    EXPECT_GT(c["sigma_r_l2_initial"], 5e-3);
    EXPECT_GT(c["sigma_theta_l2_initial"], 5e-3);
    EXPECT_NEAR(c["plastic_radius_initial"].get<double>(), 7.764, 1e-3);
}

TEST_F(PaperScenes, FaheysTestMeetsItsReferenceInTheTotalFrame) {
    run("configs/paper/fahey.yaml");
    expect_fahey(2e-4, 2e-3); // required: 5e-3 both
    const auto strain = history(results, "cavity_strain"), pressure = history(results, "true_pressure_Pa");
    const auto peak = std::max_element(pressure.begin(), pressure.end());
    EXPECT_NEAR(*peak, 628.15e3, 1e-4 * 628.15e3);
    EXPECT_NEAR(strain[static_cast<std::size_t>(peak - pressure.begin())], 0.0348, 0.002);
    EXPECT_NEAR(history(results, "nominal_pressure_Pa").back() / pressure.back(), 1.1, 1e-6);
    EXPECT_LT(summary(results)["energy"]["largest_kinetic_ratio"], 2e-4) << "quasi-static";
    EXPECT_LT(summary(results)["energy"]["energy_error"], 1e-10);
    EXPECT_TRUE(summary(results)["cautions"].empty());
}

TEST_F(PaperScenes, FaheysTestMeetsItsReferenceInTheUpdatedFrame) {
    run("configs/paper/fahey.yaml", {"--set", "model.frame=updated"});
    expect_fahey(2e-4, 2.1e-3); // required: 1e-2 and 2e-2
    EXPECT_GT(share_that_crossed(72, 0.02, 0.2), 0.2) << "points cross cells there";
}

// A hold is most of the time and a few of the rows: it must not take what came before for the start of the load.
TEST_F(PaperScenes, FaheysTestAtTwoHundredTimesItsRateIsCautionedAfterAHoldToo) {
    run("configs/paper/fahey.yaml", {"--set", "grid.cells=[18, 1]", "--set", "points.per_cell=4", "--set",
                                     "program={type: pressuremeter, on: inner, rate: 200 mm/s, phases: "
                                     "[expand: {until: {cavity_strain: 10 %}}, "
                                     "hold: {of: wall, duration: 0.2 s}]}"});
    const auto cautions = summary(results)["cautions"];
    ASSERT_EQ(cautions.size(), 1u);
    EXPECT_TRUE(has(cautions[0], "kinetic energy reached")) << cautions[0];
}

struct WithoutInertia {
    const char* name;
    Words changes;
    double pressure, stress; // largest errors
    int updates;
};
class QuasiStaticScenes : public PaperScenes, public testing::WithParamInterface<WithoutInertia> {};
INSTANTIATE_TEST_SUITE_P(
    Fahey, QuasiStaticScenes,
    testing::Values(WithoutInertia{"Radial",
                                   {"--set", "model.symmetry=radial", "--set", "grid.basis=linear", "--set",
                                    "points.per_cell=1"},
                                   2.6e-4, // required: 5e-4, 1e-3, 5000 updates
                                   1e-3,
                                   5000},
                    WithoutInertia{"Axisymmetric", {"--set", "points.per_cell=4"}, 4e-5, 1e-3, 20000},
                    WithoutInertia{"Updated",
                                   {"--set", "model.frame=updated", "--set", "model.symmetry=radial", "--set",
                                    "points.per_cell=4"},
                                   4e-5,
                                   2.1e-3,
                                   20000}),
    [](const auto& instance) { return std::string(instance.param.name); });

TEST_P(QuasiStaticScenes, MeetTheReferenceInTwentySteps) {
    Words changes = GetParam().changes;
    changes.insert(changes.end(), {"--set", "model.solver=quasi_static"});
    run("configs/paper/fahey.yaml", changes);
    const auto all = summary(results);
    EXPECT_LE(all["reference"]["curves"][0]["largest_relative_error"], GetParam().pressure);
    for (const auto& profile : all["reference"]["profiles"]) {
        EXPECT_LE(profile["sigma_r_l2"], GetParam().stress);
        EXPECT_LE(profile["sigma_theta_l2"], GetParam().stress);
    }
    EXPECT_LE(all["counts"]["constitutive_updates"], GetParam().updates);
    EXPECT_LE(all["counts"]["steps"], 25);
}

TEST_F(PaperScenes, CylindersWithoutInertiaMeetTheClosedForms) {
    const Words still{"--set", "model.solver=quasi_static", "--force"};
    run("configs/paper/case2.yaml", still);
    expect_cylinder(1.7e-4, 0.9e-4, 4.4e-4);
    run("configs/paper/case3.yaml", still);
    expect_cylinder(6e-4, 5.3e-4, 2e-5); // the wall is where the finite-strain closed form has it
}

TEST_F(PaperScenes, FaheysTestHardlyFeelsItsMassScaling) {
    const Words coarse{"--force", "--set", "grid.cells=[36, 1]"};
    run("configs/paper/fahey.yaml", coarse);
    const auto strain = history(results, "cavity_strain"), pressure = history(results, "true_pressure_Pa");
    Words lighter = coarse;
    lighter.insert(lighter.end(), {"--set", "solver.mass_scaling=6.25"});
    run("configs/paper/fahey.yaml", lighter);
    const auto other_strain = history(results, "cavity_strain"), other = history(results, "true_pressure_Pa");
    for (double e = 0.005; e < 0.0999; e += 0.0005) {
        const double p = at(strain, pressure, e);
        EXPECT_NEAR(at(other_strain, other, e), p, 7e-4 * p) << "cavity strain " << e;
    }
}

} // namespace
} // namespace gault::test
