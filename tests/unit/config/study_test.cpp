#include "core/config/study.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include <unistd.h>

namespace gault::core {
namespace {

namespace fs = std::filesystem;

class StudyFile : public testing::Test {
  protected:
    StudyFile() : folder(fs::path(testing::TempDir()) / ("gault-study-" + std::to_string(getpid()))) {
        fs::create_directories(folder);
        std::ofstream(folder / "scene.yaml") << "gault: 1\n";
    }
    ~StudyFile() override { fs::remove_all(folder); }

    fs::path written(const std::string& text) const {
        std::ofstream(folder / "study.yaml") << text;
        return folder / "study.yaml";
    }
    std::string refusal(const std::string& text) const {
        try {
            read_study(written(text));
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    }
    fs::path folder;
};

const std::string start = "gault: 1\nscene: scene.yaml\n";

TEST_F(StudyFile, GivesFamiliesWithTheirSettings) {
    const Study study = read_study(written(start + R"(title: A study
repeat: 2
errors: {pressure: /reference/curves/0/largest_relative_error, stress: [/a, /b]}
values: {peak: /history/p/largest}
curve: {x: strain, y: p}
set: {accuracy: 1 %, threads: 2}
families:
  - name: refined
    set: {model.frame: total}
    vary: {grid.cells: [[8, 1], [16, 1]], solver: [{strain_step: 2 %}, {strain_step: 1 %}]}
  - name: alone
    labels: [the one]
  - name: threads
    vary: {threads: [1, 4]}
)"));
    EXPECT_EQ(study.title, "A study");
    EXPECT_EQ(study.repeat, 2);
    EXPECT_EQ(study.scene, folder / "scene.yaml");
    ASSERT_TRUE(study.errors);
    EXPECT_EQ((*study.errors)[1].places, (std::vector<std::string>{"/a", "/b"}));
    EXPECT_EQ(study.values[0].name, "peak");
    EXPECT_EQ((*study.curve)[1], "p");
    ASSERT_EQ(study.families.size(), 3u);
    const Study::Family& refined = study.families[0];
    ASSERT_EQ(refined.set.size(), 2u);
    EXPECT_EQ(refined.set[0].key, "accuracy");
    EXPECT_EQ(refined.set[0].value, "1 %");
    EXPECT_EQ(refined.set[1].value, "total");
    ASSERT_EQ(refined.members.size(), 2u);
    EXPECT_EQ(refined.members[1].label, "cells [16, 1], solver {strain_step: 1 %}");
    EXPECT_EQ(refined.members[1].set[0].value, "[16, 1]");
    EXPECT_EQ(refined.members[1].size, 16.0);
    EXPECT_EQ(refined.members[1].threads, 2);
    EXPECT_EQ(study.families[1].members.size(), 1u);
    EXPECT_EQ(study.families[1].members[0].label, "the one");
    EXPECT_TRUE(std::isnan(study.families[1].members[0].size));
    EXPECT_EQ(study.families[2].members[1].threads, 4);
    EXPECT_TRUE(study.families[2].members[1].set.empty());
}

TEST_F(StudyFile, IsToldFromAScene) {
    EXPECT_TRUE(is_study(written(start + "families: []\n")));
    EXPECT_FALSE(is_study(folder / "scene.yaml"));
}

TEST_F(StudyFile, IsRefusedWithThePlace) {
    const auto contains = [&](const std::string& text, const std::string& words) {
        const std::string message = refusal(text);
        EXPECT_NE(message.find(words), std::string::npos) << message;
    };
    contains("gault: 1\nfamilies: []\n", "study.yaml:1:1: scene is missing");
    contains("gault: 1\nscene: none.yaml\nfamilies: []\n", "study.yaml:2:8: scene: there is no file");
    contains(start, "families is missing");
    contains(start + "families: []\n", "study.yaml:3:11: families is empty");
    contains(start + "families: [{name: a, very: {}}]\n", "did you mean 'vary'?");
    contains(start + "families: [{name: a}, {name: a}]\n", "a second family 'a'");
    contains(start + "families: [{name: a, vary: {x: [1, 2], y: [1]}}]\n",
             "families.0.vary.y has 1 items; x, which varies with it, 2");
    contains(start + "families: [{name: a, vary: {threads: [0]}}]\n", "families.0.vary.threads.0");
    contains(start + "families: [{name: a, vary: {x: [1, 2]}, labels: [one]}]\n",
             "has 1 items for 2 members");
    contains(start + "errors: {p: reference}\nfamilies: [{name: a}]\n", "begins with '/'");
    contains(start + "curve: {x: a}\nfamilies: [{name: a}]\n", "curve.y is missing");
}

} // namespace
} // namespace gault::core
