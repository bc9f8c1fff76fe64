// A run that is interrupted, or killed, leaves what it had.
#include "tests/app/child.hpp"

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

namespace gault::test {
namespace {

using std::chrono::milliseconds;

class Interrupted : public App {
  protected:
    Words words(const std::string& frames, const Words& more) const {
        Words all{"run",   (repository / "configs/paper/fahey.yaml").string(),
                  "-o",    "results",
                  "--set", "reference={}",
                  "--set", "output.frames.cavity_strain=" + frames};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    // As soon as a file is there, or the child has ended.
    static void wait_for(const fs::path& file, Child& child) {
        while (!fs::exists(file) && !child.ended())
            std::this_thread::sleep_for(milliseconds(1));
    }

    // Whatever of the results is there is whole. The number of frames.
    std::size_t expect_whole_results(std::size_t points) const {
        if (fs::exists(results / "history.csv")) {
            const std::string text = core::test::text_of(results / "history.csv");
            EXPECT_TRUE(text.empty() || text.back() == '\n');
        }
        if (fs::exists(results / "summary.json")) summary(results); // throws unless it parses
        const fs::path file = results / "results.h5";
        if (!fs::exists(file)) return 0;
        const auto frames = core::test::members(file, "/frames");
        for (const std::string& frame : frames) {
            EXPECT_GT(core::test::attribute(file, "/frames/" + frame, "cavity_strain"), 0.0);
            for (const std::string& name : core::test::members(file, "/frames/" + frame))
                EXPECT_EQ(core::test::numbers(file, "/frames/" + frame + "/" + name).shape[0], points);
        }
        return frames.size();
    }
};

class BySignal : public Interrupted, public testing::WithParamInterface<int> {};

TEST_P(BySignal, RunEndsWithResultsSoFar) {
    Child child(work, words("[0.1 %, 10 %]", {"--set", "solver.mass_scaling=1"}));
    wait_for(results / "summary.json", child); // written with the first frame
    child.signal(GetParam());
    const Outcome outcome = child.wait();
    EXPECT_EQ(outcome.status, 130) << outcome.err;

    const auto s = summary(results);
    EXPECT_EQ(s["status"], "interrupted");
    EXPECT_GT(s["counts"]["steps"], 0);
    EXPECT_GT(history(results, "cavity_strain").size(), 2u);
    EXPECT_LT(history(results, "cavity_strain").back(), 0.1);
    EXPECT_EQ(core::test::text_attribute(results / "results.h5", "/", "status"), "finished");
    const std::size_t frames = expect_whole_results(1152);
    ASSERT_GT(frames, 0u);
    const std::string last = "/frames/" + core::test::members(results / "results.h5", "/frames").back();
    EXPECT_EQ(core::test::attribute(results / "results.h5", last, "time"), s["time"])
        << "the last state is a frame";
}

INSTANTIATE_TEST_SUITE_P(Signal, BySignal, testing::Values(SIGINT, SIGTERM),
                         [](const auto& use) { return use.param == SIGINT ? "INT" : "TERM"; });

TEST_F(Interrupted, ByAKillAtAnyMomentRunLeavesWholeResults) {
    std::string frames = "[0.05 %";
    const std::size_t count = 20;
    for (std::size_t k = 2; k <= count; ++k)
        frames += ", " + std::to_string(0.05 * static_cast<double>(k)) + " %";
    const Words run = words(frames + "]", {"--force", "--set", "grid.cells=[24, 1]", "--set",
                                           "points.per_cell=4", "--set", "program.until.cavity_strain=1 %"});
    const std::size_t points = 96;
    std::mt19937 random(20240607);
    std::uniform_int_distribution<std::size_t> frame(0, count - 1);
    std::uniform_int_distribution<int> microseconds(0, 20000);
    int killed_between_frames = 0;
    for (int repetition = 0; repetition < 25 && !HasFailure(); ++repetition) {
        SCOPED_TRACE(repetition);
        fs::remove_all(results);
        {
            Child child(work, run);
            char name[16];
            std::snprintf(name, sizeof name, "%04zu.h5", frame(random));
            wait_for(results / "frames" / name, child);
            std::this_thread::sleep_for(std::chrono::microseconds(microseconds(random)));
            child.signal(SIGKILL);
            child.wait();
        }
        const std::size_t found = expect_whole_results(points);
        killed_between_frames +=
            found > 0 && core::test::text_attribute(results / "results.h5", "/", "status") == "running";
    }
    EXPECT_GT(killed_between_frames, 5);
}

TEST_F(Interrupted, FolderIsUsedAgainWithForce) {
    const Words run =
        words("[0.1 %]", {"--set", "grid.cells=[24, 1]", "--set", "program.until.cavity_strain=0.5 %"});
    {
        Child child(work, run);
        wait_for(results / "summary.json", child);
        child.signal(SIGKILL);
        child.wait();
    }
    EXPECT_TRUE(has(refusal(gault(run)), "--force"));
    Words again = run;
    again.emplace_back("--force");
    EXPECT_EQ(gault(again).status, 0);
    EXPECT_EQ(summary(results)["status"], "done");
    EXPECT_FALSE(fs::exists(results / "frames"));
}

} // namespace
} // namespace gault::test
