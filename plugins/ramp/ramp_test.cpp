#include "program_fixture.hpp"

#include <gtest/gtest.h>

namespace {
using namespace plugin_test;

const Points loading{{0.0, 100e3}, {1.0, 400e3}, {1.5, 400e3}, {2.0, 200e3}};

Component program(const Settings& settings) {
    return {"ramp", GAULT_PROGRAM, "ramp", settings};
}

// Steps of dt, cut at the program's events; returns what was commanded for the end of every step.
std::vector<std::array<double, 2>> run_to_end(ProgramRun& run, const std::string& control, double dt) {
    std::vector<std::array<double, 2>> commanded;
    while (run.advance(dt) == GAULT_OK && !run.done) {
        run.time += run.dt();
        commanded.push_back({run.time, run.commanded(control)});
    }
    return commanded;
}

TEST(Ramp, CommandsThePressureOfTheEndOfEachStep) {
    const Component c = program({{"pressure", loading}, {"smooth", false}});
    ProgramRun run(c);
    for (const auto& [time, pressure] : run_to_end(run, "pressure", 0.07)) {
        const double expected = time < 1.0   ? 100e3 + 300e3 * time
                                : time < 1.5 ? 400e3
                                             : 400e3 - 400e3 * (time - 1.5);
        EXPECT_NEAR(pressure, expected, 1e-6) << time;
    }
    EXPECT_EQ(run.time, 2.0);
}

TEST(Ramp, StartsFromTheTablesFirstValue) {
    const Component c = program({{"pressure", loading}});
    ProgramRun run(c);
    EXPECT_EQ(run.commanded("pressure"), 100e3);
}

TEST(Ramp, EndsAStepAtEveryPointOfItsTable) {
    const Component c = program({{"pressure", loading}});
    ProgramRun run(c);
    std::vector<double> ends;
    for (const auto& [time, pressure] : run_to_end(run, "pressure", 10.0))
        ends.push_back(time);
    EXPECT_EQ(ends, (std::vector<double>{1.0, 1.5, 2.0}));
}

TEST(Ramp, RestsAtThePointsOfItsTableUnlessToldOtherwise) {
    const Component c = program({{"pressure", loading}});
    ProgramRun run(c);
    const auto commanded = run_to_end(run, "pressure", 1e-3);
    EXPECT_NEAR(commanded[0][1], 100e3 + 300e3 * 10e-9, 1e-3); // 10 s^3 of the rise
    EXPECT_NEAR(commanded[499][1], 250e3, 1e-3);               // half way
}

TEST(Ramp, MovesTheControlThatItNames) {
    const Component c =
        program({{"velocity", Points{{0.0, 0.0}, {1.0, 1e-3}}}, {"control", "plate"}, {"until", 3.0}});
    ProgramRun run(c);
    run_to_end(run, "plate", 0.1);
    EXPECT_EQ(run.commanded("plate"), 1e-3);
    EXPECT_NEAR(run.time, 3.0, 1e-12);
    const auto& api = c.api<gault_program_api>();
    EXPECT_STREQ(api.instance_signals(c.self())->controls[0].unit, "m/s");
    EXPECT_STREQ(api.instance_signals(c.self())->records[0].unit, "m/s");
}

TEST(Ramp, TellsAWallToTakeItsPressure) {
    const Component pressing = program({{"pressure", loading}});
    ProgramRun run(pressing);
    run_to_end(run, "pressure", 0.1);
    EXPECT_EQ(run.commanded("drive"), 1.0);
    const auto signals = [](const Component& c) {
        return c.api<gault_program_api>().instance_signals(c.self());
    };
    EXPECT_EQ(signals(pressing)->controls[0].flags, 0u);
    EXPECT_EQ(signals(pressing)->controls[1].flags, +GAULT_SIGNAL_OPTIONAL);
    const Component moving = program({{"velocity", Points{{0.0, 0.0}, {1.0, 1e-3}}}});
    EXPECT_EQ(signals(moving)->control_count, 1u);
    const Component elsewhere = program({{"pressure", loading}, {"control", "suction"}});
    EXPECT_EQ(signals(elsewhere)->control_count, 1u);
}

TEST(Ramp, EmitsEvenlySpacedRowsAndItsEnds) {
    const Component c = program({{"pressure", loading}, {"rows", 10}});
    ProgramRun run(c);
    run_to_end(run, "pressure", 0.01);
    ASSERT_EQ(run.rows.size(), 11u);
    EXPECT_EQ(run.recorded(run.rows.front(), "set_value"), 100e3);
    EXPECT_EQ(run.recorded(run.rows[5], "set_value"), 400e3);
    EXPECT_EQ(run.recorded(run.rows.back(), "set_value"), 200e3);
}

TEST(Ramp, RecordsForceOverCurrentAreaOfItsSurface) {
    const Component c = program({{"pressure", loading}});
    ProgramRun run(c);
    run.measured("radius") = 2.0;
    run.measured("displacement") = 0.01;
    run.measured("normal_force") = 5e6;
    run.measured("area") = 20.0;
    ASSERT_EQ(run.advance(0.1), GAULT_OK);
    EXPECT_EQ(run.recorded(run.rows[0], "true_pressure"), 250e3);
    EXPECT_EQ(run.recorded(run.rows[0], "radius"), 2.0);
    EXPECT_EQ(run.recorded(run.rows[0], "displacement"), 0.01);
    EXPECT_EQ(run.recorded(run.rows[0], "normal_force"), 5e6);
}

TEST(Ramp, RefusesNoTableTwoTablesOrNoDuration) {
    EXPECT_THROW(program({}), Invalid);
    EXPECT_THROW(program({{"pressure", loading}, {"velocity", loading}}), Invalid);
    EXPECT_THROW(program({{"pressure", Points{{0.0, 1.0}}}}), Invalid);
}

} // namespace
