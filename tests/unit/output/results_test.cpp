#include "tests/unit/output/support.hpp"

#include <gtest/gtest.h>

namespace fs = std::filesystem;
using namespace gault::core;
using namespace gault::core::test;

namespace {

constexpr std::size_t points = 7;

void two_frames(ResultWriter& out) {
    for (std::size_t i = 0; i < 4; ++i) {
        out.row(row(i));
        if (i % 2 == 1) out.frame(attributes(i / 2), datasets(i / 2, points));
    }
}

fs::path finished_run(const Folder& folder) {
    ResultWriter out = writer(folder.results(), points);
    two_frames(out);
    out.row(row(4));
    out.summary({{"status", "done"}});
    out.finish();
    return folder.results();
}

} // namespace

TEST(Results, HistoryHasNamesWithUnitsAndNumbersThatReadBackExactly) {
    const Folder folder;
    const auto lines = lines_of(finished_run(folder) / "history.csv");
    ASSERT_EQ(lines.size(), 6u);
    EXPECT_EQ(lines[0], "time_s,load_Pa,settlement");
    for (std::size_t i = 0; i < 5; ++i) {
        double time = 0, load = 0, settlement = 0;
        ASSERT_EQ(std::sscanf(lines[i + 1].c_str(), "%lf,%lf,%lf", &time, &load, &settlement), 3);
        EXPECT_EQ((std::vector{time, load, settlement}), row(i));
    }
}

TEST(Results, NoHistoryRowLiesOnTwoPages) {
    const Folder folder;
    ResultWriter out = writer(folder.results(), points);
    for (std::size_t i = 0; i < 1000; ++i)
        out.row(row(i));
    std::size_t begin = 0;
    const auto lines = lines_of(folder.results() / "history.csv");
    ASSERT_EQ(lines.size(), 1001u);
    for (const std::string& line : lines) {
        EXPECT_EQ(begin / 4096, (begin + line.size()) / 4096) << line;
        begin += line.size() + 1;
    }
}

TEST(Results, FramesHoldEveryDatasetWithItsUnitAndConvention) {
    const Folder folder;
    const fs::path file = finished_run(folder) / "results.h5";
    EXPECT_EQ(members(file, "/frames"), (std::vector<std::string>{"0000", "0001"}));
    EXPECT_EQ(members(file, "/frames/0001"), (std::vector<std::string>{"position", "stress", "volume"}));
    EXPECT_EQ(attribute(file, "/frames/0001", "time"), 0.5);
    EXPECT_EQ(text_attribute(file, "/frames/0001", "time_unit"), "s");
    EXPECT_EQ(attribute(file, "/frames/0001", "settlement"), 0.25);

    const Numbers stress = numbers(file, "/frames/0001/stress");
    EXPECT_EQ(stress.shape, (std::vector<std::size_t>{points, 6}));
    EXPECT_EQ(stress.values.back(), value(1, 6 * points - 1));
    EXPECT_EQ(numbers(file, "/frames/0000/volume").shape, (std::vector<std::size_t>{points}));
    EXPECT_EQ(text_attribute(file, "/frames/0001/stress", "unit"), "Pa");
    EXPECT_EQ(text_attribute(file, "/frames/0001/stress", "description"), "the stress");
    EXPECT_EQ(text_attribute(file, "/frames/0001/stress", "components"), "xx yy zz xy yz zx");
    for (const char* convention : {"sign", "component_order", "position", "volume"})
        EXPECT_FALSE(text_attribute(file, "/", convention).empty());
}

TEST(Results, HoldTheSceneTheProvenanceAndTheWholeHistory) {
    const Folder folder;
    const fs::path file = finished_run(folder) / "results.h5";
    EXPECT_EQ(text(file, "/scene"), "gault: 1\ntitle: µ\n");
    EXPECT_EQ(nlohmann::json::parse(text(file, "/provenance")).at("program"), "gault");
    const Numbers load = numbers(file, "/history/load");
    ASSERT_EQ(load.values.size(), 5u);
    EXPECT_EQ(load.values[4], row(4)[1]);
    EXPECT_EQ(text_attribute(file, "/history/load", "unit"), "Pa");
    EXPECT_EQ(text_attribute(file, "/history/load", "description"), "compression positive");
}

TEST(Results, AreReadableWhileTheRunGoesOn) {
    const Folder folder;
    ResultWriter out = writer(folder.results(), points);
    const fs::path file = folder.results() / "results.h5";
    EXPECT_TRUE(members(file, "/frames").empty());
    two_frames(out);
    EXPECT_EQ(text_attribute(file, "/", "status"), "running");
    EXPECT_EQ(members(file, "/frames").size(), 2u);
    EXPECT_EQ(numbers(file, "/frames/0001/volume").values.back(), value(1, points - 1));
    EXPECT_EQ(numbers(file, "/history/time").values.size(), 4u);
}

TEST(Results, AreOneSelfContainedFileAtTheEnd) {
    const Folder folder;
    const fs::path from = finished_run(folder);
    EXPECT_FALSE(fs::exists(from / "frames"));
    const fs::path elsewhere = folder.path / "alone.h5";
    fs::copy_file(from / "results.h5", elsewhere);
    EXPECT_EQ(text_attribute(elsewhere, "/", "status"), "finished");
    EXPECT_EQ(numbers(elsewhere, "/frames/0000/position").values.back(), value(0, 3 * points - 1));
    EXPECT_EQ(text_attribute(elsewhere, "/frames/0000/position", "components"), "x y z");
}

TEST(Results, OfTheSameRunAreTheSameBytes) {
    const Folder one, other;
    EXPECT_EQ(text_of(finished_run(one) / "results.h5"), text_of(finished_run(other) / "results.h5"));
}

TEST(Results, XdmfRefersToEveryDatasetWithItsShape) {
    const Folder folder;
    const auto found = references(finished_run(folder) / "results.xdmf");
    ASSERT_EQ(found.size(), 8u);
    for (const Reference& reference : found) {
        EXPECT_EQ(reference.file, "results.h5");
        EXPECT_EQ(numbers(folder.results() / reference.file, reference.dataset).shape, reference.shape);
    }
    EXPECT_NE(text_of(folder.results() / "results.xdmf").find("<Time Value=\"0.5\"/>"), std::string::npos);
}

TEST(Results, XdmfEscapesWhatXmlReserves) {
    const Folder folder;
    ResultWriter out = writer(folder.results(), points);
    auto named = datasets(0, points);
    named[2].info.name = "a<b>&\"c\"";
    out.frame(attributes(0), named);
    EXPECT_EQ(references(folder.results() / "results.xdmf").at(3).dataset, "/frames/0000/a<b>&\"c\"");
}

TEST(Results, SummaryIsJson) {
    const Folder folder;
    EXPECT_EQ(nlohmann::json::parse(text_of(finished_run(folder) / "summary.json")).at("status"), "done");
}

TEST(Sha256, IsThatOfTheStandard) {
    const Folder folder;
    std::FILE* file = std::fopen((folder.path / "abc").c_str(), "w");
    std::fputs("abc", file);
    std::fclose(file);
    EXPECT_EQ(sha256_of_file(folder.path / "abc"),
              "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_THROW(sha256_of_file(folder.path / "absent"), InputError);
    EXPECT_THROW(sha256_of_file(folder.path), InputError);
}
