// Every study of the repository asks for scenes that can be read, to its last member.
#include "core/config/study.hpp"
#include "tests/hard/hard_scene.hpp"

#include <filesystem>
#include <gtest/gtest.h>

namespace gault::core::test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> studies() {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(GAULT_SOURCE_DIR "/configs/frontier"))
        if (entry.path().extension() == ".yaml") found.push_back(entry.path());
    return found;
}

class EveryStudy : public testing::TestWithParam<fs::path> {};
INSTANTIATE_TEST_SUITE_P(Repository, EveryStudy, testing::ValuesIn(studies()),
                         [](const auto& instance) { return instance.param.stem().string(); });

TEST_P(EveryStudy, AsksForScenesThatCanBeRead) {
    const Study study = read_study(GetParam());
    for (const Study::Family& family : study.families)
        for (const Study::Member& member : family.members) {
            std::vector<Override> set = family.set;
            set.insert(set.end(), member.set.begin(), member.set.end());
            EXPECT_NO_THROW(read_scene(study.scene, set, registry())) << family.name << ", " << member.label;
        }
}

} // namespace
} // namespace gault::core::test
