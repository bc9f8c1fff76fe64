#include "core/grid/axis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace gault::core {
namespace {

// degree, cells, ratio of neighbouring cells
class AnyAxis : public testing::TestWithParam<std::tuple<int, int, double>> {
  protected:
    int degree = std::get<0>(GetParam());
    Axis axis{Axis::graded(0.5, 3.0, std::get<1>(GetParam()), std::get<2>(GetParam())), degree};

    template <class F>
    void everywhere(F f) const { // f(cell, x, weights)
        for (int cell = 0; cell < axis.cells(); ++cell)
            for (const double xi : {0.0, 0.1, 0.37, 0.5, 0.93, 1.0})
                f(cell, axis.knots()[cell] + xi * axis.length()[cell], axis.weights(cell, xi));
    }
    double sum_of_values(const Axis::Weights& w) const { return w.value[0] + w.value[1] + w.value[2]; }
    double sum_of_slopes(const Axis::Weights& w) const { return w.slope[0] + w.slope[1] + w.slope[2]; }
};

TEST_P(AnyAxis, FunctionsAreAPartitionOfUnity) {
    everywhere([&](int, double, const Axis::Weights& w) {
        EXPECT_NEAR(sum_of_values(w), 1.0, 1e-15);
        EXPECT_NEAR(sum_of_slopes(w) * axis.length()[0], 0.0, 1e-14);
        for (const double value : w.value)
            EXPECT_GE(value, -1e-16);
    });
}

TEST_P(AnyAxis, NodesReproduceTheCoordinate) {
    everywhere([&](int cell, double x, const Axis::Weights& w) {
        double at = 0.0, slope = 0.0;
        for (int a = 0; a <= degree; ++a) {
            at += axis.node(cell + a) * w.value[a];
            slope += axis.node(cell + a) * w.slope[a];
        }
        EXPECT_NEAR(at, x, 1e-14);
        EXPECT_NEAR(slope, 1.0, 1e-12);
    });
}

TEST_P(AnyAxis, EndFunctionsAreOneOnTheEnds) {
    EXPECT_EQ(axis.weights(0, 0.0).value[0], 1.0);
    EXPECT_EQ(axis.weights(axis.cells() - 1, 1.0).value[degree], 1.0);
    EXPECT_EQ(axis.node(0), 0.5);
    EXPECT_EQ(axis.node(axis.nodes() - 1), 3.0);
}

TEST_P(AnyAxis, SlopesAreDerivativesOfTheValues) {
    constexpr double step = 1e-6; // of a quadratic, the central difference is exact but for rounding
    for (int cell = 0; cell < axis.cells(); ++cell)
        for (const double xi : {0.2, 0.5, 0.8}) {
            const auto before = axis.weights(cell, xi - step), after = axis.weights(cell, xi + step);
            const auto w = axis.weights(cell, xi);
            for (int a = 0; a <= degree; ++a)
                EXPECT_NEAR(w.slope[a] * axis.length()[cell],
                            (after.value[a] - before.value[a]) / (2.0 * step), 1e-9);
        }
}

TEST_P(AnyAxis, FunctionsAreContinuousAcrossKnots) {
    for (int cell = 0; cell + 1 < axis.cells(); ++cell) {
        const auto left = axis.weights(cell, 1.0), right = axis.weights(cell + 1, 0.0);
        EXPECT_NEAR(left.value[0], 0.0, 1e-15);
        EXPECT_NEAR(right.value[degree], 0.0, 1e-15);
        for (int a = 0; a < degree; ++a) {
            EXPECT_NEAR(left.value[a + 1], right.value[a], 1e-15);
            if (degree == 1) continue; // a linear function has a kink
            EXPECT_NEAR(left.slope[a + 1], right.slope[a], 1e-12 / axis.length()[cell]);
        }
    }
}

TEST_P(AnyAxis, EveryPositionIsInItsCell) {
    everywhere([&](int cell, double x, const Axis::Weights&) {
        const int found = axis.cell_of(x);
        EXPECT_LE(std::abs(found - cell), 1); // a knot belongs to either
        EXPECT_GE(x, axis.knots()[found] - 1e-14);
        EXPECT_LE(x, axis.knots()[found + 1] + 1e-14);
    });
    EXPECT_EQ(axis.cell_of(-1.0), 0);
    EXPECT_EQ(axis.cell_of(9.0), axis.cells() - 1);
    EXPECT_EQ(axis.cell_of(axis.upper()), axis.cells() - 1);
}

TEST_P(AnyAxis, MovingStretchesCellsAndKeepsTheFunctions) {
    Axis moved = axis;
    moved.move(1.0, 11.0); // four times as long
    EXPECT_EQ(moved.lower(), 1.0);
    EXPECT_EQ(moved.upper(), 11.0);
    for (int cell = 0; cell < axis.cells(); ++cell) {
        EXPECT_NEAR(moved.length()[cell], 4.0 * axis.length()[cell], 1e-14);
        const auto before = axis.weights(cell, 0.3), after = moved.weights(cell, 0.3);
        for (int a = 0; a <= degree; ++a) {
            EXPECT_NEAR(after.value[a], before.value[a], 1e-14);
            EXPECT_NEAR(after.slope[a], 0.25 * before.slope[a], 1e-13 / axis.length()[cell]);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Bases, AnyAxis,
                         testing::Values(std::tuple(1, 1, 1.0), std::tuple(1, 6, 1.0), std::tuple(1, 6, 1.3),
                                         std::tuple(2, 1, 1.0), std::tuple(2, 2, 0.5), std::tuple(2, 6, 1.0),
                                         std::tuple(2, 6, 1.3), std::tuple(2, 40, 1.1)));

TEST(Axis, QuadraticFunctionsReproduceTheSquare) {
    const Axis axis(Axis::graded(0.5, 3.0, 6, 1.3), 2);
    const auto knot = [&](int i) { return axis.knots()[std::clamp(i, 0, axis.cells())]; };
    for (int cell = 0; cell < axis.cells(); ++cell)
        for (const double xi : {0.0, 0.25, 0.8}) {
            const auto w = axis.weights(cell, xi);
            double square = 0.0; // the coefficient of x^2 is the product of the inner knots of the support
            for (int a = 0; a < 3; ++a)
                square += knot(cell + a - 1) * knot(cell + a) * w.value[a];
            const double x = axis.knots()[cell] + xi * axis.length()[cell];
            EXPECT_NEAR(square, x * x, 1e-14);
        }
}

TEST(Axis, GradedCellsHaveTheRatioOfTheirNeighbours) {
    const auto knots = Axis::graded(0.02, 0.2, 72, 1.05);
    EXPECT_EQ(knots.front(), 0.02);
    EXPECT_EQ(knots.back(), 0.2);
    for (std::size_t i = 2; i < knots.size(); ++i)
        EXPECT_NEAR((knots[i] - knots[i - 1]) / (knots[i - 1] - knots[i - 2]), 1.05, 1e-10);
}

TEST(Axis, CellsThatAreGradedByAlmostNothingAreStillGraded) {
    const auto knots = Axis::graded(0.0, 1.0, 2, 1.0 + 0x1p-40);
    EXPECT_NEAR(knots[1], 0.5 - 0x1p-42, 0x1p-52);
}

TEST(Axis, ARatioOfOneIsUniform) {
    const auto knots = Axis::graded(-1.0, 1.0, 8, 1.0);
    for (int i = 0; i <= 8; ++i)
        EXPECT_DOUBLE_EQ(knots[i], -1.0 + 0.25 * i);
}

} // namespace
} // namespace gault::core
