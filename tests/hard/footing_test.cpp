// A rough rigid strip on soil without friction: Prandtl (1920), q = (2 + pi) s_u.
#include "tests/hard/hard_scene.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

namespace gault::core::test {
namespace {

// Load over strength and width: n cells along each metre.
double bearing_capacity(int n, const char* basis, const char* volumetric_strain) {
    HardScene s("hard/footing", {{"grid", "{cells: " + cells(2 * n, n) + ", basis: " + basis + "}"},
                                 {"model.volumetric_strain", volumetric_strain}});
    const double load = s.run().last("normal_force") / (20e3 * 0.5);
    std::printf("%-9s %-9s %2d cells a metre: %.4f\n", basis, volumetric_strain, n, load);
    return load;
}

} // namespace
} // namespace gault::core::test
