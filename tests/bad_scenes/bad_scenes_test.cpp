// Every scene in scenes/ is wrong in one way, which its first line says: "# expect: 12:5 did you mean
// 'cohesion'". To add a bad scene is to add a file.
#include "core/config/reader.hpp"
#include "tests/bad_scenes/check_scene.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace gault::core {
namespace {

namespace fs = std::filesystem;

const fs::path corpus = GAULT_SOURCE_DIR "/tests/bad_scenes";

std::vector<std::string> scenes_in(const std::string& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(corpus / folder))
        if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::string refusal(const fs::path& file, const std::vector<Override>& overrides = {}) {
    try {
        read_scene(file, overrides, test_registry());
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

std::string name_of(const testing::TestParamInfo<std::string>& info) {
    return info.param;
}

class GoodScene : public testing::TestWithParam<std::string> {};
TEST_P(GoodScene, IsRead) {
    EXPECT_EQ(refusal(corpus / "good" / (GetParam() + ".yaml")), "accepted");
}
INSTANTIATE_TEST_SUITE_P(Corpus, GoodScene, testing::ValuesIn(scenes_in("good")), name_of);

class BadScene : public testing::TestWithParam<std::string> {};
TEST_P(BadScene, IsRefusedWhereItIsWrong) {
    const fs::path file = corpus / "scenes" / (GetParam() + ".yaml");
    std::ifstream stream(file);
    std::string mark, word, place, expected;
    stream >> mark >> word >> place >> std::ws;
    std::getline(stream, expected);
    ASSERT_EQ(mark + " " + word, "# expect:")
        << "the first line says what is expected: # expect: LINE:COLUMN TEXT";
    ASSERT_FALSE(expected.empty());
    const std::string message = refusal(file);
    EXPECT_TRUE(message.starts_with(file.string() + ":" + place + ": "))
        << message << "\nexpected at " << place;
    EXPECT_NE(message.find(expected), std::string::npos) << message << "\nexpected: " << expected;
}
INSTANTIATE_TEST_SUITE_P(Corpus, BadScene, testing::ValuesIn(scenes_in("scenes")), name_of);

// What cannot carry a first line, or is too large to keep.
class MadeScene : public testing::Test {
  protected:
    fs::path file =
        fs::path(testing::TempDir()) /
        (std::string("gault_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".yaml");
    void TearDown() override { fs::remove_all(file); }

    std::string refusal_of(const std::string& text) {
        std::ofstream(file, std::ios::binary) << text;
        return refusal(file);
    }
    std::string at(const std::string& rest) const { return file.string() + ":" + rest; }
};

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i)
        all += text;
    return all;
}

TEST_F(MadeScene, WithoutAByteIsEmpty) {
    EXPECT_EQ(refusal_of(""), at("1:1: the scene is empty"));
}

TEST_F(MadeScene, OfCommentsAloneIsEmpty) {
    EXPECT_EQ(refusal_of("# nothing\n\n"), at("1:1: the scene is empty"));
}

TEST_F(MadeScene, ThatDoesNotExistIsSaidSo) {
    EXPECT_EQ(refusal(file), file.string() + ": no such file");
}

TEST_F(MadeScene, ThatIsAFolderIsSaidSo) {
    fs::create_directory(file);
    EXPECT_EQ(refusal(file), file.string() + ": a folder, not a file");
}

TEST_F(MadeScene, ThatMayNotBeReadIsSaidSo) {
    std::ofstream(file) << "gault: 1\n";
    fs::permissions(file, fs::perms::none);
    if (std::ifstream(file)) GTEST_SKIP() << "this user may read everything";
    EXPECT_EQ(refusal(file), file.string() + ": the file cannot be read");
}

TEST_F(MadeScene, OfBytesIsNotText) {
    EXPECT_EQ(refusal_of(std::string("\x7f"
                                     "ELF\x02\x01\0\0",
                                     8)),
              at("1:1: not UTF-8 text: byte 0x7F"));
    EXPECT_EQ(refusal_of(std::string("gault: 1\nti\0le: a\n", 18)), at("2:3: not UTF-8 text: byte 0x00"));
    EXPECT_EQ(refusal_of("gault: 1\ntitle: caf\xe9\n"), at("2:11: not UTF-8 text: byte 0xE9"));
    EXPECT_EQ(refusal_of("title: \xed\xa0\x80\n"), at("1:8: not UTF-8 text: byte 0xED"));
    EXPECT_EQ(refusal_of("title: \xc0\x80\n"), at("1:8: not UTF-8 text: byte 0xC0"));
}

TEST_F(MadeScene, ColumnsCountCharactersNotBytes) {
    EXPECT_EQ(refusal_of("{µµ: 1}\n"), at("1:2: unknown key 'µµ' in the scene"));
    EXPECT_EQ(refusal_of("{title: 'µµ', µ: 1}\n"), at("1:15: unknown key 'µ' in the scene"));
}

TEST_F(MadeScene, BeyondOneMebibyteIsRefused) {
    EXPECT_EQ(refusal_of("# " + std::string(1 << 20, 'x')),
              file.string() + ": larger than 1 MiB; not a scene");
}

TEST_F(MadeScene, NestedTooDeepIsRefused) {
    EXPECT_EQ(refusal_of("a: " + std::string(1000, '[') + std::string(1000, ']')),
              at("1:67: more than 64 levels of nesting"));
    EXPECT_EQ(refusal_of(repeated("{a: ", 1000) + "1" + std::string(1000, '}')),
              at("1:257: more than 64 levels of nesting"));
    EXPECT_EQ(refusal_of(repeated("- ", 1 << 19)), at("1:129: more than 64 levels of nesting"));
}

TEST_F(MadeScene, OfBracketsAloneEndsAtOnce) {
    EXPECT_EQ(refusal_of(std::string(1 << 20, '[')).find(at("1:")), 0u);
    EXPECT_EQ(refusal_of(repeated("{a: ", 1 << 18)).find(at("1:")), 0u);
}

TEST_F(MadeScene, OfTooManyValuesIsRefused) {
    EXPECT_NE(refusal_of("a: [\n" + repeated(" 1,\n", 200000) + "]\n").find("more than 100000 values"),
              std::string::npos);
}

TEST_F(MadeScene, WhoseAliasesMultiplyIsRefused) {
    std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
    for (int i = 1; i < 12; ++i) {
        const std::string alias = "*a" + std::to_string(i - 1);
        bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + repeated(alias + ", ", 9) +
                alias + "]\n";
    }
    EXPECT_NE(refusal_of(bomb).find("more than 100000 values"), std::string::npos);
}

TEST_F(MadeScene, WithAKeyOfAMebibyteIsRefused) {
    EXPECT_EQ(refusal_of("? " + std::string((1 << 20) - 8, 'k') + "\n: 1\n"),
              at("1:3: a key of more than 256 bytes"));
}

TEST_F(MadeScene, WithAByteOrderMarkIsReadLikeAnyOther) {
    EXPECT_EQ(refusal_of("\xef\xbb\xbfgaolt: 1\n").find(at("1:1: unknown key 'gaolt'")), 0u);
}

} // namespace
} // namespace gault::core
