#include "settings_test.hpp"

#include <gtest/gtest.h>

namespace {
using namespace plugin_test;

constexpr double soil = 1e6;        // Pa a cavity strain
constexpr double at_rest = 50e3;    // Pa, pressure of a cavity of radius a0
constexpr double arrival = 1.1e-12; // cavity strain, of a wall that was sent somewhere

// A cavity in a soil whose pressure rises evenly with the cavity strain. Without inertia, steps are repeatable.
struct Cavity {
    explicit Cavity(const Component& c, bool repeatable = false) : run(c) {
        run.repeatable = repeatable;
        measure();
    }

    double strain() const { return radius / a0 - 1.0; }
    double pressure() const { return at_rest + soil * strain(); }
    void measure() {
        run.measured("radius") = radius;
        run.measured("initial_radius") = a0;
        run.measured("area") = 2.0 * M_PI * radius * height;
        run.measured("initial_area") = 2.0 * M_PI * a0 * height;
        run.measured("normal_force") = pressure() * run.measured("area");
        run.measured("enclosed_volume") = M_PI * radius * radius * height;
    }
    void step(double dt, double taken = 1.0) { // the host may take a part of what it announced
        gault_status status = run.advance(dt);
        if (status == GAULT_RETRY) {
            ++retries;
            const double length = run.suggest * last_dt;
            radius = radius_before;
            status = run.repeat(length);
        }
        ASSERT_EQ(status, GAULT_OK) << run.error.text;
        if (run.done) return;
        run.shorten(taken);
        radius_before = radius;
        last_dt = run.dt();
        if (run.commanded("drive") > 0.5)
            radius = a0 * (1.0 + (run.commanded("pressure") - at_rest) / soil);
        else
            radius += run.commanded("velocity") * run.dt();
        run.time += run.dt();
        measure();
    }
    void finish(double dt) {
        for (int i = 0; !run.done; ++i) {
            ASSERT_LT(i, 1000000);
            step(dt);
        }
    }
    double last(const std::string& record) const { return run.recorded(run.rows.back(), record); }
    std::vector<double> column(const std::string& record) const {
        std::vector<double> values;
        for (const auto& row : run.rows)
            values.push_back(run.recorded(row, record));
        return values;
    }

    ProgramRun run;
    double radius = a0, radius_before = a0, last_dt = 0.0;
    int retries = 0;
};

TEST(Pressuremeter, EndsExactlyAtTheWantedStrainWhateverTheStep) {
    for (const double dt : {1e-4, 3.3e-3, 0.77}) {
        const Component c = program({{"rate", 1e-3}});
        Cavity cavity(c);
        cavity.finish(dt);
        EXPECT_NEAR(cavity.radius / a0 - 1.0, 0.1, arrival) << dt;
        // 2 mm at 1 mm/s, and half of the start, which takes 2 x 0.05 % x 20 mm / (1 mm/s).
        EXPECT_NEAR(cavity.run.time, 2.0 + 0.5 * 0.02, 1e-12) << dt;
    }
}

// A smooth start moves the wall by less than its radius resolves.
TEST(Pressuremeter, DoesNotTakeRoundingForACavityThatCloses) {
    const Component c = program({{"rate", 1e-3}});
    Cavity cavity(c);
    cavity.step(1e-6);
    cavity.radius = std::nextafter(cavity.radius, 0.0);
    cavity.measure();
    cavity.step(1e-6);
    cavity.radius = a0 * (1.0 - 1e-10);
    cavity.measure();
    EXPECT_EQ(cavity.run.advance(1e-6), GAULT_FAILED);
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
    EXPECT_NEAR(cavity.radius / a0 - 1.0, 1e-3, arrival);
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
        EXPECT_GE(strain, 0.01 * static_cast<double>(i) - arrival);
        EXPECT_LE(strain, 0.01 * static_cast<double>(i) + 1e-3 * 1e-3 / a0); // within one step
    }
}

TEST(Pressuremeter, TellsTrueFromNominalPressure) {
    const Component c = program({{"rate", 1e-3}});
    Cavity cavity(c);
    cavity.finish(1e-2);
    const auto& last = cavity.run.rows.back();
    EXPECT_NEAR(cavity.run.recorded(last, "true_pressure"), 1.5e5, 1e-4);
    EXPECT_NEAR(cavity.run.recorded(last, "nominal_pressure"), 1.65e5, 1e-4);
    EXPECT_NEAR(cavity.run.recorded(last, "cavity_radius"), 0.022, arrival * a0);
    EXPECT_NEAR(cavity.run.recorded(last, "volume"), M_PI * 0.022 * 0.022 * height,
                2.0 * arrival * M_PI * 0.022 * 0.022 * height);
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

// ---- phases ----

using Phases = std::vector<Record>;

Record ending(const std::string& kind, const std::string& event, double value, Settings more = {}) {
    more["until"] = Phases{{event, {{"value", value}}}};
    return {kind, more};
}
Component test_of(const Phases& phases, Settings more = {}) {
    more.try_emplace("strain_rate", 0.01);
    more["phases"] = phases;
    return {"pressuremeter", GAULT_PROGRAM, "pressuremeter", more};
}

TEST(PressuremeterPhases, FollowOneAnotherAndMeetTheirEndsExactly) {
    const Phases phases{ending("expand", "cavity_strain", 0.02),
                        ending("expand", "pressure", 85e3, {{"pressure_rate", 1e3}}),
                        ending("unload", "pressure", 60e3), ending("expand", "volume_ratio", 1.21),
                        ending("unload", "cavity_strain", 0.05, {{"rate", 1e-3}})};
    const Component c = test_of(phases);
    for (const bool repeatable : {true, false}) {
        Cavity cavity(c, repeatable);
        cavity.finish(repeatable ? 0.73 : 1e-4);
        const auto phase = cavity.column("phase"), strain = cavity.column("cavity_strain");
        const std::vector<double> ends{0.02, 0.035, 0.01, 0.1, 0.05};
        for (std::size_t i = 0; i < ends.size(); ++i) {
            const auto last = std::find(phase.rbegin(), phase.rend(), static_cast<double>(i + 1));
            ASSERT_NE(last, phase.rend());
            const double end = strain[static_cast<std::size_t>(phase.rend() - last) - 1];
            // Pressures are met to 1e-6 of the largest of the phase; where steps cannot be repeated, to one of them.
            EXPECT_NEAR(end, ends[i], repeatable ? 2e-7 : 1.1 * 0.01 * 1e-4) << i;
        }
    }
}

TEST(PressuremeterPhases, StopTheWallSmoothlyBeforeItTurns) {
    const Component c =
        test_of({ending("expand", "cavity_strain", 0.01), ending("unload", "cavity_strain", 0.009)},
                {{"ramp_time", 0.1}});
    Cavity cavity(c);
    const double dt = 1e-4, speed = 0.01 * a0;
    double fastest = 0.0, jump = 0.0, before = 0.0;
    while (!cavity.run.done) {
        cavity.step(dt);
        const double velocity = cavity.run.commanded("velocity");
        fastest = std::max(fastest, velocity);
        if (cavity.run.time < 1.05) jump = std::max(jump, std::abs(velocity - before));
        before = velocity;
    }
    EXPECT_NEAR(fastest, speed, 1e-9);
    EXPECT_LE(jump, 15.0 / 8.0 * speed / 0.1 * dt * 1.001); // the quintic's steepest slope
    EXPECT_NEAR(cavity.strain(), 0.009, arrival);
}

TEST(PressuremeterPhases, RepeatAStepThatOvershootsAnEvent) {
    const Component c = test_of({ending("expand", "pressure", 80e3)});
    Cavity cavity(c, true);
    cavity.finish(1.0); // events are foreseen from the last step only: the third second would pass it
    EXPECT_NEAR(cavity.last("true_pressure"), 80e3, 80e3 * 1e-6);
    const Component first = test_of({ending("expand", "pressure", 52e3)});
    Cavity early(first, true);
    early.finish(1.0);
    EXPECT_EQ(early.retries, 1);
    EXPECT_NEAR(early.last("true_pressure"), 52e3, 52e3 * 1e-6);
}

TEST(PressuremeterPhases, EndAtTheFirstOfSeveralEvents) {
    const Component c = test_of({{"expand",
                                  {{"until", Phases{{"cavity_strain", {{"value", 0.1}}},
                                                    {"pressure", {{"value", 75e3}}},
                                                    {"duration", {{"value", 100.0}}}}}}}});
    Cavity cavity(c, true);
    cavity.finish(0.4);
    EXPECT_NEAR(cavity.last("true_pressure"), 75e3, 0.1);
}

TEST(PressuremeterPhases, ThatAreOverBeforeTheyBeginTakeNoTime) {
    const Component c = test_of({ending("expand", "cavity_strain", 0.02),
                                 ending("expand", "pressure", 60e3),
                                 {"hold", {{"duration", 0.0}}},
                                 ending("expand", "cavity_strain", 0.03)});
    Cavity cavity(c, true);
    cavity.finish(0.5);
    EXPECT_NEAR(cavity.strain(), 0.03, 1e-12);
    EXPECT_NEAR(cavity.run.time, 3.0, 1e-9);
    EXPECT_EQ(cavity.last("phase"), 4.0);
}

TEST(PressuremeterPhases, HoldAPressureWithReadings) {
    const Component c =
        test_of({ending("expand", "cavity_strain", 0.02),
                 {"hold", {{"duration", 100.0}, {"readings", Points{{0.0, 60.0}, {0.0, 30.0}}}}}});
    Cavity cavity(c, true);
    cavity.finish(500.0);
    const std::vector<double>& times = cavity.run.times;
    const std::size_t n = times.size();
    ASSERT_GE(n, 4u);
    EXPECT_NEAR(times[n - 3], 2.0 + 30.0, 1e-9);
    EXPECT_NEAR(times[n - 2], 2.0 + 60.0, 1e-9);
    EXPECT_NEAR(times[n - 1], 2.0 + 100.0, 1e-9);
    EXPECT_NEAR(cavity.pressure(), at_rest + 0.02 * soil, 1e-6);
}

// A time of 1e7 s is known to 2e-9 s, in which the wall moves further than rounding of the strain.
TEST(PressuremeterPhases, MeetAStrainAfterALongTime) {
    for (const double wait : {1e7, 1e9})
        for (const bool repeatable : {true, false}) {
            const Component c = test_of({{"hold", {{"duration", wait}, {"of", 1.0}}},
                                         ending("expand", "cavity_strain", 0.02),
                                         ending("unload", "cavity_strain", 0.01)});
            Cavity cavity(c, repeatable);
            for (int i = 0; i < 2000 && !cavity.run.done; ++i) {
                cavity.step(cavity.run.time < wait ? wait : 0.013);
                ASSERT_TRUE(std::isfinite(cavity.run.commanded("velocity"))) << wait;
            }
            EXPECT_TRUE(cavity.run.done) << wait;
            EXPECT_NEAR(cavity.strain(), 0.01, 4.0 * 0.01 * 2.3e-16 * wait) << wait;
        }
}

// Steps without inertia go no further than a twentieth of the radius at once.
TEST(Pressuremeter, LooksAheadByATwentiethOfTheRadius) {
    for (const Settings& speed : {Settings{{"rate", 1e-3}}, Settings{{"strain_rate", 0.05}}}) {
        Settings settings = speed;
        settings["until"] = std::vector<Record>{{"pressure", {{"value", 1e6}}}};
        const Component c = program(settings);
        Cavity cavity(c, true);
        cavity.step(1e9);
        EXPECT_NEAR(cavity.run.next, 1.0, 1e-9); // 1 mm
    }
}

TEST(PressuremeterPhases, LoopReturnsToWhereItBegan) {
    for (const char* amplitude : {"strain_amplitude", "pressure_amplitude"}) {
        const double fall = std::string(amplitude) == "strain_amplitude" ? 0.005 : 5e3;
        const Component c = test_of({ending("expand", "cavity_strain", 0.02),
                                     {"loop", {{amplitude, fall}, {"count", 2.0}}},
                                     ending("expand", "cavity_strain", 0.03),
                                     {"loop", {{amplitude, fall}}}});
        Cavity cavity(c, true);
        cavity.finish(0.3);
        const auto loop = cavity.column("loop"), strain = cavity.column("cavity_strain");
        for (int number = 1; number <= 3; ++number) {
            double lowest = 1.0, last = 0.0;
            for (std::size_t i = 0; i < loop.size(); ++i)
                if (loop[i] == number) lowest = std::min(lowest, strain[i]), last = strain[i];
            const double start = number < 3 ? 0.02 : 0.03;
            EXPECT_NEAR(lowest, start - 0.005, 2e-7) << amplitude << number;
            EXPECT_NEAR(last, start, 2e-7) << amplitude << number;
        }
    }
}

TEST(PressuremeterPhases, ClimbInPressureStepsUntilTheVolumeHasDoubled) {
    Record steps = ending("pressure_steps", "volume_ratio", 2.0, {{"increment", 100e3}, {"hold", 60.0}});
    const Component c = test_of({steps});
    Cavity cavity(c, true);
    cavity.finish(1000.0);
    EXPECT_NEAR(cavity.strain(), std::sqrt(2.0) - 1.0, 1e-7);
    const auto number = cavity.column("pressure_step"), held = cavity.column("held"),
               pressure = cavity.column("true_pressure");
    std::map<int, std::vector<double>> readings; // times since the hold began
    for (std::size_t i = 0; i < number.size(); ++i) {
        if (held[i] == 0.0) continue;
        const int n = static_cast<int>(number[i]);
        readings[n].push_back(cavity.run.times[i] - (61.0 * n - 60.0));
        EXPECT_NEAR(pressure[i], at_rest + 100e3 * n, 0.2);
    }
    ASSERT_EQ(readings.size(), 4u); // the fifth would pass 41.4 % at 464 kPa
    for (const auto& [n, at] : readings) {
        ASSERT_EQ(at.size(), 4u) << n;
        const std::vector<double> expected{1.0, 15.0, 30.0, 60.0};
        for (std::size_t i = 0; i < 4; ++i)
            EXPECT_NEAR(at[i], expected[i], 1e-5); // a pressure is met to 1e-6 of it
    }
}

TEST(PressuremeterPhases, NoticeAFallOfThePressureFromItsPeak) {
    const Component c = test_of({ending("expand", "pressure_drop", 10e3)});
    ProgramRun run(c);
    run.repeatable = true;
    double radius = a0, before = a0;
    const auto measure = [&] { // peak 100 kPa at 4 % cavity strain
        const double strain = radius / a0 - 1.0, area = 2.0 * M_PI * radius * height;
        run.measured("radius") = radius;
        run.measured("initial_radius") = a0;
        run.measured("initial_area") = run.measured("area") = area;
        run.measured("normal_force") = (100e3 - 1e8 / 2.0 * std::pow(strain - 0.04, 2)) * area;
        run.measured("enclosed_volume") = M_PI * radius * radius * height;
    };
    measure();
    for (int i = 0; i < 1000 && !run.done; ++i) {
        const double dt = run.dt();
        if (run.advance(0.35) == GAULT_RETRY) {
            radius = before;
            ASSERT_EQ(run.repeat(run.suggest * dt), GAULT_OK);
        }
        if (run.done) break;
        before = radius;
        radius += run.commanded("velocity") * run.dt();
        run.time += run.dt();
        measure();
    }
    // Steps of 0.35 % may miss the peak by half of that, which lowers it by 153 Pa and shifts the end by as much.
    EXPECT_NEAR(radius / a0 - 1.0, 0.04 + std::sqrt(2e4 / 1e8), 153.0 / 1e8 / 0.0141 * 1.1);
    EXPECT_LT(radius / a0 - 1.0, 0.06);
}

TEST(PressuremeterPhases, CommandThePressureOnlyWhereAPhaseDrivesIt) {
    const auto flags = [](const Component& c, uint32_t control) {
        return c.api<gault_program_api>().instance_signals(c.self())->controls[control].flags &
               GAULT_SIGNAL_OPTIONAL;
    };
    const Component wall = test_of({ending("expand", "cavity_strain", 0.1)});
    EXPECT_FALSE(flags(wall, 0));
    EXPECT_TRUE(flags(wall, 1));
    const Component fluid = test_of({ending("pressure_steps", "volume_ratio", 2.0, {{"increment", 50e3}})});
    EXPECT_TRUE(flags(fluid, 0));
    EXPECT_FALSE(flags(fluid, 1));
}

std::string refusal(const Phases& phases, Settings more = {}) {
    more["phases"] = phases;
    try {
        const Component c("pressuremeter", GAULT_PROGRAM, "pressuremeter", more);
    } catch (const Invalid& e) {
        return e.parameter + ": " + e.what();
    }
    return "";
}

TEST(PressuremeterPhases, AreRefusedWithTheirNumber) {
    const Settings speed{{"rate", 1e-3}};
    EXPECT_EQ(refusal({ending("expand", "cavity_strain", 0.1)}),
              "phases: phase 1 (expand): give it a rate, a strain_rate or a pressure_rate, or the program a "
              "rate or strain_rate");
    EXPECT_EQ(refusal({ending("expand", "pressure", 1e5), {"loop", {}}}, speed),
              "phases: phase 2 (loop): give one of strain_amplitude and pressure_amplitude");
    EXPECT_EQ(refusal({ending("unload", "pressure", 0.0, {{"rate", 1e-3}, {"pressure_rate", 10.0}})}, speed),
              "phases: phase 1 (unload): give one of rate, strain_rate and pressure_rate");
    EXPECT_EQ(refusal({{"pressure_steps", {{"increment", 1e5}}}}),
              "phases: phase 1 (pressure_steps): give count or until: something must end it");
    Settings both = speed;
    both["until"] = until(0.1);
    EXPECT_EQ(refusal({ending("expand", "cavity_strain", 0.1)}, both).substr(0, 6), "until:");
}

} // namespace
