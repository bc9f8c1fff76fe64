// Walls that turn back at every step or start at once, phases without length, steps far too long.
#include "tests/hard/closed_forms.hpp"
#include "tests/hard/ways.hpp"

namespace gault::core::test {
namespace {

constexpr double density = 1600.0, p_wave_modulus = 120e6; // of the sand, kg/m^3, Pa

class Loading : public EveryWay {};
INSTANTIATE_TEST_SUITE_P(Ways, Loading, every_way(), name_of_way);

// Velocities -v, v, -v, ... at the ends of steps of this length.
std::string reversing(double velocity, double step, int steps) {
    std::string table;
    for (int k = 0; k <= steps; ++k)
        table += fmt::format("{}[{:.12g} s, {:.12g} m/s]", k > 0 ? ", " : "", k * step,
                             k % 2 ? velocity : -velocity);
    return "[" + table + "]";
}

// Without inertia the sand is back where it was after every second step. With inertia a step is as long as is stable, and
// what the wall sends out at each turn is at most the wave of its velocity, rho c v, to either side.
TEST_P(Loading, TurnsBackAtEveryStep) {
    const double velocity = 1e-3, probe = HardScene("hard/reversing_wall", with()).solver.allowed_step();
    const double step = has_inertia() ? 0.5 * probe : 10e-3;
    const int steps = has_inertia() ? 4000 : 40;
    HardScene s("hard/reversing_wall", with({{"program.velocity", reversing(velocity, step, steps)},
                                             {"program.rows", std::to_string(steps)},
                                             {"solver", "{tolerance: 1e-9}"}}));
    double early = 0.0, late = 0.0; // largest change of a raw stress after even steps, Pa
    s.run([&] {
        if (s.solver.steps() % 2 != 0) return;
        const PointArrays p = s.points();
        double& largest = s.solver.steps() <= steps / 2 ? early : late;
        for (const auto& stress : p.stress)
            for (std::size_t i = 0; i < stress.size(); ++i)
                if (&stress < &p.stress[3]) largest = std::max(largest, std::abs(stress[i] + 90e3));
    });
    EXPECT_EQ(s.solver.steps(), steps);
    EXPECT_NEAR(s.last("displacement"), 0.0, 1e-9 * velocity * step * steps);
    const double wave = 2.0 * velocity * std::sqrt(density * p_wave_modulus);
    // In the updated frame functions change with the place of the points, so that a way there and back leaves a little.
    const Lame lame{0.02, 0.2, 1.0, 0.0, 100e6, 0.25};
    const double swing = velocity * step / lame.displacement(0.02);
    const double bound = has_inertia() ? wave : updated() ? 1e-3 * swing : 1e-6 * 90e3;
    expect_below("change of stress, first half, Pa", early, bound);
    expect_below("change of stress, second half, Pa", late, bound);
    if (!has_inertia()) { // the last step but one has opened the cavity by 0.05 %
        const auto p = s.column("true_pressure");
        expect_near("pressure in between, kPa", p[p.size() - 2] / 1e3, 90.0 + swing / 1e3, 1e-3);
    }
}

TEST_P(Loading, PassesPhasesWithoutLength) {
    HardScene with_them("hard/phases_without_length", with());
    HardScene without("hard/phases_without_length", with({moved_to({0.01, 0.02}, "10 mm/s", false, false)}));
    with_them.run();
    without.run();
    for (const double strain : {0.01, 0.02})
        expect_near(fmt::format("pressure at {:g} %, kPa", 100.0 * strain),
                    pressure_at_strain(with_them, strain), pressure_at_strain(without, strain), 1e-9);
    EXPECT_EQ(with_them.solver.steps(), without.solver.steps());
}

class LongSteps : public EveryWay {};
INSTANTIATE_TEST_SUITE_P(Ways, LongSteps, every_way(), name_of_way);

TEST_P(LongSteps, AHundredTimesTooLong) {
    if (!has_inertia()) { // 50 % of strain; the program looks at the soil at least every 5 %
        HardScene s("hard/sand_cavity", with({{"solver", "{strain_step: 50 %}"}}));
        s.run();
        std::printf("%d steps\n", static_cast<int>(s.solver.steps()));
        expect_near("10 % in long steps", s.last("true_pressure") / 1e3, 1348.39, 0.01);
        return;
    }
    HardScene s("hard/sand_cavity", with());
    s.simulation.start();
    const double step = 100.0 * s.solver.stability_limit();
    std::string text;
    while (text.empty() && s.solver.steps() < 100)
        try {
            s.simulation.program().advance(0.0, step);
            s.solver.step(step);
        } catch (const RunError& error) {
            text = error.what();
        }
    std::printf("%-22s after %d steps: %s\n", GetParam().name().c_str(), static_cast<int>(s.solver.steps()),
                text.c_str());
    EXPECT_NE(text, "");
    const PointArrays p = s.points();
    for (const auto& stress : p.stress)
        for (const double component : stress)
            EXPECT_TRUE(std::isfinite(component));
}

// Fahey's cylinder at ten times the rate of the test: a wall that starts at once sends a wave of 4.4 kPa through it.
class SmoothStart : public EveryWay {};
INSTANTIATE_TEST_SUITE_P(Frames, SmoothStart,
                         testing::Values(Way{"total", "explicit"}, Way{"updated", "explicit"}), name_of_way);

TEST_P(SmoothStart, IsForgottenAtTenPercent) {
    for (const auto& [start, tolerance] :
         {std::pair{"ramp_time: 1 ns", 5e-3}, {"ramp_strain: 0.05 %", 2e-3}}) {
        HardScene s(
            "hard/sand_cavity",
            with(
                {{"geometry.annulus.outer_radius", "200 mm"},
                 {"grid.cells", "30"},
                 {"boundaries.0", "{on: outer, type: pressure, value: 90 kPa}"},
                 {"program",
                  fmt::format(
                      "{{type: pressuremeter, on: inner, rate: 10 mm/s, {}, until: {{cavity_strain: 10 %}}}}",
                      start)}}));
        expect_near(fmt::format("10 %, {}", start), s.run().last("true_pressure") / 1e3, 597.34, tolerance);
    }
}

} // namespace
} // namespace gault::core::test
