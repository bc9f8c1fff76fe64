// A wall takes a pressure from a program, whose force a boundary without a drive takes alike.
#include "tests/app/child.hpp"

#include <fstream>

namespace gault::test {
namespace {

using ADrivenWall = App;

TEST_F(ADrivenWall, TakesThePressureOfARampAsAPressureDoes) {
    const auto displacement = [&](const std::string& boundary) {
        std::ofstream(work / "scene.yaml") << R"(gault: 1
title: A block under a pressure that rises
geometry:
  block: {width: 1 m, height: 0.5 m}
grid: {cells: [4, 2]}
points: {per_cell: 4}
materials:
  soil: {model: linear_elastic, density: 1800 kg/m^3, young_modulus: 10 MPa, poisson_ratio: 0.3}
boundaries:
  - {on: [right, top, bottom], type: roller}
  - {on: left, type: )" << boundary << R"(}
program: {type: ramp, on: left, pressure: [[0 s, 0 kPa], [0.1 s, 20 kPa]]}
)";
        const Outcome outcome = gault({"run", "scene.yaml", "-o", boundary, "--quiet"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return history(work / boundary, "displacement_m").back();
    };
    const double moved = displacement("wall"), oedometric = 20e3 / (10e6 * 0.7 / (1.3 * 0.4));
    EXPECT_NEAR(moved, oedometric, 0.05 * oedometric);
    EXPECT_EQ(moved, displacement("pressure"));
}

} // namespace
} // namespace gault::test
