// The biaxial test on three grids: what softening costs, and where the solver without inertia ends.
#include "tests/hard/biaxial.hpp"

#include <gtest/gtest.h>

#include <array>

namespace gault::core::test {
namespace {

const std::vector<Override> quick{{"solver.mass_scaling", "4"}};
const std::array<int, 3> grids{8, 16, 32};

// Work of the plate above that on sand of the ultimate strength from the start, on the same grid.
std::vector<double> work_of_softening(const std::vector<Biaxial>& runs) {
    std::vector<double> work;
    for (std::size_t i = 0; i < grids.size(); ++i) {
        const Biaxial ultimate(grids[i], 0.0, 3.0,
                               {{"solver.mass_scaling", "4"},
                                {"materials.sand.friction_angle", "36 deg"},
                                {"regions.0.overrides.friction_angle", "36 deg"}});
        work.push_back(runs[i].work() - ultimate.work());
        std::printf("%d cells: softening takes %.1f kPa mm\n", grids[i], work.back());
    }
    return work;
}

std::vector<Biaxial> on_every_grid(double length) {
    std::vector<Biaxial> runs;
    for (const int n : grids)
        runs.emplace_back(n, length, 3.0, quick);
    return runs;
}

TEST(BiaxialStudy, SettlesWithRegularisation) {
    const std::vector<Biaxial> runs = on_every_grid(10.0);
    EXPECT_LT(Difference(runs[0], runs[1], 0.7, 3.0).mean, 0.02);
    EXPECT_LT(Difference(runs[1], runs[2], 0.7, 3.0).mean, 0.02);
    const std::vector<double> work = work_of_softening(runs);
    EXPECT_NEAR(work[1] / work[0], 1.0, 0.1);
    EXPECT_NEAR(work[2] / work[1], 1.0, 0.05);
    EXPECT_NEAR(runs[1].width / runs[2].width, 1.8, 0.2) << "the band goes on to narrow";
}

// To nothing: by half, or more, with each halving of the cells.
TEST(BiaxialStudy, LosesItsWorkWithoutRegularisation) {
    const std::vector<Biaxial> runs = on_every_grid(0.0);
    const std::vector<double> work = work_of_softening(runs);
    EXPECT_LT(work[1] / work[0], 0.6);
    EXPECT_LT(work[2] / work[1], 0.6);
    EXPECT_GT(Difference(runs[1], runs[2], 0.7, 3.0).largest, 0.1);
}

TEST(BiaxialStudy, FindsNoEquilibriumWithoutInertiaWhereTheLoadDropsAtOnce) {
    const std::vector<Override> still{{"model.solver", "quasi_static"},
                                      {"program.velocity", "[[0 s, 20 mm/s], [0.15 s, 20 mm/s]]"}};
    const Biaxial slow(16, 10.0, 3.0, still), fast(16, 10.0, 3.0, quick);
    EXPECT_LT(Difference(fast, slow, 0.7, 3.0).mean, 0.02);
    EXPECT_THROW(Biaxial(16, 0.0, 3.0, still), RunError);
}

} // namespace
} // namespace gault::core::test
