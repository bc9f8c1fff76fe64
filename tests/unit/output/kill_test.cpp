// A run is killed at random moments, again and again in one folder; whatever is found then must be whole.
#include "tests/unit/output/support.hpp"

#include <chrono>
#include <csignal>
#include <fstream>
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

void whole_run(const fs::path& folder) {
    ResultWriter out = writer(folder, points, true);
    for (std::size_t frame = 0; frame < frames; ++frame) {
        for (std::size_t i = 0; i < rows_a_frame; ++i)
            out.row(row(frame * rows_a_frame + i));
        out.frame(attributes(frame), datasets(frame, points));
        out.summary({{"status", "running"}, {"frames", frame}});
    }
    out.finish();
    out.summary({{"status", "done"}, {"frames", frames}});
}

// The child says when it starts, so that delays count from there.
pid_t start_a_run(const fs::path& folder) {
    int ready[2];
    if (pipe(ready) != 0) throw std::runtime_error("no pipe");
    const pid_t child = fork();
    if (child == 0) {
        if (write(ready[1], "!", 1) != 1) _exit(1);
        for (;;)
            whole_run(folder);
    }
    char byte = 0;
    if (read(ready[0], &byte, 1) != 1) throw std::runtime_error("no child");
    close(ready[0]);
    close(ready[1]);
    return child;
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
    whole_run(results);
    const double one_run = duration<double>(steady_clock::now() - start).count();

    std::mt19937 random(20240607);
    std::uniform_real_distribution<double> delay(0.0, 1.5 * one_run);
    int killed_between_frames = 0, finished = 0;
    for (int repetition = 0; repetition < 200 && !testing::Test::HasFailure(); ++repetition) {
        SCOPED_TRACE(repetition);
        const pid_t child = start_a_run(results);
        std::this_thread::sleep_for(duration<double>(delay(random)));
        kill(child, SIGKILL);
        int status = 0;
        ASSERT_EQ(waitpid(child, &status, 0), child);
        ASSERT_TRUE(WIFSIGNALED(status));

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
    EXPECT_GT(killed_between_frames, 10);
    EXPECT_GT(finished, 10);
}
