#include "tests/unit/output/support.hpp"

#include <csignal>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <sys/resource.h>

namespace fs = std::filesystem;
using namespace gault::core;
using namespace gault::core::test;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

void touch(const fs::path& file) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "mine";
}

void limit_file_size(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit{};
    getrlimit(RLIMIT_FSIZE, &limit);
    limit.rlim_cur = std::min(bytes, limit.rlim_max);
    setrlimit(RLIMIT_FSIZE, &limit);
}

[[noreturn]] void report(const std::function<void()>& action) {
    try {
        action();
    } catch (const RunError& error) {
        limit_file_size(RLIM_INFINITY); // what a coverage build writes at the exit would be cut
        std::fputs(error.what(), stderr);
        std::exit(3);
    }
    std::exit(0);
}

} // namespace

TEST(Results, ARowThatIsNotFiniteIsRefusedByColumnAndRow) {
    const Folder folder;
    ResultWriter out = writer(folder.results(), 3);
    out.row(row(0));
    EXPECT_THAT(
        [&] {
            out.row({0.0, not_a_number, 1.0});
        },
        ThrowsMessage<RunError>(AllOf(HasSubstr("row 1"), HasSubstr("'load_Pa' is nan"))));
    EXPECT_THROW(out.row({0.0, 1.0, -infinity}), RunError);
    EXPECT_THROW(out.row({0.0, 1.0}), RunError);
    EXPECT_EQ(lines_of(folder.results() / "history.csv").size(), 2u);
    EXPECT_EQ(out.rows().size(), 1u);
}

TEST(Results, AFrameThatIsNotFiniteIsRefusedByDatasetAndRow) {
    const Folder folder;
    ResultWriter out = writer(folder.results(), 3);
    out.frame(attributes(0), datasets(0, 3));
    auto bad = datasets(1, 3);
    bad[1].fill = [](double* stress) {
        std::fill(stress, stress + 18, 0.0);
        stress[2 * 6 + 4] = not_a_number;
    };
    EXPECT_THAT(
        [&] { out.frame(attributes(1), bad); },
        ThrowsMessage<RunError>(HasSubstr("/frames/0001: dataset 'stress', row 2, component 4 is nan")));
    EXPECT_THAT(
        [&] {
            out.frame({{"time", "s", infinity}}, datasets(1, 3));
        },
        ThrowsMessage<RunError>(HasSubstr("attribute 'time' is inf")));
    EXPECT_THROW(out.frame({}, datasets(1, 3)), RunError);
    EXPECT_EQ(members(folder.results() / "results.h5", "/frames").size(), 1u);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.results() / "frames"), {}), 1);
}

TEST(Results, EarlierResultsAreKeptUnlessTheyAreToBeReplaced) {
    const Folder folder;
    {
        ResultWriter out = writer(folder.results(), 3);
        out.row(row(0));
        out.frame(attributes(0), datasets(0, 3));
    }
    const std::string before = text_of(folder.results() / "results.h5");
    EXPECT_THAT([&] { writer(folder.results(), 3); },
                ThrowsMessage<InputError>(HasSubstr("already holds results (results.xdmf)")));
    EXPECT_EQ(text_of(folder.results() / "results.h5"), before);

    writer(folder.results(), 3, true);
    EXPECT_TRUE(members(folder.results() / "results.h5", "/frames").empty());
    EXPECT_EQ(lines_of(folder.results() / "history.csv").size(), 1u);
    EXPECT_FALSE(fs::exists(folder.results() / "results.xdmf"));
    EXPECT_TRUE(fs::is_empty(folder.results() / "frames"));
}

TEST(Results, ReplacingLeavesEverythingElse) {
    const Folder folder;
    for (const char* name :
         {"notes.txt", "results.h5.bak", "frames/notes.txt", "frames/1.h5", "frames/0001.h5.bak"})
        touch(folder.results() / name);
    touch(folder.results() / "frames/0001.h5");
    ResultWriter out = writer(folder.results(), 3, true);
    EXPECT_FALSE(fs::exists(folder.results() / "frames/0001.h5"));
    out.frame(attributes(0), datasets(0, 3));
    out.finish();
    for (const char* name :
         {"notes.txt", "results.h5.bak", "frames/notes.txt", "frames/1.h5", "frames/0001.h5.bak"})
        EXPECT_EQ(text_of(folder.results() / name), "mine");
}

TEST(Results, AFolderInTheWayIsRefused) {
    const Folder folder;
    fs::create_directories(folder.results() / "summary.json");
    EXPECT_THAT([&] { writer(folder.results(), 3, true); },
                ThrowsMessage<InputError>(HasSubstr("is a folder")));
}

TEST(Results, APlaceThatCannotBeWrittenIsAnInputError) {
    const Folder folder;
    touch(folder.path / "file");
    EXPECT_THAT([&] { writer(folder.path / "file" / "out", 3); },
                ThrowsMessage<InputError>(AllOf(HasSubstr("file/out"), HasSubstr("Not a directory"))));
    EXPECT_THROW(writer("/proc/gault", 3), InputError);
}

TEST(Results, AFullDiskEndsTheRunWithTheFileAndTheReason) {
    for (const rlim_t bytes : {600, 3000, 30000, 480000, 600000, 1600000}) {
        const Folder folder;
        EXPECT_EXIT(report([&] {
                        ResultWriter out = writer(folder.results(), 20000);
                        limit_file_size(bytes);
                        out.frame(attributes(0), datasets(0, 20000));
                    }),
                    testing::ExitedWithCode(3), "cannot write '.*frames/0000.h5.tmp': File too large")
            << bytes;
        EXPECT_TRUE(members(folder.results() / "results.h5", "/frames").empty());
        EXPECT_TRUE(fs::is_empty(folder.results() / "frames"));
    }
    const Folder folder;
    EXPECT_EXIT(report([&] {
                    ResultWriter out = writer(folder.results(), 20000);
                    out.frame(attributes(0), datasets(0, 20000));
                    limit_file_size(500000);
                    out.finish();
                }),
                testing::ExitedWithCode(3), "cannot write '.*results.h5.tmp': File too large");
    EXPECT_FALSE(fs::exists(folder.results() / "results.h5.tmp"));
    EXPECT_EQ(members(folder.results() / "results.h5", "/frames").size(), 1u);
}

TEST(Results, CanBeFinishedAfterAFullDisk) {
    for (const rlim_t bytes : {600, 3000, 30000, 480000, 600000, 1600000}) {
        const Folder folder;
        const auto fails = [](const auto& action) {
            try {
                action();
            } catch (const RunError&) {
                return;
            }
            std::_Exit(1);
        };
        EXPECT_EXIT(report([&] {
                        ResultWriter out = writer(folder.results(), 20000);
                        out.frame(attributes(0), datasets(0, 20000));
                        limit_file_size(bytes);
                        fails([&] { out.frame(attributes(1), datasets(1, 20000)); });
                        fails([&] { out.finish(); });
                        limit_file_size(RLIM_INFINITY);
                        out.finish();
                    }),
                    testing::ExitedWithCode(0), "^$")
            << bytes;
        const fs::path file = folder.results() / "results.h5";
        EXPECT_EQ(members(file, "/frames").size(), 1u);
        EXPECT_EQ(numbers(file, "/frames/0000/volume").values.back(), value(0, 19999));
        EXPECT_FALSE(fs::exists(folder.results() / "frames"));
        EXPECT_FALSE(fs::exists(folder.results() / "results.h5.tmp"));
    }
}

TEST(Results, AFullDiskLeavesWholeHistoryRows) {
    const Folder folder;
    EXPECT_EXIT(report([&] {
                    ResultWriter out = writer(folder.results(), 3);
                    limit_file_size(1000);
                    for (std::size_t i = 0;; ++i)
                        out.row(row(i));
                }),
                testing::ExitedWithCode(3), "cannot write '.*history.csv': File too large");
    const std::string history = text_of(folder.results() / "history.csv");
    EXPECT_GT(history.size(), 900u);
    EXPECT_EQ(history.back(), '\n');
}
