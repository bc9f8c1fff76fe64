// That the sand answers whatever comes, within its bounds and the same everywhere.
#include "sand_test.hpp"

namespace {
using namespace norsand_test;

// q beyond the surface, with M(theta) by its angle.
double overstress(const Soil& soil, const Tensor& stress, double e, double image) {
    const double p = mean_pressure(stress), x = std::log(image / p), psi_i = soil.state(e, image);
    const double shape = 1.0 - soil.N * std::min(1.0, soil.chi_i() / soil.M * std::abs(psi_i));
    const double friction = soil.friction(lode_angle(stress));
    return deviator_size(stress) - friction * shape * (1.0 + x) * p;
}

class Random {
  public:
    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    Tensor tensor(double size) {
        Tensor t;
        for (double& x : t)
            x = size * uniform(-1.0, 1.0);
        return t;
    }

  private:
    std::mt19937_64 engine_{5};
};

// Isotropic stresses of 1 kPa to 10 MPa, each strained at random a few times.
void fill_at_random(Batch& b, Random& random, double largest) {
    for (int64_t i = 0; i < b.count(); ++i)
        b.set_stress_old(i, isotropic(std::pow(10.0, random.uniform(3.0, 7.0))));
    ASSERT_EQ(b.start(), GAULT_OK);
    for (int repeat = 0; repeat < 3; ++repeat) {
        for (int64_t i = 0; i < b.count(); ++i)
            b.set_strain(i, random.tensor(std::pow(10.0, random.uniform(-6.0, std::log10(largest)))));
        ASSERT_EQ(b.update(), GAULT_OK) << b.error.text;
        b.advance();
    }
}

TEST(NorSand, NeverLeavesItsSurface) {
    for (const double psi : {-0.25, 0.0, 0.1})
        for (const double cap : {0.0, 1.0}) {
            Soil soil;
            soil.psi = psi, soil.cap = cap;
            const Component c = soil.component(variants().back());
            Random random;
            Batch b(c, 300);
            fill_at_random(b, random, 3e-3);
            int on = 0, within = 0;
            for (int64_t i = 0; i < b.count(); ++i) {
                const Tensor s = b.stress_at(i);
                const double p = mean_pressure(s),
                             over = overstress(soil, s, b.state[void_ratio][i], b.state[image_pressure][i]);
                ASSERT_TRUE(std::isfinite(over)) << i;
                ASSERT_LE(over, 3e-4 * p) << i; // the edge of M(theta) at compression is rounded by 1e-4
                ASSERT_GE(p, 100.0 * (1.0 - 1e-12)) << i;
                ASSERT_GE(b.state[image_pressure][i], 36.0) << i;
                ASSERT_GE(b.state[plastic_strain][i], 0.0) << i;
                ++(over > -1e-3 * p ? on : within);
            }
            EXPECT_GT(on, 30);
            EXPECT_GT(within, 30);
        }
}

TEST(NorSand, WaitsAtTheLeastPressureWhenItIsPulledApart) {
    const Component c = Soil().component();
    Laboratory lab(c, isotropic(100e3));
    const double e = lab.state(void_ratio);
    for (int i = 0; i < 50; ++i)
        lab.strain_step({1e-3, 1e-3, 1e-3, 5e-4, 0.0, 0.0});
    EXPECT_NEAR(lab.p(), 100.0, 1e-9);
    EXPECT_LE(lab.q(), 2.0 * 100.0);
    EXPECT_NEAR(lab.state(void_ratio), (1.0 + e) * std::exp(0.15) - 1.0, 1e-12);
    lab.strain_step({-1e-3, -1e-3, -1e-3, 0.0, 0.0, 0.0});
    EXPECT_GT(lab.p(), 300.0); // takes load at once, softly
}

TEST(NorSand, AnswersZeroHugeAndAbsurdIncrements) {
    const Soil soil;
    const Component c = soil.component();
    const double nan = std::nan("");
    for (const double size : {0.0, 1e-300, 1e-15, 1e-9, 1e-3, 1e-2, 0.1, 1.0, 1e10, double(INFINITY), nan}) {
        Batch b(c, 1);
        b.set_stress_old(0, isotropic(100e3));
        ASSERT_EQ(b.start(), GAULT_OK);
        b.set_strain(0, {-size, 0.4 * size, 0.3 * size, 0.2 * size, 0.0, 0.1 * size});
        const gault_status status = b.update();
        if (!(size < INFINITY))
            EXPECT_EQ(status, GAULT_FAILED) << size;
        else if (size > 0.05) // more pieces than there may be
            EXPECT_EQ(status, GAULT_RETRY) << size;
        else
            EXPECT_EQ(status, GAULT_OK) << size;
        if (status != GAULT_OK) continue;
        EXPECT_TRUE(std::isfinite(deviator_size(b.stress_at(0)))) << size;
        if (size > 1e-9) continue;
        EXPECT_NEAR(mean_pressure(b.stress_at(0)), 100e3, 1.0);
        const double G = soil.G(100e3);
        EXPECT_NEAR(b.shear_modulus[0], G, 1e-4 * G);
        EXPECT_NEAR(b.modulus[0], G / soil.g() + 4.0 * G / 3.0, 1e-4 * G);
    }
}

TEST(NorSand, BoundsTheModulusOfItsElasticWaves) {
    Soil soil;
    soil.overconsolidation = 3.0;
    const Component c = soil.component();
    Batch b(c, 3);
    for (int64_t i = 0; i < 3; ++i)
        b.set_stress_old(i, isotropic(100e3));
    ASSERT_EQ(b.start(), GAULT_OK);
    for (int64_t i = 0; i < 3; ++i)
        b.set_strain(i, {-1e-5 + 1e-8 * static_cast<double>(i - 1), 0.0, 0.0, 0.0, 0.0, 0.0});
    ASSERT_EQ(b.update(), GAULT_OK);
    const double wave = (b.stress_at(2)[0] - b.stress_at(0)[0]) / 2e-8;
    EXPECT_LE(wave, b.modulus[1] * (1.0 + 1e-6)); // 1e-6: rounding of the difference
    EXPECT_GE(wave, b.modulus[1] * 0.99);
}

TEST(NorSand, ElasticPressureFollowsItsPowerLawInOneStep) {
    for (const double power : {0.0, 0.5, 1.0}) {
        Soil soil;
        soil.power = power;
        const Component c = soil.component();
        Laboratory lab(c, isotropic(400e3));
        lab.strain_step({2e-4, 2e-4, 2e-4, 0.0, 0.0, 0.0}); // unloads
        const double K = soil.G(400e3) / soil.g(), growth = -6e-4 * K / 400e3;
        const double ratio =
            power == 1.0 ? std::exp(growth) : std::pow(1.0 + (1.0 - power) * growth, 1.0 / (1.0 - power));
        EXPECT_NEAR(lab.p(), 400e3 * ratio, 1e-7);
    }
}

TEST(NorSand, LosesWithPressureWhatItsDensityDoesNotCarry) {
    for (const double cap : {0.0, 1.0}) {
        Soil soil;
        soil.psi = -0.05, soil.cap = cap;
        const Component c = soil.component();
        Laboratory lab(c, isotropic(1e6));
        const double image = lab.state(image_pressure);
        for (int i = 0; i < 50; ++i)
            lab.isotropic(-1e6 * std::pow(10.0, -(i + 1) / 50.0));
        const double psi = lab.state(state_parameter);
        if (cap == 0.0)
            EXPECT_EQ(lab.state(image_pressure), image);
        else
            EXPECT_LT(lab.state(image_pressure), 0.5 * image);
        double peak = 0.0;
        for (int i = 0; i < 60; ++i) {
            lab.triaxial_drained(-3e-4, -100e3);
            peak = std::max(peak, lab.q() / lab.p());
        }
        // D_min of the density, and a quarter more of p_i; unloaded from 1 MPa it would be some 3.7.
        const double limit =
            soil.M - (1.0 - soil.N) * soil.chi_i() * std::abs(psi) * -1.0 + soil.M * std::log(1.25);
        EXPECT_LT(peak, limit);
        EXPECT_GT(peak, soil.M);
    }
}

TEST(NorSand, KnowsNoDirection) { // components permuted: x to y to z to x
    const Component c = Soil().component(variants().back());
    Random random;
    Batch b(c, 200), turned(c, 200);
    fill_at_random(b, random, 1e-3);
    constexpr std::size_t to[] = {1, 2, 0, 4, 5, 3};
    for (int64_t i = 0; i < b.count(); ++i)
        for (std::size_t k = 0; k < 6; ++k) {
            turned.strain[to[k]][i] = b.strain[k][i] = 1e-4 * random.uniform(-1.0, 1.0);
            turned.stress_old[to[k]][i] = b.stress_old[k][i];
            if (k < 4) turned.state_old[k][i] = b.state_old[k][i];
        }
    ASSERT_EQ(b.update(), GAULT_OK);
    ASSERT_EQ(turned.update(), GAULT_OK);
    for (int64_t i = 0; i < b.count(); ++i)
        for (std::size_t k = 0; k < 6; ++k) // sums in another order, magnified by the edge of M(theta)
            EXPECT_NEAR(turned.stress[to[k]][i], b.stress[k][i], 1e-9 * mean_pressure(b.stress_at(i)));
}

TEST(NorSand, GivesTheSameBitsOnEveryProcessorAndInEveryBatch) {
    std::vector<Tensor> first;
    for (const std::string& variant : variants()) {
        const Component c = Soil().component(variant);
        Random random;
        Batch b(c, 501);
        fill_at_random(b, random, 1e-3);
        std::vector<Tensor> result;
        for (int64_t i = 0; i < b.count(); ++i)
            result.push_back(b.stress_at(i));
        if (first.empty()) first = result;
        EXPECT_EQ(result, first) << variant;

        Batch one(c, 1);
        for (std::size_t k = 0; k < 6; ++k)
            one.stress_old[k][0] = b.stress_old[k][7], one.strain[k][0] = b.strain[k][7];
        for (std::size_t k = 0; k < 4; ++k)
            one.state_old[k][0] = b.state_old[k][7];
        ASSERT_EQ(one.update(), GAULT_OK);
        ASSERT_EQ(b.update(), GAULT_OK);
        EXPECT_EQ(one.stress_at(0), b.stress_at(7));
    }
}

std::string refused(Settings settings, const std::map<std::string, double>& other) {
    for (const auto& [name, value] : other)
        settings[name] = value;
    try {
        const Component c("norsand", GAULT_MATERIAL, "norsand", settings);
    } catch (const Invalid& invalid) {
        return invalid.parameter;
    }
    return "";
}

TEST(NorSand, RefusesWhatMakesNoSense) {
    const Settings good = Soil().settings();
    EXPECT_EQ(refused(good, {}), "");
    EXPECT_EQ(refused(good, {{"void_ratio", 0.6}}), "state_parameter");
    Settings neither = good;
    neither.erase("state_parameter");
    EXPECT_EQ(refused(neither, {}), "void_ratio");
    EXPECT_EQ(refused(neither, {{"void_ratio", 0.6}}), "");
    EXPECT_EQ(refused(good, {{"critical_state_slope", 0.2}}), "dilatancy_coefficient");
    EXPECT_EQ(refused(good, {{"poisson_ratio", 0.45}}), "poisson_ratio");
}

TEST(NorSand, RefusesAnInitialStressThatItCannotCarry) {
    const Component c = Soil().component();
    const auto answer = [&](const Tensor& stress) {
        try {
            const Laboratory lab(c, stress);
        } catch (const std::runtime_error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(answer(isotropic(100e3)), "");
    EXPECT_EQ(answer({-100e3, -50e3, -50e3, 0.0, 0.0, 0.0}), "");
    EXPECT_NE(answer(isotropic(50.0)).find("100 Pa or more"), std::string::npos);
    EXPECT_NE(answer(isotropic(-10e3)).find("100 Pa or more"), std::string::npos);
    EXPECT_NE(answer({-100e3, -5e3, -5e3, 0.0, 0.0, 0.0}).find("beyond the strength"), std::string::npos);
}

TEST(NorSand, StartsFromVoidRatioOrStateParameterAlike) {
    const Soil soil;
    const double e = soil.gamma - soil.lambda * std::log(250.0) + soil.psi;
    Settings by_void_ratio = soil.settings();
    by_void_ratio.erase("state_parameter");
    by_void_ratio["void_ratio"] = e;
    const Component one = soil.component(), other("norsand", GAULT_MATERIAL, "norsand", by_void_ratio);
    const Tensor stress = {-350e3, -200e3, -200e3, 0.0, 0.0, 0.0};
    const Laboratory a(one, stress), b(other, stress);
    EXPECT_NEAR(a.state(void_ratio), e, 1e-15);
    EXPECT_NEAR(b.state(state_parameter), soil.psi, 1e-14);
    EXPECT_NEAR(a.state(image_pressure), b.state(image_pressure), 1e-8);
    EXPECT_NEAR(overstress(soil, stress, e, a.state(image_pressure)), 0.0,
                1e-3); // on the surface at R = 1, Pa
}

} // namespace
