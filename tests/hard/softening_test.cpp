// Soil that softens: a cavity, where nothing localises, and a biaxial test, where a shear band forms.
#include "tests/hard/biaxial.hpp"
#include "tests/hard/ways.hpp"

namespace gault::core::test {
namespace {

class SofteningCylinder : public EveryWay {
  protected:
    double pressure(int n, const std::vector<Override>& more = {}) const {
        std::vector<Override> all =
            with({{"grid.cells", std::to_string(n)}, moved_to({0.1}, "15 mm/s", true, has_inertia())});
        all.insert(all.end(), more.begin(), more.end());
        HardScene s("hard/softening_cylinder", all);
        s.run();
        return pressure_at_strain(s, 0.1);
    }
};
INSTANTIATE_TEST_SUITE_P(Ways, SofteningCylinder, every_way(), name_of_way);

// Another program has 550.608, 550.467, 550.457, 550.448 kPa on 25 to 200 cells.
TEST_P(SofteningCylinder, HasAPressureThatTheGridDoesNotChange) {
    const double coarse = pressure(25), fine = pressure(50);
    expect_near("softening sand, 25 cells", coarse, 550.448, has_inertia() ? 5e-3 : 1e-3);
    expect_near("softening sand, 50 cells", fine, 550.448, has_inertia() ? 5e-3 : 1e-3);
    expect_near("25 cells against 50", coarse, fine, 1e-3);
}

// 552.75 kPa where dilation falls with friction: the number above is one of constant dilation.
TEST_P(SofteningCylinder, HasAnotherPressureWhereDilationCeases) {
    const double p = pressure(50, {{"materials.sand.ultimate_dilation_angle", "0 deg"}});
    std::printf("%-22s dilation to 0: %.3f kPa\n", GetParam().name().c_str(), p);
    EXPECT_GT(p, 550.448 * 1.002);
}

const std::vector<Override> quick{{"solver.mass_scaling", "4"}};

// Strength that falls over one strain in every cell falls within half the slip on half the cells; scaled with the cell it
// falls within the same. The first 0.15 mm behind the peak are left out: the band forms there, and the plate swings.
TEST(BiaxialTest, DependsOnTheGridUnlessItIsRegularised) {
    const Biaxial plain5(8, 0.0, 2.0, quick), plain2(16, 0.0, 2.0, quick);
    const Biaxial scaled5(8, 10.0, 2.0, quick), scaled2(16, 10.0, 2.0, quick);
    // The whole specimen yields at once: (100 kPa + y)/kappa; what it is above that is inertia.
    for (const Biaxial* b : {&plain5, &plain2, &scaled5, &scaled2})
        EXPECT_NEAR(b->peak(), 683.9, 0.02 * 683.9);
    EXPECT_GT(Difference(plain5, plain2, 0.7, 2.0).mean, 0.05);
    EXPECT_LT(Difference(scaled5, scaled2, 0.7, 2.0).mean, 0.02);
    // On both grids the band has some three cells, whether scaled or not: its width is no result.
    for (const Biaxial* b : {&plain5, &plain2, &scaled5, &scaled2}) {
        EXPECT_NEAR(b->width / b->cell, 3.3, 0.7);
        EXPECT_NEAR(b->angle, 60.0, 5.0); // between 45 + psi/2 and 45 + phi/2
    }
}

TEST(BiaxialTest, IsTheSameWithoutInertia) {
    const std::vector<Override> still{{"model.solver", "quasi_static"},
                                      {"program.velocity", "[[0 s, 20 mm/s], [0.15 s, 20 mm/s]]"}};
    const Biaxial slow(8, 10.0, 3.0, still), fast(8, 10.0, 3.0);
    EXPECT_NEAR(slow.peak(), 683.9, 0.03 * 683.9); // steps do not end at it
    EXPECT_LT(Difference(fast, slow, 0.7, 3.0).mean, 0.01);
}

// Where the softening strain is too short for its cell no step has an answer, and the run says so.
TEST(BiaxialTest, EndsWithASentenceWhereTheSoilSnapsBack) {
    try {
        Biaxial brittle(8, 0.0, 2.0,
                        {{"materials.sand.softening_strain", "0.05 %"}, {"solver.mass_scaling", "4"}});
        FAIL() << "it must not run";
    } catch (const RunError& e) {
        EXPECT_NE(std::string(e.what()).find("snaps back"), std::string::npos) << e.what();
    }
}

} // namespace
} // namespace gault::core::test
