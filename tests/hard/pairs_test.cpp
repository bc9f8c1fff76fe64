// Fahey's sand opened, unloaded into reverse yield and opened again, for which there is no closed form: one computation
// against another that shares little with it. Radial against axisymmetric, total against updated, explicit against
// quasi-static.
#include "tests/hard/hard_scene.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <map>

namespace gault::core::test {
namespace {

struct Way {
    const char *symmetry, *frame, *solver;
};

// Pressures where phases end; each kind of computation runs once.
const std::vector<double>& pressures(const Way& way) {
    static std::map<std::string, std::vector<double>> known;
    std::vector<double>& p = known[fmt::format("{} {} {}", way.symmetry, way.frame, way.solver)];
    if (!p.empty()) return p;
    const std::string path =
        "expand: {until: {cavity_strain: 1 %}}}, {expand: {until: {cavity_strain: 2 %}}}, "
        "{unload: {until: {cavity_strain: 1.8 %}}}, {unload: {until: {cavity_strain: 1.4 %}}}, "
        "{expand: {until: {cavity_strain: 1.6 %}}}, {expand: {until: {cavity_strain: 2.5 %}}";
    const bool one = std::string(way.symmetry) == "radial";
    HardScene s(
        "paper/fahey",
        {{"model",
          fmt::format("{{symmetry: {}, frame: {}, solver: {}}}", way.symmetry, way.frame, way.solver)},
         {"grid", fmt::format("{{cells: {}, basis: quadratic}}", one ? "36" : "[36, 1]")},
         {"points", fmt::format("{{per_cell: {}}}", one ? 2 : 4)},
         {"solver", std::string(way.solver) == "explicit" ? "{mass_scaling: 25}" : "{strain_step: 0.05 %}"},
         {"output", "{}"},
         {"reference", "{}"},
         {"program", "{type: pressuremeter, on: inner, rate: 1 mm/s, phases: [{" + path + "}]}"}});
    s.run();
    const auto phase = s.column("phase"), pressure = s.column("true_pressure");
    for (std::size_t i = 0; i < phase.size(); ++i)
        if (i + 1 == phase.size() || phase[i + 1] > phase[i]) p.push_back(pressure[i]);
    std::printf("%-12s %-7s %-12s:", way.symmetry, way.frame, way.solver);
    for (const double x : p)
        std::printf(" %.3f", x / 1e3);
    std::printf(" kPa\n");
    return p;
}

double largest_difference(const Way& a, const Way& b) {
    const auto &p = pressures(a), &q = pressures(b);
    EXPECT_EQ(p.size(), q.size());
    double size = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < std::min(p.size(), q.size()); ++i) {
        size = std::max(size, q[i]);
        largest = std::max(largest, std::abs(p[i] - q[i]));
    }
    return largest / size;
}

const char *const radial = "radial", *const axisymmetric = "axisymmetric", *const total = "total",
                  *const updated = "updated", *const moving = "explicit", *const still = "quasi_static";

// The same problem in one coordinate and in two: but for rounding without inertia, and for its growth over the steps.
TEST(Pairs, RadialAgainstAxisymmetric) {
    for (const char* frame : {total, updated}) {
        const double without = largest_difference({axisymmetric, frame, still}, {radial, frame, still});
        const double with = largest_difference({axisymmetric, frame, moving}, {radial, frame, moving});
        std::printf("radial against axisymmetric, %s: %.1e quasi-static, %.1e explicit\n", frame, without,
                    with);
        EXPECT_LT(without, 1e-6); // what Newton's method leaves
        EXPECT_LT(with, 1e-6);
    }
}

// Gauss points that move with the soil no longer are Gauss points: a part of the error of the grid, 1e-4 with 36 cells.
TEST(Pairs, TotalAgainstUpdated) {
    for (const char* solver : {still, moving}) {
        const double difference =
            largest_difference({axisymmetric, updated, solver}, {axisymmetric, total, solver});
        std::printf("total against updated, %s: %.1e\n", solver, difference);
        EXPECT_LT(difference, 1e-4);
    }
}

// A wall that starts at once would send rho c V = 2 kPa (mass x 25) into the soil, 4e-3 of the pressure; this one takes
// its time.
TEST(Pairs, ExplicitAgainstQuasiStatic) {
    for (const char* symmetry : {radial, axisymmetric})
        for (const char* frame : {total, updated}) {
            const double difference = largest_difference({symmetry, frame, moving}, {symmetry, frame, still});
            std::printf("explicit against quasi-static, %s, %s: %.1e\n", symmetry, frame, difference);
            EXPECT_LT(difference, 1e-3);
        }
}

} // namespace
} // namespace gault::core::test
