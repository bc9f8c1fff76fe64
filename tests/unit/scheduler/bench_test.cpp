// What `gault bench` reports of programs whose end nobody foresees.
#include "core/scheduler/bench.hpp"
#include "tests/unit/solver/small_scene.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace gault::core::test {
namespace {

class Bench : public testing::Test {
  protected:
    TestMaterial soil{40e6, 30e6};
    TestProgram program;
    SmallScene s{Shape{}};

    // Ten steps, of which the program says how long the `foreseen` time still is; states change in every one.
    BenchReport report(double foreseen) {
        soil.states = {{"steps", "1", "", GAULT_SCALAR, 0, 0.0, 0.0, 100.0}};
        soil.update = [this](gault_points& p, gault_error&) {
            soil.elastic(p);
            for (int64_t i = 0; i < p.count; ++i)
                p.state[0][i] = p.state_old[0][i] + 1.0;
            return gault_status(GAULT_OK);
        };
        s.add(soil, 1600.0);
        program.records = {{"tens", "1", "", 0.0}};
        program.advance = [foreseen](gault_step& step, gault_error&) {
            step.record[0] = 10.0 * static_cast<double>(step.index);
            step.emit = 1;
            step.next = step.time + foreseen;
            step.done = step.index == 10;
            return gault_status(GAULT_OK);
        };
        s.add(program);
        return bench_scene(s.scene, 1, 0.25);
    }
};

TEST_F(Bench, TimesTheWholeRunWhereNoEndIsKnown) {
    for (const double foreseen : {HUGE_VAL, 1.0}) {
        s = SmallScene{Shape{}};
        const BenchReport all = report(foreseen);
        EXPECT_EQ(all.steps, 10);
        EXPECT_EQ(all.changing, 1.0);
        EXPECT_GT(all.point_steps, 0.0);
        double share = 0.0;
        for (const auto& phase : all.phases)
            share += phase.share;
        EXPECT_NEAR(share, 1.0, 1e-9);
    }
}

TEST_F(Bench, HasNoErrorWhereTheCurveCannotBeCompared) {
    const std::string file = testing::TempDir() + "gault-bench-" + std::to_string(getpid()) + ".csv";
    std::ofstream(file) << "time_s,tens_1\n5,1\n6,2\n"; // later than the run
    s.scene.curves = {{"time", "tens", file, 5.0, 6.0, {}, {}}};
    EXPECT_TRUE(std::isnan(report(HUGE_VAL).curve_error));
    std::filesystem::remove(file);
}

} // namespace
} // namespace gault::core::test
