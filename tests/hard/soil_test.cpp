// Parameters at the ends of their ranges, and a wall that pulls: in both frames and with both solvers.
#include "tests/hard/closed_forms.hpp"
#include "tests/hard/ways.hpp"

namespace gault::core::test {
namespace {

class Sand : public EveryWay {
  protected:
    void expect_pressure(const char* what, const std::string& key, const char* value, const YuHoulsby& exact,
                         double strain = 0.1) const {
        HardScene s("hard/sand_cavity",
                    with({{key, value}, moved_to({strain}, "15 mm/s", true, has_inertia())}));
        s.run();
        expect_near(what, pressure_at_strain(s, strain), exact.pressure(1.0 + strain) / 1e3,
                    has_inertia() ? 5e-3 : 1e-3);
    }
};
INSTANTIATE_TEST_SUITE_P(Ways, Sand, every_way(), name_of_way);

TEST_P(Sand, WithoutCohesion) {
    expect_pressure("cohesion 0, 10 %", "materials.sand.cohesion", "0 Pa", {.cohesion = 0.0});
}
// The closed form takes the axial stress, which then stays p0, for the intermediate one: up to 616 kPa, alpha p0 + Y.
TEST_P(Sand, OfPoissonsRatioZero) {
    expect_pressure("nu 0, 1 %", "materials.sand.poisson_ratio", "0", {.nu = 0.0}, 0.01);
}
// Associated flow; 48 degrees as well in frames_and_solvers_test.cpp, and a friction angle of 0, which is Tresca's, as clay there.
TEST_P(Sand, ThatDilatesByItsFrictionAngle) {
    expect_pressure("dilation = friction = 16.5 deg, 10 %", "materials.sand.friction_angle", "16.5 deg",
                    {.phi = 16.5});
}

// The largest principal stress of a raw point, tension positive; in radial symmetry there is no shear.
double largest_tension(const HardScene& s) {
    const PointArrays p = s.points();
    double largest = -HUGE_VAL;
    for (const std::vector<double>& stress : {p.stress[0], p.stress[1], p.stress[2]})
        largest = std::max(largest, *std::max_element(stress.begin(), stress.end()));
    return largest;
}

// No stress leaves the yield surface, so the wall feels no more than the tensile strength: c cot(phi), or the cut-off.
TEST_P(Sand, FollowsAWallThatPullsNoFurtherThanItsTensileStrength) {
    const double apex = 1e3 / std::tan(48.0 * std::numbers::pi / 180.0);
    EXPECT_NEAR(apex, 900.40, 0.005);
    for (const auto& [strength, most] : {std::pair{"1 MPa", apex}, {"0 Pa", 0.0}}) {
        HardScene s("hard/pulled_wall", with({{"materials.sand.tension_strength", strength}}));
        double tension = -HUGE_VAL;
        s.run([&] { tension = std::max(tension, largest_tension(s)); });
        const auto p = s.column("true_pressure");
        const double highest = *std::max_element(p.begin(), p.end()),
                     pull = -*std::min_element(p.begin(), p.end());
        std::printf("%-22s cut-off %s: largest tension %.2f Pa, at most %.2f; pull of the wall %.1f Pa; "
                    "highest pressure %.1f kPa\n",
                    GetParam().name().c_str(), strength, tension, most, pull, highest / 1e3);
        EXPECT_LE(tension, most + 1e-6);
        // The force on the wall's node is good to a thousandth; with inertia a wall that turns back feels rho c v.
        const double inertia = has_inertia() ? std::sqrt(1600.0 * 120e6) * 0.01 : 0.0;
        EXPECT_LE(pull, most + 1e-3 * highest + inertia);
        EXPECT_GT(highest, 600e3);
    }
}

} // namespace
} // namespace gault::core::test
