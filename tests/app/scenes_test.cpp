// Every scene of the repository runs as it is; every bad one is refused before anything is written.
#include "tests/app/child.hpp"

#include <algorithm>
#include <fstream>

namespace gault::test {
namespace {

std::vector<std::string> scenes() {
    std::vector<std::string> found;
    for (const char* top : {"configs", "plugins"})
        for (const auto& entry : fs::recursive_directory_iterator(repository / top))
            if (const std::string folder = entry.path().parent_path().stem();
                entry.path().extension() == ".yaml" && folder != "frontier" && folder != "element")
                found.push_back(
                    fs::relative(entry.path(), repository).string()); // neither studies nor tests of a point
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<std::string> bad_scenes() {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(repository / "tests/bad_scenes/scenes"))
        if (entry.path().extension() == ".yaml") found.push_back(entry.path().stem().string());
    std::sort(found.begin(), found.end());
    return found;
}

std::string name_of(const testing::TestParamInfo<std::string>& info) {
    std::string name = fs::path(info.param).replace_extension().string();
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
    return name;
}

class EveryScene : public App, public testing::WithParamInterface<std::string> {};

TEST_P(EveryScene, RunsAndLeavesWholeResults) {
    const Outcome outcome = gault({"run", (repository / GetParam()).string(), "-o", "results"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "") << "the log belongs to stderr";
    EXPECT_EQ(outcome.err.find_first_of("\r\x1b"), std::string::npos) << "this is not a terminal";

    const auto s = summary(results);
    EXPECT_EQ(s["status"], "done");
    EXPECT_GT(s["counts"]["steps"], 0);
    const auto time = history(results, "time_s");
    ASSERT_GT(time.size(), 1u);
    EXPECT_TRUE(std::is_sorted(time.begin(), time.end()));

    const fs::path file = results / "results.h5";
    EXPECT_EQ(core::test::text_attribute(file, "/", "status"), "finished");
    const auto frames = core::test::members(file, "/frames");
    EXPECT_EQ(s["counts"]["frames"], frames.size());
    ASSERT_FALSE(frames.empty());
    const auto stress = core::test::numbers(file, "/frames/" + frames.back() + "/stress");
    EXPECT_EQ(s["counts"]["points"], stress.shape[0]);
    for (const auto& reference : core::test::references(results / "results.xdmf"))
        EXPECT_EQ(core::test::numbers(results / reference.file, reference.dataset).shape, reference.shape);
}

INSTANTIATE_TEST_SUITE_P(Repository, EveryScene, testing::ValuesIn(scenes()), name_of);

class BadSceneRun : public App, public testing::WithParamInterface<std::string> {};

TEST_P(BadSceneRun, EndsWithOneLineAndWritesNothing) {
    const fs::path scene = repository / "tests/bad_scenes/scenes" / (GetParam() + ".yaml");
    const Outcome outcome = gault(
        {"run", scene.string(), "--plugin-path", (build / "tests/plugins/test_components.so").string()});
    const std::string message = refusal(outcome);

    std::string mark, word, place;
    std::ifstream(scene) >> mark >> word >> place; // "# expect: LINE:COLUMN ..."
    EXPECT_TRUE(message.starts_with(scene.string() + ":" + place + ": ")) << message;
    EXPECT_TRUE(fs::is_empty(work));
}

INSTANTIATE_TEST_SUITE_P(Corpus, BadSceneRun, testing::ValuesIn(bad_scenes()), name_of);

} // namespace
} // namespace gault::test
