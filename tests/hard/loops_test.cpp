// Small loops far from a boundary that carries nearly all of the forces.
#include "tests/hard/hard_scene.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace gault::core::test {
namespace {

// Clay of G = 2.01342 MPa and s_u = 20 kPa under 10 MPa, out to a hundred cavity radii. A loop is elastic; the stress
// difference of at most 2 s_u that it moves along takes up to s_u off its modulus: dp = 2 (G - s_u) da / a where the soil
// has yielded far around, 2 G da / a where it has not.
std::vector<double> moduli(const char* tolerance) {
    HardScene s(
        "hard/clay_cavity",
        {{"geometry.annulus.outer_radius", "2 m"},
         {"boundaries.0", "{on: outer, type: far_field}"},
         {"materials.clay.young_modulus", "6 MPa"},
         {"materials.clay.poisson_ratio", "0.49"},
         {"materials.clay.cohesion", "20 kPa"},
         {"initial.stress", "{isotropic: 10 MPa}"},
         {"grid", "{cells: 147, basis: linear}"},
         {"points.per_cell", "1"},
         {"solver.tolerance", tolerance},
         {"program", "{type: pressuremeter, on: inner, rate: 1 mm/s, phases: ["
                     "expand: {until: {cavity_strain: 1 %}}, loop: {strain_amplitude: 0.1 %}, "
                     "expand: {until: {cavity_strain: 3 %}}, loop: {strain_amplitude: 0.1 %, count: 2}, "
                     "expand: {until: {cavity_strain: 6 %}}]}"}});
    s.run();
    const nlohmann::json derived = s.simulation.program().evaluate(s.rows);
    std::vector<double> all;
    for (int loop = 1; loop <= 3; ++loop)
        all.push_back(derived.at(fmt::format("loop_{}_shear_modulus", loop)).at("value"));
    return all;
}

TEST(Loops, OfSoftClayUnderHighStressHaveItsShearModulus) {
    const double modulus = 6e6 / (2.0 * 1.49), strength = 20e3;
    const auto found = moduli("1e-6"), exact = moduli("1e-9");
    for (std::size_t k = 0; k < 3; ++k) {
        std::printf("loop %zu: %.5g, with a tolerance of 1e-9 %.5g MPa\n", k + 1, found[k] / 1e6,
                    exact[k] / 1e6);
        EXPECT_NEAR(found[k], exact[k], 1e-3 * exact[k]);
        EXPECT_GT(found[k], 0.999 * (modulus - strength));
        EXPECT_LT(found[k], 1.001 * modulus);
    }
}

// Unloaded to nothing, all forces are rounding, and there is nothing to balance to a share of them.
TEST(Loops, RestWithoutAnyLoad) {
    for (const char* symmetry : {"radial", "axisymmetric"}) {
        HardScene s(
            "hard/elastic_cavity",
            {{"model", fmt::format("{{symmetry: {}, solver: quasi_static}}", symmetry)},
             {"geometry.annulus.outer_radius", "40 mm"},
             {"materials.soil.young_modulus", "10 MPa"},
             {"materials.soil.poisson_ratio", "0.3"},
             {"grid", "{cells: [10, 1], grading: {r: geometric}, basis: linear}"},
             {"points.per_cell", std::string(symmetry) == "radial" ? "1" : "4"},
             {"boundaries",
              "[{on: outer, type: pressure, value: 0 Pa}, {on: [top, bottom], type: roller}, {on: inner, "
              "type: pressure}]"},
             {"program",
              "{type: ramp, on: inner, smooth: false, pressure: [[0 s, 0 kPa], [1 s, 0 kPa], [2 s, 100 kPa], "
              "[3 s, 0 kPa], [4 s, 0 kPa], [5 s, 10 kPa]]}"}});
        s.run();
        EXPECT_NEAR(s.solver.time(), 5.0, 1e-12);
    }
}

} // namespace
} // namespace gault::core::test
