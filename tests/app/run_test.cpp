// What a run does with its folder, its overrides, its threads; and how it fails.
#include "tests/app/child.hpp"

#include <fstream>

namespace gault::test {
namespace {

using ARun = App;
const std::string block = "plugins/fixity/scene.yaml", fahey = "configs/paper/fahey.yaml";

std::map<std::string, std::string> contents(const fs::path& folder) {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) all[entry.path().string()] = core::test::text_of(entry.path());
    return all;
}

TEST_F(ARun, UsedFolderIsRefusedAndKept) {
    run(block);
    const auto before = contents(results);
    const std::string message = refusal(gault({"run", (repository / block).string(), "-o", "results"}));
    EXPECT_TRUE(has(message, "already holds results")) << message;
    EXPECT_TRUE(has(message, "--force")) << message;
    EXPECT_EQ(contents(results), before);
}

TEST_F(ARun, ForceReplacesResultsAndNothingElse) {
    run(block);
    std::ofstream(results / "notes.txt") << "mine";
    run(block, {"--force", "--set", "title=another"});
    EXPECT_EQ(summary(results)["title"], "another");
    EXPECT_EQ(core::test::text_of(results / "notes.txt"), "mine");
}

TEST_F(ARun, OverridesTakeEffectAndAreWrittenDown) {
    const std::string scene = "plugins/linear_elastic/scene.yaml";
    const auto wall_displacement = [&] { // the innermost point's
        const fs::path file = results / "results.h5";
        const std::string frame = "/frames/" + core::test::members(file, "/frames").back();
        return core::test::numbers(file, frame + "/displacement").values[0];
    };
    run(scene);
    const double stiff = wall_displacement();
    run(scene,
        {"--force", "--set", "materials.rock.young_modulus=35 GPa", "--set", "boundaries.0.value=10.0 MPa"});
    EXPECT_NEAR(wall_displacement() / stiff, 2.0, 0.02);

    const std::string yaml = core::test::text(results / "results.h5", "/scene");
    EXPECT_TRUE(has(yaml, "35 GPa")) << yaml;
    EXPECT_FALSE(has(yaml, "70 GPa")) << yaml;
    EXPECT_TRUE(has(yaml, "10.0 MPa")) << yaml;
    const auto provenance = nlohmann::json::parse(core::test::text(results / "results.h5", "/provenance"));
    EXPECT_EQ(provenance, summary(results)["provenance"]);
    EXPECT_TRUE(has(provenance["command"], "--set materials.rock.young_modulus=35 GPa"))
        << provenance["command"];
}

TEST_F(ARun, SceneWrittenInTheResultsRunsAgainToTheSameBits) {
    run(block, {"--set", "program.pressure.1.1=150 kPa"});
    const std::string first = core::test::text_of(results / "history.csv");
    std::ofstream(work / "again.yaml") << core::test::text(results / "results.h5", "/scene");
    ASSERT_EQ(gault({"run", "again.yaml", "-o", "again"}).status, 0);
    EXPECT_EQ(core::test::text_of(work / "again/history.csv"), first);
}

class Threads : public App, public testing::WithParamInterface<const char*> {};

TEST_P(Threads, LeaveTheSameBits) {
    const auto with = [&](const char* threads) {
        run(fahey, {"--force", "-j", threads, "--set", std::string("model.frame=") + GetParam(), "--set",
                    "grid.cells=[24, 8]", "--set", "program.until.cavity_strain=1 %", "--set", "output={}",
                    "--set", "reference={}"});
        EXPECT_EQ(summary(results)["threads"], std::stoi(threads));
        return std::pair(core::test::text_of(results / "history.csv"),
                         core::test::numbers(results / "results.h5", "/frames/0000/stress").values);
    };
    const auto [history_of_one, stress_of_one] = with("1");
    const auto [history_of_two, stress_of_two] = with("2");
    EXPECT_EQ(history_of_one, history_of_two);
    EXPECT_EQ(stress_of_one, stress_of_two);
    EXPECT_EQ(lines(history_of_one).size(), 42u);
}

INSTANTIATE_TEST_SUITE_P(Frame, Threads, testing::Values("total", "updated"),
                         [](const auto& use) { return use.param; });

// A step that is too long for the soil: it tells the host a third of its stiffness.
TEST_F(ARun, UnstableOneStopsWithAMessageAndFiniteFiles) {
    const Outcome outcome =
        gault({"run", (repository / "configs/paper/case1.yaml").string(), "-o", "results", "--plugin-path",
               (build / "tests/app/plugins").string(), "--set", "materials.rock.model=test_soil", "--set",
               "materials.rock.said_share=0.3"});
    EXPECT_EQ(outcome.status, 3);
    EXPECT_EQ(outcome.out, "");
    const std::string last = lines(outcome.err).back();
    ASSERT_TRUE(last.starts_with("error: step ")) << outcome.err;
    for (const char* part : {", t = ", " s: ", "the run became unstable", "point ", "time_step_factor"})
        EXPECT_TRUE(has(last, part)) << part << "\n" << last;
    EXPECT_EQ(summary(results)["status"], "failed");
    EXPECT_EQ("error: " + summary(results)["message"].get<std::string>(), last);
    EXPECT_GT(history(results, "time_s").size(), 0u); // and every number is finite
    EXPECT_EQ(core::test::text_attribute(results / "results.h5", "/", "status"), "finished");
}

TEST_F(ARun, PointWithoutAResultIsNamed) {
    const Outcome outcome = gault({"run", (repository / "plugins/linear_elastic/scene.yaml").string(), "-o",
                                   "results", "--plugin-path", (build / "tests/app/plugins").string(),
                                   "--set", "materials.rock.model=test_soil", "--set",
                                   "materials.rock.breaks_after=0.1 s", "--set", "model.solver=explicit"});
    EXPECT_EQ(outcome.status, 3);
    const std::string last = lines(outcome.err).back();
    for (const char* part : {"error: step ", "t = 0.0999", "point 0 ", "'rock'", "the soil broke"})
        EXPECT_TRUE(has(last, part)) << part << "\n" << last;
    EXPECT_EQ(summary(results)["status"], "failed");
    EXPECT_LE(history(results, "time_s").back(), 0.1);
}

} // namespace
} // namespace gault::test
