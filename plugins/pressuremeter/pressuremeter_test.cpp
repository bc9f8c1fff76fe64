#include "program_fixture.hpp"

#include <gtest/gtest.h>

namespace {
using namespace plugin_test;

std::vector<Record> until(double cavity_strain) {
    return {{"cavity_strain", {{"value", cavity_strain}}}};
}

Component program(Settings settings) {
    settings.try_emplace("until", until(0.1));
    return {"pressuremeter", GAULT_PROGRAM, "pressuremeter", settings};
}

constexpr double a0 = 0.02, height = 0.2; // m

// A cavity whose wall goes where it is told, in a soil that answers 1 MPa times the cavity strain.
struct Cavity {
    explicit Cavity(const Component& c) : run(c) { measure(); }

    void measure() {
        run.measured("radius") = radius;
        run.measured("initial_radius") = a0;
        run.measured("area") = 2.0 * M_PI * radius * height;
        run.measured("initial_area") = 2.0 * M_PI * a0 * height;
        run.measured("normal_force") = 1e6 * (radius / a0 - 1.0) * run.measured("area");
    }
    void step(double dt, double taken = 1.0) { // the host may take a part of what it announced
        ASSERT_EQ(run.advance(dt), GAULT_OK) << run.error.text;
        if (run.done) return;
        run.shorten(taken);
        radius += run.commanded("velocity") * run.dt();
        run.time += run.dt();
        measure();
    }
    void finish(double dt) {
        while (!run.done)
            step(dt);
    }

    ProgramRun run;
    double radius = a0;
};

TEST(Pressuremeter, EndsExactlyAtTheWantedStrainWhateverTheStep) {
    for (const double dt : {1e-4, 3.3e-3, 0.77}) {
        const Component c = program({{"rate", 1e-3}});
        Cavity cavity(c);
        cavity.finish(dt);
        EXPECT_NEAR(cavity.radius / a0 - 1.0, 0.1, 1e-12) << dt;
        // 2 mm at 1 mm/s, and half of the start, which takes 2 x 0.05 % x 20 mm / (1 mm/s).
        EXPECT_NEAR(cavity.run.time, 2.0 + 0.5 * 0.02, 1e-12) << dt;
    }
}

TEST(Pressuremeter, MovesTheWallAtTheRateAfterASmoothStart) {
    const Component c = program({{"rate", 1e-3}, {"ramp_time", 0.1}});
    Cavity cavity(c);
    const double dt = 1e-4;
    double largest = 0.0, before = 0.0;
    while (cavity.run.time < 0.1 - 1e-9) {
        cavity.step(dt);
        const double velocity = cavity.run.commanded("velocity");
        largest = std::max(largest, (velocity - before) / dt);
        before = velocity;
    }
    // The quintic's steepest slope is 15/8 at its middle.
    EXPECT_NEAR(largest, 15.0 / 8.0 * 1e-3 / 0.1, 1e-5);
    cavity.step(dt);
    EXPECT_NEAR(cavity.run.commanded("velocity"), 1e-3, 1e-12);
    EXPECT_NEAR(cavity.radius - a0, 1e-3 * (0.05 + dt), 1e-15);
}

TEST(Pressuremeter, TakesARateOfCavityStrain) {
    const Component c = program({{"strain_rate", 0.05}, {"ramp_strain", 1e-3}});
    Cavity cavity(c);
    cavity.finish(1e-3);
    EXPECT_NEAR(cavity.run.time, 0.1 / 0.05 + 1e-3 / 0.05, 1e-12);
}

TEST(Pressuremeter, ReachesAStrainWithinItsStart) {
    const Component c = program({{"rate", 1e-3}, {"ramp_strain", 1e-2}, {"until", until(1e-3)}});
    Cavity cavity(c);
    cavity.finish(1e-3);
    EXPECT_NEAR(cavity.radius / a0 - 1.0, 1e-3, 1e-13);
}

TEST(Pressuremeter, CatchesUpWhenAStepIsShorterThanAnnounced) {
    const Component c = program({{"rate", 1e-3}, {"ramp_time", 0.1}});
    Cavity cavity(c);
    for (int i = 0; i < 4; ++i)
        cavity.step(0.02, 0.5);
    cavity.step(0.06);
    EXPECT_NEAR(cavity.run.time, 0.1, 1e-12);
    EXPECT_NEAR(cavity.radius - a0, 1e-3 * 0.05, 1e-15);
}

TEST(Pressuremeter, EmitsARowAtEveryMultipleOfTheRowStrain) {
    const Component c = program({{"rate", 1e-3}, {"row_strain", 0.01}});
    Cavity cavity(c);
    cavity.finish(1e-3);
    const auto& rows = cavity.run.rows;
    ASSERT_EQ(rows.size(), 11u);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double strain = cavity.run.recorded(rows[i], "cavity_strain");
        EXPECT_GE(strain, 0.01 * static_cast<double>(i) - 1e-11);
        EXPECT_LE(strain, 0.01 * static_cast<double>(i) + 1e-3 * 1e-3 / a0); // within one step
    }
}

TEST(Pressuremeter, TellsTrueFromNominalPressure) {
    const Component c = program({{"rate", 1e-3}});
    Cavity cavity(c);
    cavity.finish(1e-2);
    const auto& last = cavity.run.rows.back();
    EXPECT_NEAR(cavity.run.recorded(last, "true_pressure"), 1e5, 1e-4);
    EXPECT_NEAR(cavity.run.recorded(last, "nominal_pressure"), 1.1e5, 1e-4);
    EXPECT_NEAR(cavity.run.recorded(last, "cavity_radius"), 0.022, 1e-14);
}

TEST(Pressuremeter, RefusesNoRateOrTwo) {
    EXPECT_THROW(program({}), Invalid);
    EXPECT_THROW(program({{"rate", 1e-3}, {"strain_rate", 0.05}}), Invalid);
    EXPECT_THROW(program({{"rate", 1e-3}, {"ramp_time", 0.1}, {"ramp_strain", 0.01}}), Invalid);
}

TEST(Pressuremeter, RefusesASurfaceThatMovesInwards) {
    const Component c = program({{"rate", 1e-3}});
    Cavity cavity(c);
    cavity.step(1e-3);
    cavity.radius = 0.999 * a0;
    cavity.measure();
    EXPECT_EQ(cavity.run.advance(1e-3), GAULT_FAILED);
}

TEST(Pressuremeter, RefusesASurfaceWithoutARadius) {
    const Component c = program({{"rate", 1e-3}});
    ProgramRun run(c);
    EXPECT_EQ(run.advance(1e-3), GAULT_FAILED);
}

} // namespace
