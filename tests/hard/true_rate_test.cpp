// Fahey's cylinder at the true rate and mass: 1 mm/s, some hundred thousand steps.
#include "tests/hard/ways.hpp"

namespace gault::core::test {
namespace {

class TrueRate : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Starts, TrueRate, testing::Values("ramp_time: 1 ns", "ramp_strain: 0.05 %"),
                         [](const auto& instance) {
                             return std::string(instance.index == 0 ? "AtOnce" : "Smooth");
                         });

// Ten times slower than SmoothStart.IsForgottenAtTenPercent: the wave is a tenth, 0.44 kPa, and so is what it leaves.
TEST_P(TrueRate, HasTheExactPressureAtTenPercent) {
    HardScene s("hard/sand_cavity",
                {{"model.frame", "total"},
                 {"model.solver", "explicit"},
                 {"geometry.annulus.outer_radius", "200 mm"},
                 {"grid.cells", "30"},
                 {"boundaries.0", "{on: outer, type: pressure, value: 90 kPa}"},
                 {"program", fmt::format("{{type: pressuremeter, on: inner, rate: 1 mm/s, {}, until: "
                                         "{{cavity_strain: 10 %}}}}",
                                         GetParam())}});
    const double pressure = s.run().last("true_pressure") / 1e3;
    std::printf("%s: %.3f kPa, expected 597.34 (%+.4f %%)\n", GetParam(), pressure,
                100.0 * (pressure / 597.34 - 1.0));
    EXPECT_NEAR(pressure, 597.34, 1e-3 * 597.34);
}

} // namespace
} // namespace gault::core::test
