#include "clay_test.hpp"

#include <limits>

namespace {
using namespace tresca_test;

// Rounding of stresses of 1e5 Pa is 1e-11 Pa a step; all closed forms of 100 steps hold to 1e-9 of the strength.
constexpr double rounding = 1e-9 * strength;

TEST(Tresca, ShearsPurelyUpToItsStrength) {
    const Component c = clay();
    Laboratory lab(c, diagonal(-100e3, -100e3, -100e3));
    for (int step = 1; step <= 100; ++step) {
        lab.strain_step({0.0, 0.0, 0.0, 2e-4, 0.0, 0.0});
        const double gamma = 4e-4 * step, tau = std::min(strength, shear * gamma);
        EXPECT_NEAR(lab.stress()[3], tau, rounding);
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(lab.stress()[i], -100e3, rounding);
        EXPECT_NEAR(lab.state(0), gamma - tau / shear, 1e-12);
    }
    EXPECT_GT(lab.state(0), 0.02);
}

TEST(Tresca, FailsAtTwiceItsStrengthInTriaxialCompressionAndExtension) {
    const Component c = clay();
    for (const double sign : {-1.0, 1.0}) { // of the axial strain, tension positive
        Laboratory undrained(c, diagonal(-150e3, -100e3, -100e3));
        Laboratory drained(c, diagonal(-100e3, -100e3, -100e3));
        double axial = 0.0;
        for (int step = 0; step < 100; ++step) {
            undrained.triaxial_undrained(sign * 5e-4);
            drained.triaxial_drained(sign * 5e-4, -100e3);
            axial += sign * 5e-4;
        }
        EXPECT_NEAR(undrained.stress()[0] - undrained.stress()[1], sign * 2.0 * strength, rounding);
        EXPECT_NEAR(undrained.p(), 350e3 / 3.0, rounding); // no volume by flow, and none is imposed
        // The laboratory finds the lateral strains to 1e-10 of the stress.
        EXPECT_NEAR(drained.stress()[0], -100e3 + sign * 2.0 * strength, 1e-8 * strength);
        // All volume is elastic, and plastic work s : dep is s_u times the state: 2 s_u |plastic axial strain|.
        EXPECT_NEAR(drained.volumetric_strain(), sign * 2.0 * strength / (3.0 * lame + 2.0 * shear), 1e-12);
        EXPECT_NEAR(drained.state(0), 2.0 * (std::abs(axial) - 2.0 * strength / young_modulus), 1e-12);
    }
}

// The intermediate stress stays elastic: it changes with nu times the sum of the two others, which flow does not.
TEST(Tresca, FailsAtTwiceItsStrengthInPlaneStrain) {
    const Component c = clay();
    Laboratory lab(c, diagonal(-100e3, -100e3, -100e3));
    for (int step = 0; step < 100; ++step)
        lab.step({{{Control::strain, -5e-4},
                   {Control::strain, 0.0},
                   {Control::stress, -100e3},
                   {Control::strain, 0.0},
                   {Control::strain, 0.0},
                   {Control::strain, 0.0}}});
    EXPECT_NEAR(lab.stress()[0], -100e3 - 2.0 * strength, 1e-8 * strength);
    EXPECT_NEAR(lab.stress()[1], -100e3 - poisson_ratio * 2.0 * strength, 1e-8 * strength);
}

// Koiter: of the six faces s_i - s_j = 2 s_u one or two are active, with multipliers that are not negative, and all
// six hold. Tried one by one, in long double; what fits is the only solution, because the soil is convex.
std::array<double, 3> by_koiter(const std::array<double, 3>& trial) {
    using Real = long double;
    using Vector = std::array<Real, 3>;
    const auto dot = [](const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    std::vector<Vector> faces;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            if (i != j) {
                faces.push_back({});
                faces.back()[i] = 1.0L, faces.back()[j] = -1.0L;
            }
    const Vector t{trial[0], trial[1], trial[2]};
    const Real tolerance = 1e-12L * strength;
    const auto holds = [&](const Vector& s) {
        for (const Vector& n : faces)
            if (dot(n, s) > 2.0L * strength + tolerance) return false;
        return true;
    };
    const auto less = [](Vector s, Real a, const Vector& n) {
        for (std::size_t i = 0; i < 3; ++i)
            s[i] -= a * n[i];
        return s;
    };
    const auto in_double = [](const Vector& s) {
        return std::array<double, 3>{double(s[0]), double(s[1]), double(s[2])};
    };
    if (holds(t)) return trial;
    for (const Vector& n : faces) {
        const Real a = (dot(n, t) - 2.0L * strength) / 2.0L;
        if (a >= 0.0L && holds(less(t, a, n))) return in_double(less(t, a, n));
    }
    for (const Vector& n : faces)
        for (const Vector& m : faces) {
            const Real nm = dot(n, m), determinant = 4.0L - nm * nm;
            if (determinant == 0.0L) continue;
            const Real f = dot(n, t) - 2.0L * strength, g = dot(m, t) - 2.0L * strength;
            const Real a = (2.0L * f - nm * g) / determinant, b = (2.0L * g - nm * f) / determinant;
            if (a < 0.0L || b < 0.0L || !holds(less(less(t, a, n), b, m))) continue;
            return in_double(less(less(t, a, n), b, m));
        }
    throw std::runtime_error("no active faces fit");
}

TEST(Tresca, ReturnsToTheFaceOrEdgeThatKoitersConditionsSelect) {
    const Component c = clay();
    Batch b(c, 4000);
    Random random;
    std::vector<std::array<double, 3>> trials;
    std::vector<Matrix> axes;
    for (int64_t i = 0; i < b.count(); ++i) {
        const double most = strength * std::pow(10.0, random.uniform(-0.5, 1.5));
        std::array<double, 3> t;
        for (double& x : t)
            x = most * random.uniform(-1.0, 1.0);
        std::sort(t.begin(), t.end(), std::greater<>());
        trials.push_back(t);
        axes.push_back(random.rotation());
        b.set_strain(i, elastic_strain(turned(diagonal(t[0], t[1], t[2]), axes.back())));
    }
    ASSERT_EQ(b.update(), GAULT_OK);
    std::map<std::string, int> seen;
    for (int64_t i = 0; i < b.count(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        const auto s = by_koiter(trials[k]);
        const Tensor expected = turned(diagonal(s[0], s[1], s[2]), axes[k]);
        // Rounding of the trial stress and of its decomposition: some 1e-15 of it.
        EXPECT_LT(size(minus(b.stress_at(i), expected)), 1e-13 * 32.0 * strength) << i;
        ++seen[region(b.stress_at(i))];
    }
    for (const char* name : {"inside", "face", "edge s1 = s2", "edge s2 = s3"})
        EXPECT_GT(seen[name], 200) << name;
}

// Plastic work is s_u times the growth of the state, on faces and on edges: the strain of the step less the elastic
// strain of the change of stress is what has flowed.
TEST(Tresca, DissipatesItsStrengthTimesItsPlasticShearStrain) {
    const Component c = clay();
    Batch b(c, 4000);
    fill_at_random(b);
    ASSERT_EQ(b.update(), GAULT_OK);
    int flowing = 0;
    for (int64_t i = 0; i < b.count(); ++i) {
        const Tensor plastic = minus(strain_of(b, i), elastic_strain(minus(b.stress_at(i), old_of(b, i))));
        EXPECT_GE(b.state[0][i], 0.0);
        // Strains are rounded to 1e-17, and elastic ones to 1e-16 * 1e6 Pa / 1e7 Pa; times the stress.
        EXPECT_NEAR(product(b.stress_at(i), plastic), strength * b.state[0][i], 1e-15 * size(b.stress_at(i)));
        EXPECT_NEAR(plastic[0] + plastic[1] + plastic[2], 0.0, 1e-15);
        flowing += b.state[0][i] > 0.0;
    }
    EXPECT_GT(flowing, 1000);
}

TEST(Tresca, NeverLeavesItsHexagon) {
    for (const double nu : {0.3, 0.4999}) {
        const Component c = clay("", nu);
        Batch b(c, 3000);
        fill_at_random(b);
        Random random;
        std::map<std::string, int> seen;
        for (int step = 0; step < 20; ++step) {
            ASSERT_EQ(b.update(), GAULT_OK);
            for (int64_t i = 0; i < b.count(); ++i) {
                ASSERT_LE(excess(b.stress_at(i)), 1e-13 * (strength + size(b.stress_at(i)))) << i;
                ASSERT_GE(b.state[0][i], b.state_old[0][i]);
                ++seen[region(b.stress_at(i))];
            }
            b.advance();
            for (int64_t i = 0; i < b.count(); ++i)
                b.set_strain(i, random.tensor(std::pow(10.0, random.uniform(-9.0, -2.0))));
        }
        for (const char* name : {"inside", "face", "edge s1 = s2", "edge s2 = s3"})
            EXPECT_GT(seen[name], 20) << name;
    }
}

// In the plane the soil is a circle of radius s_u: from an angle to a constant rate of strain, tan(angle / 2) falls as
// exp(-2G strain / s_u) (Krieg and Krieg 1977). Each step is implicit, so the error falls with the step.
TEST(Tresca, ConvergesWithTheStepWhereAxesTurn) {
    const Component c = clay();
    const double strain = 0.5 * strength / shear, first_angle = 0.5 * M_PI;
    const double angle =
        2.0 * std::atan(std::tan(0.5 * first_angle) * std::exp(-2.0 * shear * strain / strength));
    std::vector<double> errors;
    for (const int steps : {20, 40, 80, 160}) {
        Laboratory lab(c, {strength * std::cos(first_angle), -strength * std::cos(first_angle), 0.0,
                           strength * std::sin(first_angle), 0.0, 0.0});
        for (int step = 0; step < steps; ++step)
            lab.strain_step({strain / steps, -strain / steps, 0.0, 0.0, 0.0, 0.0});
        errors.push_back(std::hypot(lab.stress()[0] - strength * std::cos(angle),
                                    lab.stress()[3] - strength * std::sin(angle)));
    }
    for (std::size_t i = 1; i < errors.size(); ++i) {
        const double order = std::log2(errors[i - 1] / errors[i]);
        std::printf("error %.3e of s_u, order %.3f\n", errors[i] / strength, order);
        EXPECT_GT(order, 0.9);
        EXPECT_LT(order, 1.1);
    }
    EXPECT_LT(errors.back(), 0.01 * strength);
}

// Turned points take the way of six components, unturned ones (every third) that of the plane.
TEST(Tresca, DoesNotKnowDirections) {
    const Component c = clay();
    Batch b(c, 3000), other(c, 3000);
    fill_at_random(b);
    Random random;
    std::vector<Matrix> axes;
    for (int64_t i = 0; i < b.count(); ++i) {
        axes.push_back(random.rotation());
        other.set_strain(i, turned(strain_of(b, i), axes.back()));
        other.set_stress_old(i, turned(old_of(b, i), axes.back()));
    }
    ASSERT_EQ(b.update(), GAULT_OK);
    ASSERT_EQ(other.update(), GAULT_OK);
    for (int64_t i = 0; i < b.count(); ++i) {
        const Tensor expected = turned(b.stress_at(i), axes[static_cast<std::size_t>(i)]);
        EXPECT_LT(size(minus(other.stress_at(i), expected)), 1e-14 * 32.0 * strength) << i;
        EXPECT_NEAR(other.state[0][i], b.state[0][i], 1e-14);
    }
}

TEST(Tresca, GivesTheSameBitsOnEveryProcessorAndInEveryOrder) {
    std::vector<Tensor> first;
    std::vector<double> first_tangent;
    for (const std::string& variant : variants()) {
        const Component c = clay(variant);
        Batch b(c, 1001, true), reversed(c, 1001, true);
        fill_at_random(b);
        for (int64_t i = 0; i < b.count(); ++i) {
            reversed.set_strain(b.count() - 1 - i, strain_of(b, i));
            reversed.set_stress_old(b.count() - 1 - i, old_of(b, i));
        }
        ASSERT_EQ(b.update(), GAULT_OK);
        ASSERT_EQ(reversed.update(), GAULT_OK);
        std::vector<Tensor> result;
        std::vector<double> tangent;
        for (int64_t i = 0; i < b.count(); ++i) {
            result.push_back(b.stress_at(i));
            EXPECT_EQ(reversed.stress_at(b.count() - 1 - i), result.back());
            EXPECT_EQ(reversed.state[0][b.count() - 1 - i], b.state[0][i]);
            for (std::size_t e = 0; e < 36; ++e)
                tangent.push_back(b.tangent[e][i]);
        }
        if (first.empty()) first = result, first_tangent = tangent;
        EXPECT_EQ(result, first) << variant;
        EXPECT_EQ(tangent, first_tangent) << variant;
    }
}

TEST(Tresca, RefusesAnInitialStressBeyondItsStrength) {
    const Component c = clay();
    EXPECT_NO_THROW(Laboratory(c, diagonal(-200e3, -150e3, -100e3))); // on the surface
    EXPECT_NO_THROW(Laboratory(c, {-1e6, -1e6, -1e6, 0.0, strength, 0.0}));
    EXPECT_THROW(Laboratory(c, diagonal(-200.001e3, -150e3, -100e3)), std::runtime_error);
    try {
        Laboratory(c, {0.0, 0.0, 0.0, 0.0, 0.0, 1.001 * strength});
        FAIL();
    } catch (const std::runtime_error& e) {
        EXPECT_NE(std::string(e.what()).find("undrained strength"), std::string::npos);
    }
}

TEST(Tresca, KeepsItsStressWithoutStrain) {
    const Component c = clay();
    Batch b(c, 1000);
    fill_at_random(b);
    for (int64_t i = 0; i < b.count(); ++i)
        b.set_strain(i, {});
    ASSERT_EQ(b.update(), GAULT_OK);
    for (int64_t i = 0; i < b.count(); ++i) {
        // Within the surface to the bit; on it rounding may return it anew.
        EXPECT_LE(size(minus(b.stress_at(i), old_of(b, i))), 1e-15 * size(old_of(b, i)));
        EXPECT_LE(b.state[0][i], 1e-15);
        EXPECT_DOUBLE_EQ(b.modulus[i], lame + 2.0 * shear);
        EXPECT_DOUBLE_EQ(b.shear_modulus[i], shear);
    }
}

// Up to 1e100, whose square is a number, the result is one; beyond it the update returns at all.
TEST(Tresca, SurvivesSenselessIncrements) {
    const Component c = clay();
    for (const double e : {1e-300, 1.0, 1e100})
        for (const Tensor& strain : {Tensor{e, -e, 0.0, e, 0.0, 0.0}, Tensor{e, 0.0, -e, 0.0, -e, e}}) {
            Batch b(c, 1, true);
            b.set_strain(0, strain);
            ASSERT_EQ(b.update(), GAULT_OK);
            for (int i = 0; i < 6; ++i)
                EXPECT_TRUE(std::isfinite(b.stress_at(0)[i])) << e;
            EXPECT_LE(excess(b.stress_at(0)), 1e-13 * (strength + young_modulus * e)) << e;
            for (std::size_t i = 0; i < 36; ++i)
                EXPECT_TRUE(std::isfinite(b.tangent[i][0])) << e;
        }
    for (const double e : {1e300, HUGE_VAL, std::numeric_limits<double>::quiet_NaN()}) {
        Batch b(c, 8, true);
        b.set_strain(0, {e, -e, 0.0, e, e, e});
        EXPECT_EQ(b.update(), GAULT_OK);
        EXPECT_EQ(b.stress_at(1), Tensor{}) << "a neighbour's";
    }
}

} // namespace
