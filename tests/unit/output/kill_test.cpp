// A run is killed at random moments, again and again in one folder; whatever is found then must be whole.
#include "tests/unit/output/support.hpp"

#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <random>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace fs = std::filesystem;
using namespace gault::core;
using namespace gault::core::test;
using std::chrono::duration;
using std::chrono::steady_clock;

namespace {

constexpr std::size_t points = 200, frames = 3, rows_a_frame = 60;

constexpr int milestones = frames + 2; // the start, every frame, the end

void whole_run(const fs::path& folder, const std::function<void()>& reached) {
    reached();
    ResultWriter out = writer(folder, points, true);
    for (std::size_t frame = 0; frame < frames; ++frame) {
        for (std::size_t i = 0; i < rows_a_frame; ++i)
            out.row(row(frame * rows_a_frame + i));
        out.frame(attributes(frame), datasets(frame, points));
        out.summary({{"status", "running"}, {"frames", frame}});
        reached();
    }
    out.finish();
    out.summary({{"status", "done"}, {"frames", frames}});
    reached();
}

// A child that makes a whole run and is killed a random moment after it has reached a random milestone.
void kill_a_run(const fs::path& folder, int milestone, duration<double> delay) {
    int reached[2];
    ASSERT_EQ(pipe(reached), 0);
    const pid_t child = fork();
    if (child == 0) {
        whole_run(folder, [&] {
            if (write(reached[1], "!", 1) != 1) _exit(1);
        });
        for (;;)
            pause();
    }
    for (char byte; milestone > 0; --milestone)
        ASSERT_EQ(read(reached[0], &byte, 1), 1);
    std::this_thread::sleep_for(delay);
    kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    close(reached[0]);
    close(reached[1]);
}

void expect_whole_history(const fs::path& file) {
    const std::string content = text_of(file);
    ASSERT_EQ(content.back(), '\n');
    const auto lines = lines_of(file);
    ASSERT_EQ(lines[0], "time_s,load_Pa,settlement");
    for (std::size_t i = 1; i < lines.size(); ++i) {
        double time = 0, load = 0, settlement = 0;
        ASSERT_EQ(std::sscanf(lines[i].c_str(), "%lf,%lf,%lf", &time, &load, &settlement), 3) << lines[i];
        ASSERT_EQ((std::vector{time, load, settlement}), row(i - 1)) << lines[i];
    }
}

std::size_t expect_whole_frames(const fs::path& file) {
    const auto names = members(file, "/frames");
    for (std::size_t frame = 0; frame < names.size(); ++frame) {
        const std::string group = "/frames/" + names[frame] + "/";
        EXPECT_EQ(attribute(file, group, "time"), 0.5 * static_cast<double>(frame));
        EXPECT_EQ(members(file, group).size(), 3u);
        for (const std::string& name : members(file, group)) {
            const Numbers data = numbers(file, group + name);
            EXPECT_EQ(data.shape[0], points);
            for (std::size_t i = 0; i < data.values.size(); ++i)
                EXPECT_EQ(data.values[i], value(frame, i));
        }
    }
    EXPECT_EQ(numbers(file, "/history/time").values.size(), rows_a_frame * names.size());
    return names.size();
}

} // namespace

TEST(Results, AreWholeAfterAKillAtAnyMoment) {
    const Folder folder;
    const fs::path results = folder.results();
    fs::create_directories(results / "frames");
    std::ofstream(results / "frames" / "mine.h5") << "mine";

    const auto start = steady_clock::now();
    whole_run(results, [] {});
    const duration<double> one_run = steady_clock::now() - start;

    std::mt19937 random(20240607);
    std::uniform_int_distribution<int> milestone(1, milestones);
    std::uniform_real_distribution<double> fraction(0.0, 1.5 / milestones);
    int killed_between_frames = 0, finished = 0;
    for (int repetition = 0; repetition < 60 && !HasFailure(); ++repetition) {
        SCOPED_TRACE(repetition);
        kill_a_run(results, milestone(random), fraction(random) * one_run);

        if (fs::exists(results / "history.csv")) expect_whole_history(results / "history.csv");
        if (fs::exists(results / "summary.json")) {
            EXPECT_TRUE(nlohmann::json::accept(text_of(results / "summary.json")));
        }
        if (fs::exists(results / "results.h5")) {
            const std::size_t found = expect_whole_frames(results / "results.h5");
            const bool complete = text_attribute(results / "results.h5", "/", "status") == "finished";
            EXPECT_TRUE(!complete || found == frames);
            (complete ? finished : killed_between_frames) += found > 0;
        }
        if (fs::exists(results / "results.xdmf")) {
            for (const Reference& reference : references(results / "results.xdmf"))
                EXPECT_EQ(numbers(results / reference.file, reference.dataset).shape, reference.shape);
        }
        EXPECT_EQ(text_of(results / "frames" / "mine.h5"), "mine");
    }
    EXPECT_GT(killed_between_frames, 5);
    EXPECT_GT(finished, 5);
}
