#include "core/study/extrapolation.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace gault::core {
namespace {

// y = x + 1 and an error of order p.
SampledCurve curve(double size, double p) {
    SampledCurve c{{}, {}, size};
    for (int k = 0; k <= 100; ++k) {
        const double x = 0.01 * k;
        c.x.push_back(x);
        c.y.push_back(x + 1.0 + (1.0 + x) * std::pow(size, -p));
    }
    return c;
}

TEST(Extrapolation, FindsTheCurveOfNoSizeAndTheOrder) {
    for (const double p : {1.0, 2.0, 3.5}) {
        const auto found = extrapolate({curve(5, p), curve(10, p), curve(20, p), curve(40, p)});
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->order, p, 1e-9);
        for (std::size_t i = 0; i < found->x.size(); ++i)
            EXPECT_NEAR(found->y[i], found->x[i] + 1.0, 1e-9);
        EXPECT_NEAR(found->remaining, std::pow(40.0, -p), 1e-9); // the error is (1 + x) size^-p of 1 + x
        EXPECT_NEAR(distance(curve(10, p), *found), std::pow(10.0, -p), 1e-9);
    }
}

TEST(Extrapolation, TakesSizesThatFallAsWell) { // the length of a step
    const auto found = extrapolate({curve(4, -2), curve(2, -2), curve(1, -2)});
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->order, 2.0, 1e-9);
}

TEST(Extrapolation, NeedsThreeCurvesOfEvenRefinementWhoseDifferencesFall) {
    EXPECT_FALSE(extrapolate({curve(10, 2), curve(20, 2)}));
    EXPECT_FALSE(extrapolate({curve(10, 2), curve(20, 2), curve(80, 2)}));
    EXPECT_FALSE(extrapolate({curve(10, -1), curve(20, -1), curve(40, -1)}));
    EXPECT_FALSE(extrapolate({curve(10, 2), curve(std::nan(""), 2), curve(40, 2)}));
}

TEST(Extrapolation, OfACurveThatTurnsTakesWhatRises) {
    const SampledCurve c = rising_part({0, 1, 2, 1.5, 1.8, 2, 3}, {0, 10, 20, 15, 18, 20, 30}, 7);
    EXPECT_EQ(c.x, (std::vector<double>{0, 1, 2, 3}));
    EXPECT_EQ(c.y, (std::vector<double>{0, 10, 20, 30}));
}

} // namespace
} // namespace gault::core
