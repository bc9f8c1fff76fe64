// Where plugins are looked for, and which of several files is taken.
#include "core/base/isa.hpp"
#include "core/registry/registry.hpp"
#include "tests/contract/scratch.hpp"

#include <gtest/gtest.h>

using namespace gault::core;
namespace fs = std::filesystem;

namespace {

const fs::path good = CONTRACT_DIR "/good", contract_dir = CONTRACT_DIR;
const char* const library = "hypoelastic.so";

std::string refusal(const std::vector<fs::path>& search_path) {
    try {
        Registry registry(search_path);
    } catch (const InputError& e) {
        return e.what();
    }
    return "accepted";
}

class Search : public testing::Test {
  protected:
    void SetUp() override { unsetenv("GAULT_ISA"), unsetenv("GAULT_PLUGIN_PATH"); }
    const Scratch scratch;
};

} // namespace

TEST_F(Search, GoesFromTheSceneToTheCommandLineToTheEnvironmentToTheInstallation) {
    setenv("GAULT_PLUGIN_PATH", "/environment/a::/environment/b:", 1);
    const auto path = plugin_search_path({"/scene"}, {"/command/line"});
    ASSERT_GE(path.size(), 4u);
    EXPECT_EQ(std::vector(path.begin(), path.begin() + 4),
              (std::vector<fs::path>{"/scene", "/command/line", "/environment/a", "/environment/b"}));
    fs::create_directories(GAULT_BINARY_DIR "/lib/gault/plugins");
    EXPECT_EQ(plugin_search_path({}, {}).back(), fs::canonical(GAULT_BINARY_DIR) / "lib/gault/plugins");
}

TEST_F(Search, NamesAnEntryThatDoesNotExist) {
    EXPECT_EQ(
        refusal({"/nowhere/at/all"}),
        "/nowhere/at/all: is on the plugin search path and cannot be reached: No such file or directory");
}

TEST_F(Search, NamesALinkThatLeadsNowhere) {
    fs::create_symlink("/nowhere/at/all.so", scratch.path / "dangling.so");
    EXPECT_EQ(refusal({scratch.path}),
              (scratch.path / "dangling.so").string() +
                  ": is on the plugin search path and cannot be reached: No such file or directory");
}

TEST_F(Search, RefusesALibraryThatIsNoPlugin) {
    scratch.write("notes.so", "not a library");
    EXPECT_EQ(refusal({scratch.path}),
              (scratch.path / "notes.so").string() +
                  ": is not an ELF file (it starts with 'not a li'); the host loads ELF shared libraries");
}

TEST_F(Search, OverlooksFilesThatAreNoLibraries) {
    scratch.write("README.md", "text");
    EXPECT_EQ(Registry({scratch.path}).components().size(), 0u);
}

TEST_F(Search, LoadsAFileOnceHoweverOftenItIsMet) {
    fs::create_symlink(good / library, scratch.path / "another_name.so");
    fs::create_directory_symlink(good, scratch.path / "folder");
    fs::create_hard_link(good / library, scratch.path / "hard.so");
    const Registry registry({good, good / library, good / ".", scratch.path, scratch.path / "folder"});
    EXPECT_EQ(registry.components().size(), 1u);
}

TEST_F(Search, TakesFilesInTheOrderOfTheirNames) {
    fs::create_symlink(contract_dir / "first_of_two/first_of_two.so", scratch.path / "b.so");
    fs::create_symlink(contract_dir / "second_of_two/second_of_two.so", scratch.path / "a.so");
    const std::string found = refusal({scratch.path}); // the later file is the one too many
    EXPECT_TRUE(found.starts_with((contract_dir / "first_of_two/first_of_two.so: ").string())) << found;
}

TEST_F(Search, NamesBothFilesWhenACopyProvidesTheSameComponent) {
    fs::copy_file(good / library, scratch.path / "copy.so");
    setenv("GAULT_ISA", "baseline", 1);
    EXPECT_EQ(refusal({good, scratch.path}),
              (scratch.path / "copy.so").string() + ": provides the material 'hypoelastic', which " +
                  (good / library).string() + " provides already; take one of the two files away");
}

TEST_F(Search, TakesTheVariantForTheProcessor) {
    const fs::path folder = best_isa() == Isa::baseline ? good : good / "glibc-hwcaps" / isa_name(best_isa());
    EXPECT_EQ(Registry({good}).components()[0].file, folder / library);
    EXPECT_EQ(Registry({good / library}).components()[0].file, folder / library);
    fs::create_symlink(good / library, scratch.path / "linked.so");
    EXPECT_EQ(Registry({scratch.path}).components()[0].file, folder / library);
}

TEST_F(Search, TakesTheVariantThatTheEnvironmentAllows) {
    setenv("GAULT_ISA", "baseline", 1);
    EXPECT_EQ(Registry({good}).components()[0].file, good / library);
    if (setenv("GAULT_ISA", "x86-64-v3", 1); best_isa() == Isa::v3) {
        EXPECT_EQ(Registry({good}).components()[0].file, good / "glibc-hwcaps/x86-64-v3" / library);
    }
    setenv("GAULT_ISA", "x86-64-v5", 1);
    EXPECT_EQ(refusal({good}),
              "GAULT_ISA: unknown instruction set 'x86-64-v5'; did you mean 'x86-64-v3'?; allowed: baseline, "
              "x86-64-v3, x86-64-v4");
}

TEST_F(Search, RefusesAVariantWithoutABaseline) {
    fs::create_directories(scratch.path / "glibc-hwcaps/x86-64-v3");
    fs::copy_file(good / library, scratch.path / "glibc-hwcaps/x86-64-v3/alone.so");
    EXPECT_EQ(refusal({scratch.path}), (scratch.path / "glibc-hwcaps/x86-64-v3/alone.so").string() +
                                           ": is a variant without a baseline; the host expects " +
                                           (scratch.path / "alone.so").string() + " for other processors");
}

TEST_F(Search, FindsAComponentByKindAndName) {
    const Registry registry({good});
    EXPECT_STREQ(registry.find(GAULT_MATERIAL, "hypoelastic").declaration->name, "hypoelastic");
}

TEST_F(Search, SuggestsTheNearestName) {
    const Registry registry({good});
    const auto text = [&](gault_kind kind, const char* name) -> std::string {
        try {
            registry.find(kind, name, {"scene.yaml", 4, 9});
        } catch (const InputError& e) {
            return e.what();
        }
        return "found";
    };
    const std::string hint = "; plugins of your own are found with `plugins:` in the scene, --plugin-path or "
                             "GAULT_PLUGIN_PATH";
    EXPECT_EQ(text(GAULT_MATERIAL, "hypolastic"),
              "scene.yaml:4:9: no material is named 'hypolastic'; did you mean "
              "'hypoelastic'?; allowed: hypoelastic" +
                  hint);
    EXPECT_EQ(text(GAULT_PROGRAM, "hypoelastic"),
              "scene.yaml:4:9: no program is named 'hypoelastic' (it is a material); no "
              "plugin that was found provides any" +
                  hint);
}
