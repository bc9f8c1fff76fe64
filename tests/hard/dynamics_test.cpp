#include "tests/hard/hard_scene.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <complex>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <sstream>
#include <unistd.h>

namespace gault::core::test {
namespace {

constexpr double pi = std::numbers::pi;

// ---- breathing ring -----------------------------------------------------------------------------------

constexpr double first_mode = 433.95, second_mode = 1090.1; // Hz, free-free

struct Signal {
    std::vector<double> time, value;
};

// Amplitude at a frequency over a window, seen through a Hann window: other modes are 60 dB down.
double amplitude(const Signal& s, double frequency, double from, double to) {
    std::complex<double> sum = 0.0;
    double weights = 0.0;
    for (std::size_t i = 1; i < s.time.size(); ++i) {
        const double t = s.time[i];
        if (t < from || t > to) continue;
        const double weight =
            (s.time[i] - s.time[i - 1]) * std::pow(std::sin(pi * (t - from) / (to - from)), 2);
        sum += weight * s.value[i] * std::polar(1.0, -2.0 * pi * frequency * t);
        weights += weight;
    }
    return 2.0 * std::abs(sum) / weights;
}

// The frequency of the largest amplitude near a guess, by golden section.
double peak(const Signal& s, double guess, double from, double to) {
    double low = 0.97 * guess, high = 1.03 * guess;
    const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
    for (int n = 0; n < 60; ++n) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        (amplitude(s, a, from, to) > amplitude(s, b, from, to) ? high : low) =
            amplitude(s, a, from, to) > amplitude(s, b, from, to) ? b : a;
    }
    return 0.5 * (low + high);
}

class BreathingRing : public testing::TestWithParam<const char*> {
  protected:
    std::vector<Override> with(std::vector<Override> more = {}) const {
        more.push_back({"model.frame", GetParam()});
        return more;
    }
};
INSTANTIATE_TEST_SUITE_P(Frames, BreathingRing, testing::Values("total", "updated"),
                         [](const auto& instance) { return std::string(instance.param); });

struct Modes { // Hz
    double first, second;
};

void expect_modes(const std::vector<Override>& overrides, const char* what, const Modes& exact) {
    HardScene s("hard/breathing", overrides);
    Signal wall;
    s.run([&] {
        wall.time.push_back(s.solver.time());
        wall.value.push_back(s.solver.measure("displacement", low_x).value());
    });
    const double period = 1.0 / exact.first, start = 12e-3; // the pressure is gone at 11 ms
    const double first = peak(wall, exact.first, start, start + 20 * period);
    const double second = peak(wall, exact.second, start, start + 20 * period);
    const double early = amplitude(wall, first, start, start + 10 * period);
    const double late = amplitude(wall, first, start + 10 * period, start + 20 * period);
    std::printf(
        "%s: %.2f Hz, exact %.2f; %.1f Hz, exact %.1f; amplitude after 10 periods %.5f of the first\n", what,
        first, exact.first, second, exact.second, late / early);
    EXPECT_NEAR(first, exact.first, 0.005 * exact.first);
    EXPECT_NEAR(second, exact.second, 0.005 * exact.second);
    EXPECT_NEAR(late, early, 0.01 * early);
    EXPECT_GT(early, 1e-8); // m
}

TEST_P(BreathingRing, RingsAtItsNaturalFrequencyWithoutLoss) {
    expect_modes(with(), GetParam(), {first_mode, second_mode});
}

TEST_P(BreathingRing, RingsWithItsOutsideHeld) {
    expect_modes(with({{"boundaries.2", "{on: outer, type: roller}"},
                       {"grid", "{cells: [80, 1], grading: {r: 1.015}}"}}),
                 GetParam(), {786.78, 1409.9});
}

TEST_P(BreathingRing, IsStableBelowTheLimitAndKeepsItsEnergy) {
    HardScene s("hard/breathing", with({{"solver.time_step_factor", "0.95"}}));
    std::vector<std::array<double, 3>> energies; // time, kinetic + internal, kinetic
    s.run([&] {
        const Energies e = s.solver.energies();
        energies.push_back({s.solver.time(), e.kinetic + e.internal, e.kinetic});
    });
    const auto mean = [&](double from, double to) {
        double sum = 0.0, span = 0.0;
        for (std::size_t i = 1; i < energies.size(); ++i) {
            if (energies[i][0] < from || energies[i][0] > to) continue;
            sum += energies[i][1] * (energies[i][0] - energies[i - 1][0]);
            span += energies[i][0] - energies[i - 1][0];
        }
        return sum / span;
    };
    const double period = 1.0 / first_mode, early = mean(12e-3, 12e-3 + 10 * period);
    EXPECT_GT(early, 0.0);
    const double late = mean(12e-3 + 10 * period, 12e-3 + 20 * period);
    std::printf("%s: energy after 10 periods at 0.95 of the limit %.6f of the first\n", GetParam(),
                late / early);
    EXPECT_NEAR(late, early, 1e-3 * early);
    double largest = 0.0;
    for (const auto& e : energies)
        largest = std::max(largest, e[1]);
    EXPECT_LT(largest, 1.0) << "of some mJ";
}

TEST_P(BreathingRing, StopsWithAnExplanationBeyondTheLimit) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("gault-hard-" + std::to_string(getpid()));
    const Scene scene = scene_of("hard/breathing", with({{"solver.time_step_factor", "1.1"}}));
    RunOptions options;
    options.folder = folder;
    options.quiet = true;
    std::string text;
    try {
        run_scene(scene, options);
    } catch (const RunError& error) {
        text = error.what();
    }
    EXPECT_TRUE(text.starts_with("step ")) << text;
    for (const char* part : {", t = ", "of 'soil' at (",
                             "solver.time_step_factor is 1.1: above 1 the step exceeds the stability limit"})
        EXPECT_NE(text.find(part), std::string::npos) << text;
    std::stringstream history, summary;
    history << std::ifstream(folder / "history.csv").rdbuf();
    summary << std::ifstream(folder / "summary.json").rdbuf();
    std::filesystem::remove_all(folder);
    EXPECT_GT(history.str().size(), 100u);
    EXPECT_EQ(history.str().find("nan"), std::string::npos);
    EXPECT_EQ(history.str().find("inf"), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(summary.str())["status"], "failed");
}

// ---- a wall that starts at once -----------------------------------------------------------------------

// The mean pressure on the wall until its wave has gone a distance x a. For lame = G the wave equation gives
// p = rho c v (1 + x/6 + 3 x^2/16 - x^3/16 + ...), from K1'/K1 at large arguments. Measured from the work
// done on the wall, which is force times velocity times time.
double mean_pressure(const char* frame, const char* mass_scaling, const char* until) {
    HardScene s("hard/wall_impact", {{"model.frame", frame},
                                     {"solver.mass_scaling", mass_scaling},
                                     {"program.until.cavity_strain", until}});
    s.run();
    const double area = 2 * pi * 0.02 * 1e-3;
    return s.solver.energies().external / (1e-3 * area * s.solver.time());
}

class WallImpact : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Frames, WallImpact, testing::Values("total", "updated"),
                         [](const auto& instance) { return std::string(instance.param); });

TEST_P(WallImpact, MeetsTheImpedanceOfTheSoil) {
    const double c = std::sqrt(120e6 / 1600.0), jump = 1600.0 * c * 1e-3;
    EXPECT_NEAR(jump, 438.0, 0.5); // Pa
    const double time = 0.0002e-2 * 0.02 / 1e-3, x = c * time / 0.02;
    const double mean = jump * (1.0 + x / 12 + x * x / 16 - x * x * x / 64);
    // The wall's node starts at once: half its mass times v^2, and half a step, are a few parts in a
    // thousand.
    const double measured = mean_pressure(GetParam(), "1", "0.0002 %");
    // A tenth of the speed for ten times as long.
    const double heavy = mean_pressure(GetParam(), "100", "0.002 %");
    std::printf("%s: mean pressure %.2f Pa, exact %.2f; with 100 times the mass %.2f, exact %.2f\n",
                GetParam(), measured, mean, heavy, 10.0 * mean);
    EXPECT_NEAR(measured, mean, 0.005 * jump);
    EXPECT_NEAR(heavy, 10.0 * mean, 0.05 * jump);
}

} // namespace
} // namespace gault::core::test
