// What is derived: each analysis on the curve that it was made for.
#include "settings_test.hpp"

#include <gtest/gtest.h>

namespace {
using namespace plugin_test;

// The results of a test whose rows follow p(cavity strain) while it was driven as `c` says.
class Derived {
  public:
    Derived(const Component& c) : run_(c) {}

    void row(double strain, double pressure, int loop = 0, int pressure_step = 0) {
        run_.rows.push_back(std::vector<double>(run_.record.size()));
        const auto set = [&](const char* name, double value) {
            run_.recorded(run_.rows.back(), name) = value;
        };
        set("cavity_strain", strain);
        set("true_pressure", pressure);
        set("volume", M_PI * std::pow(a0 * (1.0 + strain), 2) * height);
        set("phase", 1.0);
        set("loop", loop);
        set("pressure_step", pressure_step);
        set("held", pressure_step > 0);
        run_.times.push_back(static_cast<double>(run_.times.size()));
    }
    std::map<std::string, ProgramRun::Result> all() { return run_.evaluate(); }

  private:
    ProgramRun run_;
};

TEST(PressuremeterResults, LiftOffIsWhereTheWallFirstMoves) {
    const Component c = program({{"rate", 1e-3}});
    Derived derived(c);
    derived.row(0.0, 90e3);
    derived.row(1e-4, 98e3);
    EXPECT_EQ(derived.all()["lift_off_stress"].value, 90e3);
    Derived closed(c);
    closed.row(0.0, 90e3);
    EXPECT_NE(closed.all()["lift_off_stress"].reason, "");
}

TEST(PressuremeterResults, LoopsGiveTheShearModulusOfAnElasticSoil) {
    const Component c = program({{"rate", 1e-3}});
    Derived derived(c);
    const double G = 40e6, top = 0.03, bottom = 0.028;
    const auto p = [&](double strain) { return 400e3 + 2.0 * G * std::log((1.0 + strain) / (1.0 + top)); };
    derived.row(0.0, 90e3);
    derived.row(top, 400e3);
    for (const double strain : {0.029, bottom, 0.029, top})
        derived.row(strain, p(strain), 1);
    auto results = derived.all();
    EXPECT_NEAR(results["loop_1_shear_modulus"].value, G, 1e-9 * G);
    EXPECT_NEAR(results["loop_1_amplitude"].value, std::log((1.0 + top) / (1.0 + bottom)), 1e-12);
    EXPECT_NEAR(results["loop_1_mean_pressure"].value, 0.5 * (400e3 + p(bottom)), 1e-6);
}

// p' = K ((a - a0) / a)^s is what Hughes, Wroth and Windle (1977) derive, with s of the two angles.
TEST(PressuremeterResults, HughesReturnsTheAnglesOfItsOwnCurve) {
    const double phi = 45.0 * degree, critical = 33.0 * degree, u0 = 60e3;
    // sin psi = (sin phi - sin phi_cv) / (1 - sin phi sin phi_cv), s = (1 + sin psi) sin phi / (1 + sin phi)
    const double sin_psi = (std::sin(phi) - std::sin(critical)) / (1.0 - std::sin(phi) * std::sin(critical));
    const double s = (1.0 + sin_psi) * std::sin(phi) / (1.0 + std::sin(phi));
    const Component c =
        program({{"rate", 1e-3}, {"critical_friction_angle", critical}, {"pore_pressure", u0}});
    Derived derived(c);
    for (int i = 0; i <= 400; ++i) {
        const double strain = 0.1 * i / 400.0;
        derived.row(strain, u0 + 2e6 * std::pow(strain / (1.0 + strain), s));
    }
    auto results = derived.all();
    // Rows are joined by straight lines in ln p, ln strain, which p with u0 is not quite.
    EXPECT_NEAR(results["friction_angle"].value, 45.0, 1e-3);
    EXPECT_NEAR(results["dilation_angle"].value, std::asin(sin_psi) / degree, 1e-3);
    EXPECT_NE(results["undrained_strength"].reason.find("not straight"), std::string::npos);
}

TEST(PressuremeterResults, HughesNeedsTheCriticalAngleAndTheRange) {
    const Component without = program({{"rate", 1e-3}});
    Derived derived(without);
    derived.row(0.0, 90e3);
    EXPECT_NE(derived.all()["friction_angle"].reason.find("critical_friction_angle"), std::string::npos);
    const Component with = program({{"rate", 1e-3}, {"critical_friction_angle", 0.6}});
    Derived early(with);
    early.row(0.0, 90e3);
    early.row(0.05, 900e3);
    EXPECT_NE(early.all()["friction_angle"].reason.find("does not cover"), std::string::npos);
}

TEST(PressuremeterResults, GibsonAndAndersonReturnTheStrengthOfTheirOwnCurve) {
    const double su = 50e3, limit = 380e3;
    const Component c = program({{"rate", 1e-3}, {"critical_friction_angle", 0.6}});
    Derived derived(c);
    for (int i = 1; i <= 200; ++i) {
        const double strain = 0.1 * i / 200.0;
        derived.row(strain, limit + su * std::log(1.0 - std::pow(1.0 + strain, -2.0)));
    }
    auto results = derived.all();
    EXPECT_NEAR(results["undrained_strength"].value, su, 1e-3 * su); // 0.5 % of strain between rows
    EXPECT_NEAR(results["undrained_limit_pressure"].value, limit, 1e-3 * limit);
    EXPECT_NE(results["friction_angle"].reason.find("not straight"), std::string::npos);
}

TEST(PressuremeterResults, MenardsModulusOfAnElasticSoil) {
    const double G = 5e6, nu = 0.33, p0 = 100e3;
    const Component c = program({{"rate", 1e-3}});
    Derived derived(c);
    derived.row(0.0, p0);
    double middle = 0.0;
    for (int step = 1; step <= 5; ++step) { // a / a0 = exp((p - p0) / 2 G): dp/dV V = G at every point
        const double strain = std::exp(20e3 * step / (2.0 * G)) - 1.0;
        derived.row(strain, p0 + 20e3 * step, 0, step);
        middle = strain;
    }
    // V_m dp/dV of the chord over x = 2 ln(a2 / a1): G (x / 2) coth(x / 2).
    const double x = 2.0 * std::log(1.0 + middle), chord = 0.5 * x / std::tanh(0.5 * x);
    EXPECT_NEAR(derived.all()["menard_modulus"].value, 2.0 * (1.0 + nu) * G * chord, 1e-9 * G);
}

TEST(PressuremeterResults, MenardsLimitPressureIsMeasuredOrExtrapolated) {
    const Component c = program({{"rate", 1e-3}});
    const auto up_to = [&](double last) { // 1 / (V - V0) falls evenly with p: the extrapolation is exact
        Derived derived(c);
        derived.row(0.0, 100e3);
        for (double strain = 0.01; strain < last + 1e-9; strain += 0.001)
            derived.row(strain, 800e3 - 100e3 / (std::pow(1.0 + strain, 2) - 1.0));
        return derived.all()["menard_limit_pressure"];
    };
    EXPECT_NEAR(up_to(0.45).value, 700e3, 1.0); // straight lines between rows 0.1 % apart
    EXPECT_EQ(up_to(0.45).note, "measured");
    EXPECT_NEAR(up_to(0.25).value, 700e3, 1e-3);
    EXPECT_EQ(up_to(0.25).note.substr(0, 12), "extrapolated");
    EXPECT_NE(up_to(0.2).reason, "");
}

// Exact pressures of an infinite Mohr-Coulomb soil (Yu and Houlsby 1991; E 100 MPa, nu 0.25, c 1 kPa, phi 48 and psi
// 16.5 degrees, 90 kPa), whose limit is 3797.85 kPa.
TEST(PressuremeterResults, LimitPressureOfAWideCavity) {
    const Component c = program({{"rate", 1e-3}});
    Derived derived(c);
    const double pressures[][2] = {
        {1.1, 1348.388e3}, {2.0, 3047.555e3}, {3.2, 3454.569e3}, {4.0, 3558.298e3}, {5.0, 3630.034e3}};
    for (const auto& [ratio, pressure] : pressures)
        derived.row(ratio - 1.0, pressure);
    EXPECT_NEAR(derived.all()["limit_pressure"].value, 3797.85e3, 0.005 * 3797.85e3);
}

} // namespace
