// A thick cylinder that creeps, plugins/viscoelastic/scene.yaml, against its closed form: Lame's displacement
// in plane strain by the correspondence principle, the inner pressure raised and held.
#include "tests/app/child.hpp"

#include <algorithm>
#include <cmath>

namespace gault::test {
namespace {

constexpr double inner = 1.0, outer = 3.0;                    // m
constexpr double shear = 10e9, bulk = 50e9 / 3.0, eta = 1e17; // Pa, Pa, Pa s
constexpr double rise = 1e4;                                  // s

struct Borehole { // without a Kelvin element where its modulus is 0
    double pressure;
    double delayed_shear = 0.0, delayed_eta = 1.0;

    // Shear strain after t for a unit of shear stress.
    double creep(double t) const {
        const double delayed =
            delayed_shear == 0.0 ? 0.0 : -std::expm1(-t * delayed_shear / delayed_eta) / delayed_shear;
        return 1.0 / shear + t / eta + delayed;
    }
    // Shear stress after t for a unit of shear strain, with g for the modulus.
    double relaxation(double g, double t) const {
        if (delayed_shear == 0.0) return g * std::exp(-t * g / eta);
        const double flow = g / eta, growth = g / delayed_eta, recovery = delayed_shear / delayed_eta;
        const double sum = flow + growth + recovery, root = std::sqrt(sum * sum - 4.0 * flow * recovery);
        const double fast = 0.5 * (sum + root), slow = 0.5 * (sum - root);
        return g * ((fast - recovery) * std::exp(-fast * t) + (recovery - slow) * std::exp(-slow * t)) / root;
    }
    // u = D b^2 / 2r J + D r f, D = p a^2 / (b^2 - a^2). Elastic: J = 1/G, f = 3 / (6K + 2G), which is
    // (1 - G'/3K) / 2K with 1/G' = 1/G + 1/3K; the transform of J stands for 1/G, and that of the relaxation
    // with the modulus G' for G'. A rise in proportion to time is a step in its middle, but for a factor of
    // 1 + (rise / T)^2 / 24 on what decays in T: below 3e-7 of that.
    double displacement(double r, double time) const {
        const double t = time - 0.5 * rise, d = pressure * inner * inner / (outer * outer - inner * inner);
        const double in_series = 1.0 / (1.0 / shear + 1.0 / (3.0 * bulk));
        const double f = (1.0 - relaxation(in_series, t) / (3.0 * bulk)) / (2.0 * bulk);
        return d * (outer * outer / (2.0 * r) * creep(t) + r * f);
    }
};

// Strain is straight in a step. A part of the displacement that decays with the time T, a share of it, is
// then off by at most share (dt / T)^2 / 12 t / T exp(-t / T); the longest step is that of the steady flow.
double error_of_steps(double strain_step, double pressure, double decay, double share) {
    const double strain_rate = 0.5 * pressure * outer * outer / (outer * outer - inner * inner) / eta;
    const double x = strain_step / strain_rate / decay;
    return share * x * x / 12.0 * std::exp(-1.0);
}

class Creep : public App {
  protected:
    void run_at(double pressure, double strain_step, Words more = {}) const {
        const std::string held = std::to_string(10e6 + pressure) + " Pa";
        for (const std::string& change : {"program.pressure.1.1=" + held, "program.pressure.2.1=" + held,
                                          "solver.strain_step=" + std::to_string(strain_step * 1e9) + "e-9",
                                          std::string("solver.tolerance=1e-12")})
            more.insert(more.end(), {"--set", change});
        more.push_back("--force");
        run("plugins/viscoelastic/scene.yaml", more);
    }
    // Of the wall while the pressure is held; `allowed` may depend on the displacement.
    template <class Allowed>
    double expect_wall(const Borehole& exact, Allowed allowed) const {
        const auto time = history(results, "time_s"), wall = history(results, "displacement_m");
        double largest = 0.0;
        for (std::size_t i = 0; i < time.size(); ++i) {
            if (time[i] < rise) continue;
            const double u = exact.displacement(inner, time[i]), error = wall[i] / u - 1.0;
            EXPECT_LE(std::abs(error), allowed(u)) << "at " << time[i] << " s";
            largest = std::max(largest, std::abs(error));
        }
        EXPECT_GT(time.size(), 70u);
        EXPECT_EQ(time.back(), 3e7); // three relaxation times
        return largest;
    }
};

// Steps: what decays in the relaxation time of the soil with G' is less than a fiftieth of u. 40 cells: the
// error with 10, 1.1e-5, over 4^4, as it falls with the fourth power of their width.
double error_of_maxwell(double strain_step, double pressure) {
    return error_of_steps(strain_step, pressure, eta / shear * (1.0 + shear / (3.0 * bulk)), 0.02) + 5e-8;
}

// Lame's cylinder does not change its shape. An incompressible one that does widens by 1 + (1 + 3/2 a^2/b^2)
// u/a times as much where it is elastic, and 1 + (1/2 + a^2/b^2) u/a where it flows: 3/2 u/a holds for both.
TEST_F(Creep, OfAThickCylinderIsTheClosedForm) {
    run("plugins/viscoelastic/scene.yaml");
    const Borehole exact{1e5};
    const double other = error_of_maxwell(2e-7, 1e5);
    expect_wall(exact, [&](double u) { return 1.5 * u / inner + other; });

    const fs::path file = results / "results.h5";
    const std::string frame = "/frames/" + core::test::members(file, "/frames").back();
    const auto moved = core::test::numbers(file, frame + "/displacement"),
               place = core::test::numbers(file, frame + "/reference_position");
    ASSERT_GT(place.shape[0], 100u);
    for (std::size_t i = 0; i < place.shape[0]; ++i) {
        const double u = exact.displacement(place.values[3 * i], 3e7);
        EXPECT_NEAR(moved.values[3 * i], u, 1.5 * exact.displacement(inner, 3e7) / inner * u) << i;
    }
}

// A hundredth of the load, and of the change of shape: 2.3e-7 in the end.
TEST_F(Creep, OfASmallLoadIsTheClosedFormToAMillionth) {
    run_at(1e3, 2e-9);
    const double other = error_of_maxwell(2e-9, 1e3);
    EXPECT_LT(other, 6e-7);
    expect_wall({1e3}, [&](double u) { return 1.5 * u / inner + other; });
}

TEST_F(Creep, WithAKelvinElementIsTheClosedFormToTheSquareOfTheStep) {
    const Borehole exact{1e3, 5e9, 2e16};
    const Words kelvin{"--set", "materials.salt.delayed_shear_modulus=5 GPa", "--set",
                       "materials.salt.delayed_viscosity=2e16 Pa s"};
    double error[2];
    for (const int half : {0, 1}) {
        const double strain_step = half ? 1e-9 : 2e-9;
        run_at(1e3, strain_step, kelvin);
        const double steps = error_of_steps(strain_step, 1e3, exact.delayed_eta / exact.delayed_shear, 1.0);
        error[half] = expect_wall(exact, [&](double) { return steps; });
    }
    EXPECT_NEAR(error[0] / error[1], 4.0, 0.4);
}

} // namespace
} // namespace gault::test
