#include "clay_test.hpp"

#include <Eigen/Eigenvalues>

#include <functional>

namespace {
using namespace modified_cam_clay_test;

// Increments of up to 1e-8 .. 3e-2, isotropic ones and ones without volume among them.
void fill_at_random(Batch& b) {
    Random random;
    for (int64_t i = 0; i < b.count(); ++i) {
        random.state(b, i);
        Tensor strain = random.tensor(random.magnitude(-8.0, -1.5));
        if (i % 5 == 1) strain = deviator(strain);
        if (i % 5 == 2) strain = {strain[0], strain[0], strain[0], 0.0, 0.0, 0.0};
        b.set_strain(i, strain);
    }
}

std::string message(const std::function<void()>& action) {
    try {
        action();
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

TEST(ModifiedCamClay, NeverLeavesItsEllipse) {
    for (const Settings& s : {settings(), rigid_settings()}) {
        const Component c = clay(s);
        Batch b(c, 60000);
        fill_at_random(b);
        ASSERT_EQ(b.update(), GAULT_OK);
        int elastic = 0, wet = 0, dry = 0;
        for (int64_t i = 0; i < b.count(); ++i) {
            const Tensor stress = b.stress_at(i);
            const double size = b.state[preconsolidation][i];
            ASSERT_LE(yield(stress, size), 1e-12) << i; // of rounding
            ASSERT_GE(mean_pressure(stress), 10.0 * (1.0 - 1e-12));
            ASSERT_GE(size, 20.0);
            ASSERT_GE(b.state[specific_volume][i], 1.0);
            ASSERT_GE(b.state[plastic_strain][i], 0.0);
            const double growth = size / b.state_old[preconsolidation][i];
            ++(growth == 1.0 ? elastic : growth > 1.0 ? wet : dry);
        }
        for (int met : {elastic, wet, dry})
            EXPECT_GT(met, 5000);
    }
}

TEST(ModifiedCamClay, GivesTheSameBitsOnEveryProcessor) {
    std::vector<double> first;
    for (const std::string& variant : variants()) {
        const Component c = clay(settings(), variant);
        Batch b(c, 2001, true);
        fill_at_random(b);
        ASSERT_EQ(b.update(), GAULT_OK);
        std::vector<double> result;
        for (const Columns* columns : {&b.stress, &b.state, &b.tangent})
            for (const Column& column : *columns)
                result.insert(result.end(), column.data(), column.data() + b.count());
        if (first.empty()) first = result;
        EXPECT_EQ(result, first) << variant;
    }
}

// Rotated by a quarter about z, and xx yy zz permuted: the components move, and rounding is all that may differ.
TEST(ModifiedCamClay, HasNoDirectionOfItsOwn) {
    const Component c = clay(settings());
    Batch b(c, 4000), turned(c, 4000);
    fill_at_random(b);
    const auto turn = [](const Tensor& t) { return Tensor{t[1], t[2], t[0], t[4], t[5], t[3]}; };
    for (int64_t i = 0; i < b.count(); ++i) {
        Tensor strain, stress;
        for (std::size_t k = 0; k < 6; ++k)
            strain[k] = b.strain[k][i], stress[k] = b.stress_old[k][i];
        turned.set_strain(i, turn(strain));
        turned.set_stress_old(i, turn(stress));
        for (std::size_t k = 0; k < 3; ++k)
            turned.state_old[k][i] = b.state_old[k][i];
    }
    ASSERT_EQ(b.update(), GAULT_OK);
    ASSERT_EQ(turned.update(), GAULT_OK);
    for (int64_t i = 0; i < b.count(); ++i)
        for (std::size_t k = 0; k < 6; ++k)
            EXPECT_NEAR(turned.stress_at(i)[k], turn(b.stress_at(i))[k], 1e-9 * b.state[preconsolidation][i]);
}

// Ten per cent of elastic unloading is ln p' of -5 and more; the clay then waits at 10 Pa, and takes load again.
TEST(ModifiedCamClay, KeepsTheLeastPressureWhenItIsPulledApart) {
    const Component c = clay(settings(4.0));
    Laboratory lab(c, isotropic(p0));
    for (int i = 0; i < 100; ++i)
        lab.strain_step({2e-3, 2e-3, 2e-3, 0.0, 0.0, 0.0});
    EXPECT_NEAR(lab.p(), 10.0, 1e-9);
    for (int i = 0; i < 100; ++i)
        lab.strain_step({1e-2, -5e-3, -5e-3, 1e-2, 0.0, 0.0});
    EXPECT_LE(yield(lab.stress(), lab.state(preconsolidation)), 1e-12);
    for (int i = 0; i < 100; ++i)
        lab.strain_step({-2e-3, -2e-3, -2e-3, 0.0, 0.0, 0.0});
    EXPECT_GT(lab.p(), 1e4);
}

TEST(ModifiedCamClay, AnswersAbsurdIncrementsAtOnce) {
    const Component c = clay(settings());
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 infinite = std::numeric_limits<double>::infinity();
    for (const double e : {1.0, 1e10, 1e300, -1.0, -1e300, infinite, -infinite}) {
        Batch b(c, 1);
        b.set_stress_old(0, isotropic(p0));
        b.set_strain(0, {e, 0.5 * e, 0.0, e, 0.0, 0.0});
        EXPECT_EQ(b.update(), GAULT_RETRY) << e;
        EXPECT_EQ(b.suggested(), 0.25);
    }
    Batch b(c, 1);
    b.set_stress_old(0, isotropic(p0));
    b.set_strain(0, {0.0, 0.0, 0.0, nan, 0.0, 0.0});
    EXPECT_EQ(b.update(), GAULT_FAILED);
    for (const double e : {0.0, 1e-300, -1e-18, 0.29}) {
        b.set_strain(0, {0.0, 0.0, 0.0, e, 0.0, 0.0});
        EXPECT_EQ(b.update(), GAULT_OK) << e;
        EXPECT_TRUE(std::isfinite(b.stress_at(0)[3]));
    }
}

// Steps of up to 20 % are taken whole, and none is asked to be divided: the one equation always has a root.
TEST(ModifiedCamClay, ReturnsFromFarAway) {
    for (const Settings& s : {settings(), rigid_settings()}) {
        const Component c = clay(s);
        Random random;
        Batch b(c, 20000);
        for (int64_t i = 0; i < b.count(); ++i) {
            random.state(b, i);
            b.set_strain(i, deviator(random.tensor(0.2)));
        }
        ASSERT_EQ(b.update(), GAULT_OK);
        int plastic = 0;
        for (int64_t i = 0; i < b.count(); ++i) {
            EXPECT_LE(yield(b.stress_at(i), b.state[preconsolidation][i]), 1e-12) << i;
            plastic += b.state[plastic_strain][i] > 0.0;
        }
        EXPECT_GT(plastic, 15000);
    }
}

TEST(ModifiedCamClay, EndsWhereNoVoidsAreLeft) {
    Settings s = settings();
    s.erase("critical_state_volume");
    s["initial_void_ratio"] = 0.1;
    const Component c = clay(s);
    Laboratory lab(c, isotropic(p0));
    EXPECT_EQ(lab.state(specific_volume), 1.1);
    const std::string text = message([&] {
        for (int i = 0; i < 200; ++i)
            lab.oedometer(-1e-3);
    });
    EXPECT_NE(text.find("no voids"), std::string::npos) << text;
    EXPECT_NEAR(lab.state(specific_volume), 1.0, 2e-3);
}

TEST(ModifiedCamClay, SetsTheEllipseFromTheInitialStress) {
    const Tensor at_rest{-100e3, -60e3, -60e3, 0.0, 0.0, 0.0};
    const double p = mean_pressure(at_rest), q = 40e3, through = p + q * q / (M * M * p);
    const Component c = clay(settings(2.0));
    const Laboratory lab(c, at_rest);
    EXPECT_NEAR(lab.state(preconsolidation), 2.0 * through, 1e-6);
    EXPECT_NEAR(lab.state(specific_volume),
                Gamma - lambda * std::log(through / 1e3) + kappa * std::log(through / p), 1e-12);

    Settings s = settings();
    s.erase("overconsolidation_ratio");
    s["preconsolidation_pressure"] = 150e3;
    const Component d = clay(s);
    EXPECT_EQ(Laboratory(d, at_rest).state(preconsolidation), 150e3);
    const std::string outside = message([&] { Laboratory(d, isotropic(151e3)); });
    EXPECT_NE(outside.find("outside of the yield surface"), std::string::npos) << outside;
}

TEST(ModifiedCamClay, RefusesAnInitialStressWithoutPressureAndASoilWithoutVoids) {
    const Component c = clay(settings());
    for (const double pressure : {0.0, -5e3, 9.9}) {
        const std::string text = message([&] { Laboratory(c, isotropic(pressure)); });
        EXPECT_NE(text.find("compression of 10 Pa or more"), std::string::npos) << text;
    }
    const std::string text = message([&] { Laboratory(c, isotropic(1e9)); });
    EXPECT_NE(text.find("without voids"), std::string::npos) << text;
}

TEST(ModifiedCamClay, WantsExactlyOneOfEveryPair) {
    const std::pair<const char*, double> pairs[][2] = {
        {{"poisson_ratio", nu}, {"shear_modulus", G}},
        {{"critical_state_volume", Gamma}, {"initial_void_ratio", 1.0}},
        {{"overconsolidation_ratio", 1.0}, {"preconsolidation_pressure", 200e3}}};
    for (const auto& pair : pairs) {
        Settings none = settings(), both = settings();
        for (const auto& [name, value] : pair)
            none.erase(name), both[name] = value;
        EXPECT_NE(message([&] { clay(none); }).find("not none"), std::string::npos) << pair[0].first;
        EXPECT_NE(message([&] { clay(both); }).find("not both"), std::string::npos) << pair[0].first;
    }
}

// The limit of README.md: u^2 (1 - c) - b u + c touches 0 between 0 and 1.
TEST(ModifiedCamClay, RefusesWhatSoftensFasterThanItUnloads) {
    Settings s = settings();
    s["swelling_index"] = 0.5 * lambda;
    EXPECT_THROW(clay(s), Invalid);
    const auto with_ratio = [](double ratio) {
        Settings given = settings();
        given["poisson_ratio"] = ratio;
        return clay(given);
    };
    const auto least = [](double ratio) {
        const double b = kappa / (lambda - kappa), c = 4.5 * (1.0 - 2.0 * ratio) / (1.0 + ratio) / (M * M);
        double smallest = 1.0;
        for (double u = 0.0; u <= 1.0; u += 1e-4)
            smallest = std::min(smallest, (1.0 - c) * u * u - b * u + c);
        return smallest;
    };
    EXPECT_GT(least(0.496), 0.0);
    with_ratio(0.496);
    EXPECT_LT(least(0.4965), 0.0);
    EXPECT_THROW(with_ratio(0.4965), Invalid);
}

// Central differences of 1e-7 err by rounding, 1e-16 p'_c / 1e-7, and by curvature, 1e-14 of that of ln p', which
// changes by v / kappa = 100 a unit of strain: both far below 1e-6 of K. Points within reach of a border (yield,
// least pressure) are passed over: there the one-sided differences do not agree.
void compare_with_differences(const Settings& settings, double largest, bool near_the_floor) {
    constexpr double h = 1e-7;
    const Component c = clay(settings);
    Random random;
    int elastic = 0, wet = 0, dry = 0, least = 0, passed_over = 0;
    for (int n = 0; n < 1500; ++n) {
        Batch b(c, 13, true);
        random.state(b, 0);
        Tensor strain = random.tensor(random.magnitude(-6.0, largest)), stress;
        if (near_the_floor)
            for (std::size_t i = 0; i < 3; ++i)
                strain[i] += 0.1;
        if (n % 10 == 1) strain = {-0.01, -0.01, -0.01, 0.0, 0.0, 0.0};
        for (std::size_t i = 0; i < 6; ++i)
            stress[i] = b.stress_old[i][0];
        if (n % 10 == 1) stress = isotropic(0.99 * b.state_old[preconsolidation][0]);
        for (int64_t i = 0; i < 13; ++i) {
            b.set_stress_old(i, stress);
            b.set_strain(i, strain);
            for (Column& s : b.state_old)
                s[i] = s[0];
            if (i > 0) b.strain[static_cast<std::size_t>(i - 1) / 2][i] += i % 2 ? h : -h;
        }
        ASSERT_EQ(b.update(), GAULT_OK) << b.error.text;
        const double stiffness = b.modulus[0];
        double most = 0.0, curved = 0.0;
        for (std::size_t row = 0; row < 6; ++row)
            for (std::size_t column = 0; column < 6; ++column) {
                const Column& s = b.stress[row];
                const auto k = static_cast<int64_t>(2 * column);
                const double difference = (s[k + 1] - s[k + 2]) / (2.0 * h);
                curved = std::max(curved, std::abs(s[k + 1] - 2.0 * s[0] + s[k + 2]) / h);
                most = std::max(most, std::abs(b.tangent[6 * row + column][0] - difference));
            }
        if (curved > 1e-3 * stiffness) {
            ++passed_over;
            continue;
        }
        ASSERT_LE(most, 1e-6 * stiffness) << n;
        const double growth = b.state[preconsolidation][0] / b.state_old[preconsolidation][0];
        ++(growth == 1.0 ? elastic : growth > 1.0 ? wet : dry);
        least += mean_pressure(b.stress_at(0)) < 10.0 * (1.0 + 1e-12);
    }
    EXPECT_LT(passed_over, 75);
    EXPECT_GT(near_the_floor ? least : elastic, 100);
    EXPECT_GT(near_the_floor ? least : wet, 100);
    EXPECT_GT(dry, 100);
}

TEST(ModifiedCamClay, HasTheTangentOfItsUpdate) {
    compare_with_differences(settings(), -2.0, false);
    compare_with_differences(rigid_settings(), -2.0, false);
    compare_with_differences(settings(), -2.0, true);
}

// The square of the fastest wave's speed times the density: n C n, in random directions.
TEST(ModifiedCamClay, BoundsTheModulusOfEveryWave) {
    for (const Settings& s : {settings(), rigid_settings()}) {
        const Component c = clay(s);
        Batch b(c, 8000, true);
        Random random;
        fill_at_random(b);
        ASSERT_EQ(b.update(), GAULT_OK);
        constexpr int index[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
        for (int64_t i = 0; i < b.count(); ++i) {
            Eigen::Vector3d n(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
            n.normalize();
            Eigen::Matrix3d acoustic = Eigen::Matrix3d::Zero();
            for (int j = 0; j < 3; ++j)
                for (int k = 0; k < 3; ++k)
                    for (int l = 0; l < 3; ++l)
                        for (int m = 0; m < 3; ++m) { // column xy is the change for xy and yx together
                            const auto entry = static_cast<std::size_t>(6 * index[j][k] + index[l][m]);
                            acoustic(j, l) += n(k) * b.tangent[entry][i] * (l == m ? 1.0 : 0.5) * n(m);
                        }
            ASSERT_LE(acoustic.eigenvalues().real().maxCoeff(), b.modulus[i] * (1.0 + 1e-9)) << i;
            ASSERT_GT(b.shear_modulus[i], 0.0);
        }
    }
}

} // namespace
