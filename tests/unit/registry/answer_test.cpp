// What plugins answer is made safe to print and to use.
#include "core/registry/answer.hpp"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

using namespace gault::core;

namespace {

std::string plain(const std::string& text) {
    return plain_text(text.c_str(), 100);
}

} // namespace

TEST(PlainText, IsOneLineWithoutControlCharacters) {
    EXPECT_EQ(plain("one\ntwo\r\nthree\t\x1b[31mred\x7f."), "one two  three  [31mred .");
    EXPECT_EQ(plain("\xc2\x9b"
                    "31m"),
              "31m"); // a control character of two bytes
    EXPECT_EQ(plain("  the end\n"), "the end");
    EXPECT_EQ(plain("\n \n"), "");
}

TEST(PlainText, KeepsCharactersAndDropsWhatIsNone) {
    const std::string greek = "\xcf\x83' = 2 \xc2\xb5m \xe2\x89\xa4 \xf0\x9d\x9c\x8e";
    EXPECT_EQ(plain(greek), greek);
    EXPECT_EQ(plain("a\xff"
                    "b\xc0\x80"
                    "c\xed\xa0\x80"
                    "d\x83"
                    "e"),
              "a b  c   d e");
}

TEST(PlainText, EndsAtItsCapacityWithoutHalfACharacter) {
    EXPECT_EQ(plain_text("sigma", 3), "sig");
    EXPECT_EQ(plain_text("ab\xcf\x83", 3), "ab");
    EXPECT_EQ(plain_text(nullptr, 3), "");
}

TEST(ErrorText, EndsWhereAnUnterminatedTextDoes) {
    gault_error error{};
    std::memset(error.text, 'x', sizeof error.text);
    EXPECT_EQ(error_text(error), std::string(GAULT_TEXT, 'x'));
}

TEST(StepFraction, StaysWithinItsBoundsWhateverWasSuggested) {
    EXPECT_EQ(step_fraction(0.3, 0.1, 0.9), 0.3);
    EXPECT_EQ(step_fraction(0.0, 0.1, 0.9), 0.1);
    EXPECT_EQ(step_fraction(HUGE_VAL, 0.1, 0.9), 0.9);
    EXPECT_EQ(step_fraction(-HUGE_VAL, 0.1, 0.9), 0.1);
    EXPECT_EQ(step_fraction(std::nan(""), 0.1, 0.9), 0.5);
    EXPECT_EQ(step_fraction(std::nan(""), 0.1, 0.4), 0.4);
}
