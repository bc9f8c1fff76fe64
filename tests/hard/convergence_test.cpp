// Case II of the paper, an elastic thick cylinder under both pressures, on finer and finer grids: the error
// of the raw point stress, relative L2 norm, against Lame.
//
// What is found, and why. The radial strain of a linear basis is constant in a cell while the hoop strain u/r
// is not, so the stress is a saw-tooth about the exact one: first order at the points. Four Gauss points and
// sixteen give the same norm, since both integrate the square of a tooth exactly. One point a cell stands
// where the tooth crosses zero and might be of second order, but the points' velocities are mapped through
// it: a nodal motion whose sign alternates all but vanishes there, so forces of that shape are balanced only
// as far as the grading of the cells lets them be seen. After a long time the error is ten times that of four
// points, after a short one tens of percent. A quadratic basis has a linear strain in a cell: second order.
// Its 2 x 2 Gauss points are the superconvergent ones of a linear strain; four points therefore look better
// than sixteen, without the field being better elsewhere.
#include "core/scheduler/cautions.hpp"
#include "tests/hard/hard_scene.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace gault::core::test {
namespace {

struct Errors {
    double radial, hoop;
};

// The load is scaled down so that finite strain (a/a0 - 1 = 2e-7) plays no part.
Errors errors(const char* basis, const char* per_cell, int n) {
    HardScene s("paper/case2", {{"grid.cells", cells(n)},
                                {"grid.basis", basis},
                                {"points.per_cell", per_cell},
                                {"reference", "{}"},
                                {"boundaries.0.table", "[[0 s, 0 kPa], [50 ms, 20 kPa], [400 ms, 20 kPa]]"},
                                {"program.pressure", "[[0 s, 0 kPa], [50 ms, 10 kPa], [400 ms, 10 kPa]]"}});
    s.run();
    const Lame lame{2.0, 20.0, 20e3, 10e3, 70e9, 0.3};
    const PointArrays p = s.points();
    return {l2_error(p, 0, [&](std::size_t i) { return -lame.radial(p.reference[0][i]); }),
            l2_error(p, 2, [&](std::size_t i) { return -lame.hoop(p.reference[0][i]); })};
}

// The order between the coarsest and the finest of three grids, the smaller of both stresses'.
double order(const char* basis, const char* per_cell) {
    std::vector<Errors> all;
    for (const int n : {10, 20, 40}) {
        all.push_back(errors(basis, per_cell, n));
        std::printf("%-9s %2s points %3d cells: sigma_r %.3e sigma_theta %.3e\n", basis, per_cell, n,
                    all.back().radial, all.back().hoop);
    }
    return 0.5 * std::log2(std::min(all[0].radial / all[2].radial, all[0].hoop / all[2].hoop));
}

TEST(RawStress, ConvergesWithFirstOrderForTheLinearBasis) {
    EXPECT_GT(order("linear", "16"), 0.9);
    EXPECT_GT(order("linear", "4"), 0.9);
}
TEST(RawStress, ConvergesWithSecondOrderForTheQuadraticBasis) {
    EXPECT_GT(order("quadratic", "16"), 1.8);
    EXPECT_GT(order("quadratic", "4"), 1.8);
}
TEST(RawStress, IsMuchWorseWithOnePointALinearCellAndTheUserIsTold) {
    EXPECT_GT(errors("linear", "1", 20).radial, 5.0 * errors("linear", "4", 20).radial);
    const auto said = cautions(scene_of("paper/case2", {{"points.per_cell", "1"}, {"grid.basis", "linear"}}));
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(said[0].find("one point a cell passes no motion whose sign alternates"), std::string::npos);
}

} // namespace
} // namespace gault::core::test
