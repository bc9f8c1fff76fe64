// The boundary that stands for elastic soil beyond: its spring at rest, its dashpots for a pulse.
#include "tests/hard/closed_forms.hpp"
#include "tests/hard/ways.hpp"

namespace gault::core::test {
namespace {

class FarField : public EveryWay {};
// With inertia: Cavity.InSandWithoutBoundToTwiceItsRadius, whose dashpots act.
INSTANTIATE_TEST_SUITE_P(Ways, FarField,
                         testing::Values(Way{"total", "quasi_static"}, Way{"updated", "quasi_static"}),
                         name_of_way);

// At 14 cavity radii, just outside the soil that yields (13.56), against 50, on cells of the same proportions. Without
// inertia: the dashpots do nothing.
TEST_P(FarField, AtFourteenRadiiIsTheSoilBeyond) {
    const auto pressure = [&](double radii) {
        HardScene s(
            "hard/sand_cavity",
            with({{"geometry.annulus.outer_radius", fmt::format("{} mm", 20.0 * radii)},
                  {"grid.cells", std::to_string(std::lround(60.0 * std::log(radii) / std::log(14.0)))},
                  {"solver", "{tolerance: 1e-9}"},
                  moved_to({0.1}, "20 mm/s", true, false)}));
        s.run();
        return pressure_at_strain(s, 0.1);
    };
    const double near = pressure(14.0), far = pressure(196.0);
    expect_near("14 against 196 radii", near, far, 1e-4);
    expect_near("14 radii against the closed form", near, YuHoulsby{}.pressure(1.1) / 1e3, 1e-3);
}

// A column that is struck at its foot; what is left of the pulse's energy when it has had the time to come back.
class Pulse : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Frames, Pulse, testing::Values("total", "updated"),
                         [](const auto& instance) { return std::string(instance.param); });

TEST_P(Pulse, LeavesThroughTheDashpots) {
    HardScene s("hard/pulse", {{"model.frame", GetParam()}});
    const double transit = 1.0 / std::sqrt(120e6 / 1600.0), struck = 1.6e-3; // 1 m; s
    double most = 0.0, left = 0.0;
    s.run([&] {
        const Energies e = s.solver.energies();
        most = std::max(most, e.kinetic);
        if (s.solver.time() >= struck + 2.0 * transit) left = std::max(left, e.kinetic);
    });
    std::printf("%s: %.3e of the kinetic energy is left after two transits\n", GetParam(), left / most);
    EXPECT_GT(most, 0.0);
    EXPECT_GT(s.solver.time(), struck + 3.0 * transit);
    EXPECT_LT(left, 1e-3 * most);
}

} // namespace
} // namespace gault::core::test
