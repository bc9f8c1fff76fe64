// The probe of finite length against the infinite cylinder, and what docs/method.md says of it.
#include "tests/app/child.hpp"

namespace gault::test {
namespace {

class FiniteProbe : public App {
  protected:
    // The pressure at the end, where the gauge has moved by a tenth of the radius.
    double pressure(Words changes) const {
        Words words{"--force"};
        for (const std::string& change : changes) {
            words.push_back("--set");
            words.push_back(change);
        }
        run("configs/field/finite_probe.yaml", words);
        EXPECT_NEAR(history(results, "cavity_strain").back(), 0.1, 1e-8);
        return history(results, "true_pressure_Pa").back();
    }
};

// A membrane over the whole height is the infinite cylinder: 1348.39 kPa.
TEST_F(FiniteProbe, WithoutAnEndIsTheInfiniteCylinder) {
    EXPECT_NEAR(
        pressure({"geometry.annulus.height=120 mm", "geometry.parts={membrane: {of: inner, y: [0, 120 mm]}}",
                  "boundaries.1={on: top, type: roller}", "boundaries.3={on: top, type: roller}",
                  "grid.cells=[40, 2]", "grid.grading.y=1"}),
        1348.39e3, 0.5e3);
}

TEST_F(FiniteProbe, TakesMorePressureTheShorterItIs) {
    const Words coarse = {"grid.cells=[20, 24]", "grid.grading.y=1.09050773267"};
    Words longer = coarse;
    for (const char* change : {"geometry.annulus.height=1400 mm", "geometry.parts.membrane.y.1=200 mm",
                               "geometry.parts.casing.y=[200 mm, 1400 mm]"})
        longer.emplace_back(change);
    const double ten = pressure(longer);
    const double six = pressure(coarse);
    EXPECT_NEAR(ten, 1700e3, 20e3);
    EXPECT_NEAR(six, 1986e3, 20e3);
}

TEST_F(FiniteProbe, IsCheckedPartByPart) {
    const Outcome check = gault({"check", (repository / "configs/field/finite_probe.yaml").string()});
    EXPECT_EQ(check.status, 0) << check.err;
    for (const char* part :
         {"part membrane: 16 of 48 cells of inner, from 0 m to 0.12 m",
          "part casing: 32 of 48 cells of inner, from 0.12 m to 0.84 m", "roller on casing: 34 nodes",
          "wall on membrane: 18 nodes, 48 quadrature points"})
        EXPECT_TRUE(has(check.out, part)) << part << "\n" << check.out;
}

} // namespace
} // namespace gault::test
