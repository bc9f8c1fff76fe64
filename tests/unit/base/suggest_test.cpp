#include "core/base/error.hpp"
#include "core/base/suggest.hpp"

#include <gtest/gtest.h>

using gault::core::Location;
using gault::core::nearest;
using gault::core::suggestion;

TEST(Nearest, FindsANameWithOneLetterWrongMissingOrTooMany) {
    EXPECT_EQ(nearest("densty", {"density", "cohesion"}), "density");
    EXPECT_EQ(nearest("densitty", {"density", "cohesion"}), "density");
    EXPECT_EQ(nearest("dansity", {"density", "cohesion"}), "density");
}

TEST(Nearest, CountsSwappedNeighboursAsOneMistake) {
    EXPECT_EQ(nearest("rta", {"rat"}), "rat");
    EXPECT_EQ(nearest("tra", {"rta"}), "rta");
    EXPECT_EQ(nearest("rxy", {"rat"}), "");
}

TEST(Nearest, IgnoresCaseAndTakesHyphensForUnderscores) {
    EXPECT_EQ(nearest("Young-Modulus", {"poisson_ratio", "young_modulus"}), "young_modulus");
}

TEST(Nearest, IsEmptyWhenMoreThanAThirdIsWrong) {
    EXPECT_EQ(nearest("rate", {"until", "on"}), "");
    EXPECT_EQ(nearest("abcdef", {"abcxyz"}), "");
    EXPECT_EQ(nearest("abcdef", {"abcdxy"}), "abcdxy");
    EXPECT_EQ(nearest("", {"a"}), "");
    EXPECT_EQ(nearest("word", {}), "");
}

TEST(Nearest, PrefersTheSmallerDistanceAndThenTheFirst) {
    EXPECT_EQ(nearest("inner", {"linnet", "inner"}), "inner");
    EXPECT_EQ(nearest("bat", {"cat", "rat"}), "cat");
}

TEST(Suggestion, NamesTheNearestAndThenWhatIsAllowed) {
    EXPECT_EQ(suggestion("iner", {"inner", "outer"}), "; did you mean 'inner'?; allowed: inner, outer");
    EXPECT_EQ(suggestion("x", {"inner", "outer"}), "; allowed: inner, outer");
    EXPECT_EQ(suggestion("x", {}), "");
}

TEST(Suggestion, DoesNotListMany) {
    std::vector<std::string> many;
    for (char c = 'a'; c <= 'z'; ++c)
        many.push_back(std::string(5, c));
    EXPECT_EQ(suggestion("aaaab", many), "; did you mean 'aaaaa'?");
    EXPECT_EQ(suggestion("q", many), "");
}

TEST(Location, SaysWhatIsKnown) {
    EXPECT_EQ((Location{"scene.yaml", 3, 7}.text()), "scene.yaml:3:7");
    EXPECT_EQ((Location{"scene.yaml", 3, 0}.text()), "scene.yaml:3");
    EXPECT_EQ((Location{"scene.yaml", 0, 0}.text()), "scene.yaml");
    EXPECT_EQ((Location{"", 3, 7}.text()), "3:7");
    EXPECT_EQ(Location{}.text(), "");
}

TEST(InputError, StartsWithTheLocation) {
    EXPECT_STREQ(gault::core::InputError({"a.yaml", 2, 1}, "no").what(), "a.yaml:2:1: no");
    EXPECT_STREQ(gault::core::InputError(Location{}, "no").what(), "no");
}
