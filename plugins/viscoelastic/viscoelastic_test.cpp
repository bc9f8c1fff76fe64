#include "plugin_fixture.hpp"

#include <gtest/gtest.h>

#include <cfloat>
#include <random>

namespace {
using namespace plugin_test;

constexpr double epsilon = DBL_EPSILON;

struct Burgers { // viscosity 0: no flow; delayed_modulus 0: no Kelvin element
    double young_modulus = 25e9, poisson_ratio = 0.25, viscosity = 1e17;
    double delayed_modulus = 0.0, delayed_viscosity = 0.0;

    double shear() const { return young_modulus / (2.0 * (1.0 + poisson_ratio)); }
    double bulk() const { return young_modulus / (3.0 * (1.0 - 2.0 * poisson_ratio)); }
    double relaxation_time() const { return viscosity / shear(); }
    double retardation_time() const { return delayed_viscosity / delayed_modulus; }

    Component soil(const std::string& variant = "") const {
        Settings settings{{"young_modulus", young_modulus}, {"poisson_ratio", poisson_ratio}};
        if (viscosity > 0.0) settings["viscosity"] = viscosity;
        if (delayed_modulus > 0.0) settings["delayed_shear_modulus"] = delayed_modulus;
        if (delayed_viscosity > 0.0) settings["delayed_viscosity"] = delayed_viscosity;
        return {"viscoelastic", GAULT_MATERIAL, "viscoelastic", settings, variant};
    }

    // Shear strain gamma for a unit of stress since t = 0.
    long double creep(long double t) const {
        return 1.0L / shear() + t / viscosity -
               std::expm1(-t * delayed_modulus / delayed_viscosity) / delayed_modulus;
    }
    // Stress for a unit of gamma since t = 0, and its integral: Findley, Lai and Onaran (1976), chapter 5.
    long double relaxation(long double t) const {
        return weigh([t](long double r) { return std::exp(-r * t); });
    }
    long double relaxation_integral(long double t) const {
        return weigh([t](long double r) { return -std::expm1(-r * t) / r; });
    }

  private:
    template <class F>
    long double weigh(F f) const {
        const long double p1 = viscosity / (long double)shear() + viscosity / (long double)delayed_modulus +
                               delayed_viscosity / (long double)delayed_modulus;
        const long double p2 = (long double)viscosity * delayed_viscosity / shear() / delayed_modulus;
        const long double q1 = viscosity, q2 = q1 * delayed_viscosity / delayed_modulus;
        const long double a = std::sqrt(p1 * p1 - 4.0L * p2), fast = (p1 + a) / (2.0L * p2),
                          slow = 1.0L / (p2 * fast);
        return ((q1 - q2 * slow) * f(slow) - (q1 - q2 * fast) * f(fast)) / a;
    }
};

const Burgers maxwell{};
const Burgers salt{25e9, 0.25, 1e17, 5e9, 2e15};
const Burgers kelvin{25e9, 0.25, 0.0, 5e9, 2e15}; // a solid
// Kelvin elements far faster and far slower than the flow, far softer and far stiffer than the rest, and one
// whose times are equal while it hardly matters.
const Burgers many[] = {salt,
                        {25e9, 0.25, 1e17, 5e9, 2e9},
                        {25e9, 0.25, 1e17, 5e9, 2e23},
                        {25e9, 0.25, 1e17, 5e4, 2e12},
                        {25e9, 0.25, 1e17, 5e14, 2e20},
                        {25e9, 0.25, 1e17, 1e18, 1e25}};

void advance(Batch& b, double dt, const Tensor& strain) {
    b.set_dt(dt);
    b.set_strain(0, strain);
    ASSERT_EQ(b.update(), GAULT_OK);
    b.advance();
}
Tensor shearing(double xy) {
    return {0.0, 0.0, 0.0, xy, 0.0, 0.0};
}
double stress_xy(const Batch& b) {
    return b.stress_old[3][0];
}
Tensor times(double factor, Tensor t) {
    for (double& c : t)
        c *= factor;
    return t;
}
Tensor deviator(Tensor t) {
    const double mean = (t[0] + t[1] + t[2]) / 3.0;
    for (int i = 0; i < 3; ++i)
        t[i] -= mean;
    return t;
}

struct Random {
    std::mt19937_64 engine{11};
    double uniform() { return std::uniform_real_distribution<double>(-1.0, 1.0)(engine); }
    Tensor tensor(double size) {
        Tensor t;
        for (double& c : t)
            c = size * uniform();
        return t;
    }
};

// A few roundings of each of the six coefficients and of the sum; the rates are those of parameters that are
// off by an ulp, which exp(-x) magnifies x times.
double rounding(double relaxation_times) {
    return 32.0 * epsilon * (1.0 + relaxation_times);
}

TEST(Viscoelastic, RelaxesAsTheClosedFormInOneStepOfAnyLength) {
    for (const Burgers& m : many)
        for (const double x : {0.0, 1e-12, 1e-6, 1e-3, 0.1, 1.0, 7.0, 30.0}) {
            const Component c = m.soil();
            Batch b(c, 1);
            const double gamma = 1e-4, time = x * m.relaxation_time();
            advance(b, 0.0, shearing(0.5 * gamma));
            EXPECT_DOUBLE_EQ(stress_xy(b), m.shear() * gamma);
            advance(b, time, {});
            const double left = static_cast<double>(m.relaxation(time));
            EXPECT_NEAR(stress_xy(b) / gamma, left, rounding(x) * left) << x;
        }
}

// A steady strain rate, from rest: s = gamma' times the integral of G(t).
TEST(Viscoelastic, AnswersASteadyRateInOneStepOfAnyLength) {
    for (const Burgers& m : many)
        for (const double x : {1e-12, 1e-9, 1e-6, 1e-3, 0.1, 1.0, 10.0, 1e3, 1e6}) {
            const Component c = m.soil();
            Batch b(c, 1);
            const double time = x * m.relaxation_time(), gamma = 1e-4;
            advance(b, time, shearing(0.5 * gamma));
            const double expected = static_cast<double>(m.relaxation_integral(time)) * gamma / time;
            EXPECT_NEAR(stress_xy(b), expected, 32.0 * epsilon * expected) << x;
        }
}

TEST(Viscoelastic, WithoutAKelvinElementItIsMaxwells) {
    const Component c = maxwell.soil();
    for (const double x : {1e-12, 1e-6, 1e-3, 1.0, 20.0, 1e6}) {
        Batch b(c, 1);
        const double gamma = 1e-4, time = x * maxwell.relaxation_time();
        advance(b, time, shearing(0.5 * gamma));
        const double expected = -std::expm1(-x) / x * maxwell.shear() * gamma;
        EXPECT_NEAR(stress_xy(b), expected, 8.0 * epsilon * expected);
        EXPECT_EQ(b.state_old[3][0], 0.0);
        advance(b, time, {});
        EXPECT_NEAR(stress_xy(b), std::exp(-x) * expected, rounding(x) * std::exp(-x) * expected);
    }
}

// A Maxwell soil under a constant stress strains at a constant rate, which steps of any length follow.
TEST(Viscoelastic, FlowsSteadilyUnderAConstantStress) {
    const Component c = maxwell.soil();
    Batch b(c, 1);
    const double stress = 1e6;
    advance(b, 0.0, shearing(0.5 * stress / maxwell.shear()));
    for (const double x : {1e-9, 1e-3, 1.0, 50.0, 1e6}) {
        advance(b, x * maxwell.relaxation_time(), shearing(0.5 * stress * x / maxwell.shear()));
        EXPECT_NEAR(stress_xy(b), stress, 64.0 * epsilon * stress) << x;
    }
}

// Strained as gamma = J(t) s, straight between the ends of steps, the soil should keep the stress s. Chords
// of J are off by up to h^2 max J'' / 8 = (h / T)^2 / (8 G_K) between the ends, T the retardation time. The
// stress is that deviation's convolution with dG/dt, whose integral is below G: G / G_K (h / T)^2 / 8 of s.
// The delayed strain s / G_K (1 - exp(-t / T)) is off by no more of s / G_K.
TEST(Viscoelastic, CreepsAsTheClosedFormSays) {
    const Component c = salt.soil();
    const double stress = 1e6, h = 1e-3 * salt.retardation_time();
    const double tolerance = salt.shear() / salt.delayed_modulus * 1e-6 / 8.0;
    Batch b(c, 1);
    advance(b, 0.0, shearing(0.5 * stress / salt.shear()));
    for (int n = 1; n <= 5000; ++n) {
        const long double more = salt.creep(n * h) - salt.creep((n - 1) * h);
        advance(b, h, shearing(0.5 * stress * static_cast<double>(more)));
        ASSERT_NEAR(stress_xy(b), stress, tolerance * stress) << n;
        const double delayed = -std::expm1(-1e-3 * n) * stress / salt.delayed_modulus;
        ASSERT_NEAR(2.0 * b.state_old[3][0], delayed, tolerance * stress / salt.delayed_modulus) << n;
    }
}

// Held at a strain, a soil without flow ends as its two springs in series; strained back, as it began.
TEST(Viscoelastic, RecoversWhatDidNotFlow) {
    const Component c = kelvin.soil();
    Batch b(c, 1);
    const double gamma = 1e-4, long_time = 1e3 * kelvin.retardation_time();
    advance(b, long_time, shearing(0.5 * gamma));
    advance(b, long_time, {});
    const double series = 1.0 / (1.0 / kelvin.shear() + 1.0 / kelvin.delayed_modulus);
    EXPECT_NEAR(stress_xy(b), series * gamma, 16.0 * epsilon * series * gamma);
    EXPECT_NEAR(b.state_old[3][0], 0.5 * series * gamma / kelvin.delayed_modulus, 16.0 * epsilon * gamma);
    advance(b, long_time, shearing(-0.5 * gamma));
    advance(b, long_time, {});
    EXPECT_NEAR(stress_xy(b), 0.0, 16.0 * epsilon * series * gamma);
    EXPECT_NEAR(b.state_old[3][0], 0.0, 16.0 * epsilon * gamma);
}

// 1000 steps add up 1000 roundings of each of the terms, of which there are six.
TEST(Viscoelastic, KnowsNothingOfTheNumberOfSteps) {
    Random random;
    for (const Burgers& m : {maxwell, kelvin, salt}) {
        const Component c = m.soil();
        for (const double x : {1e-3, 1.0, 10.0}) {
            const Tensor strain = random.tensor(1e-4), stress = random.tensor(1e6);
            const Tensor delayed = deviator(random.tensor(1e-4));
            const double time = x * salt.retardation_time();
            std::array<Tensor, 2> stresses, delayeds;
            for (const int way : {0, 1}) {
                const int steps = way == 0 ? 1 : 1000;
                Batch b(c, 1);
                b.set_stress_old(0, stress);
                for (int i = 0; i < 6 && m.delayed_modulus > 0.0; ++i)
                    b.state_old[i][0] = delayed[i];
                for (int n = 0; n < steps; ++n)
                    advance(b, time / steps, times(1.0 / steps, strain));
                stresses[way] = b.stress_at(0);
                for (int i = 0; i < 6; ++i)
                    delayeds[way][i] = b.state[i][0];
            }
            for (int i = 0; i < 6; ++i) {
                EXPECT_NEAR(stresses[0][i], stresses[1][i], 6e3 * epsilon * 5e6) << x;
                EXPECT_NEAR(delayeds[0][i], delayeds[1][i], 6e3 * epsilon * 1e-4) << x;
            }
        }
    }
}

TEST(Viscoelastic, AStepWithoutLengthIsElasticAndKeepsTheDelayedStrain) {
    Random random;
    const Component c = salt.soil();
    Batch b(c, 1);
    const Tensor stress = random.tensor(1e6), strain = random.tensor(1e-4),
                 delayed = deviator(random.tensor(1e-4));
    b.set_stress_old(0, stress);
    for (int i = 0; i < 6; ++i)
        b.state_old[i][0] = delayed[i];
    advance(b, 0.0, strain);
    const double lame = salt.bulk() - 2.0 * salt.shear() / 3.0;
    for (int i = 0; i < 6; ++i) {
        const double direct = i < 3 ? lame * (strain[0] + strain[1] + strain[2]) : 0.0;
        EXPECT_NEAR(b.stress_at(0)[i], stress[i] + direct + 2.0 * salt.shear() * strain[i],
                    16.0 * epsilon * 5e6);
        EXPECT_EQ(b.state_old[i][0], delayed[i]);
    }
}

// Old stress below 1 MPa, its change below 2 E 1e-4 = 5 MPa: some ten roundings of them.
TEST(Viscoelastic, WithoutViscosityItIsLinearElasticity) {
    const Burgers m{25e9, 0.25, 0.0};
    const Component c = m.soil();
    Random random;
    const double lame = m.bulk() - 2.0 * m.shear() / 3.0;
    for (const double dt : {0.0, 1e-9, 1.0, 1e20}) {
        Batch b(c, 1);
        const Tensor stress = random.tensor(1e6), strain = random.tensor(1e-4);
        b.set_stress_old(0, stress);
        advance(b, dt, strain);
        for (int i = 0; i < 6; ++i) {
            const double direct = i < 3 ? lame * (strain[0] + strain[1] + strain[2]) : 0.0;
            EXPECT_NEAR(b.stress_at(0)[i], stress[i] + direct + 2.0 * m.shear() * strain[i],
                        16.0 * epsilon * 5e6);
        }
    }
}

TEST(Viscoelastic, NeverRelaxesItsPressure) {
    const Component c = salt.soil();
    Batch b(c, 1);
    b.set_stress_old(0, {-3e6, -1e6, -2e6, 1e6, 0.0, 0.0});
    advance(b, 1e6 * salt.relaxation_time(), {1e-4, 1e-4, 1e-4, 0.0, 0.0, 0.0});
    const double mean = -2e6 + 3e-4 * salt.bulk();
    for (int i = 0; i < 6; ++i)
        EXPECT_NEAR(b.stress_at(0)[i], i < 3 ? mean : 0.0, 16.0 * epsilon * 3e6);
}

// The law is linear, so differences of any size have only the rounding of their stresses, 5 MPa or less, over
// a strain of 1e-4.
TEST(Viscoelastic, HasTheTangentThatItsUpdateFollows) {
    Random random;
    for (const Burgers& m : {maxwell, kelvin, salt}) {
        const Component c = m.soil();
        for (const double x : {0.0, 1e-3, 1.0, 1e3}) {
            const Tensor stress = random.tensor(1e6), delayed = random.tensor(1e-4);
            for (int column = 0; column < 6; ++column) {
                Batch b(c, 2, true);
                b.set_dt(x * salt.retardation_time());
                b.strain[column][0] = 1e-4;
                for (int point = 0; point < 2; ++point) {
                    b.set_stress_old(point, stress);
                    for (int i = 0; i < 6; ++i)
                        b.state_old[i][point] = delayed[i];
                }
                ASSERT_EQ(b.update(), GAULT_OK);
                for (int row = 0; row < 6; ++row)
                    EXPECT_NEAR(b.tangent[6 * row + column][0], (b.stress[row][0] - b.stress[row][1]) / 1e-4,
                                16.0 * epsilon * 5e6 / 1e-4)
                        << row << column;
            }
        }
    }
}

TEST(Viscoelastic, StatesTheModuliOfASuddenStrain) {
    const Component c = salt.soil();
    Batch b(c, 9);
    b.set_dt(1e6 * salt.relaxation_time());
    ASSERT_EQ(b.update(), GAULT_OK);
    for (int64_t i = 0; i < b.count(); ++i) {
        EXPECT_DOUBLE_EQ(b.shear_modulus[i], salt.shear());
        EXPECT_DOUBLE_EQ(b.modulus[i], salt.bulk() + 4.0 * salt.shear() / 3.0);
    }
}

TEST(Viscoelastic, RefusesHalfAKelvinElement) {
    for (const Burgers& half : {Burgers{25e9, 0.25, 1e17, 5e9, 0.0}, Burgers{25e9, 0.25, 1e17, 0.0, 2e15}})
        try {
            half.soil();
            ADD_FAILURE() << "accepted";
        } catch (const Invalid& e) {
            EXPECT_EQ(e.parameter,
                      half.delayed_modulus > 0.0 ? "delayed_shear_modulus" : "delayed_viscosity");
        }
}

TEST(Viscoelastic, GivesTheSameBitsOnEveryProcessor) {
    std::vector<Tensor> first;
    for (const std::string& variant : variants()) {
        const Component c = salt.soil(variant);
        Batch b(c, 37);
        Random random;
        b.set_dt(0.3 * salt.retardation_time());
        for (int64_t i = 0; i < b.count(); ++i) {
            b.set_strain(i, random.tensor(1e-3));
            b.set_stress_old(i, random.tensor(1e6));
            for (int k = 0; k < 6; ++k)
                b.state_old[k][i] = 1e-3 * random.uniform();
        }
        ASSERT_EQ(b.update(), GAULT_OK);
        std::vector<Tensor> result;
        for (int64_t i = 0; i < b.count(); ++i)
            result.push_back(b.stress_at(i));
        if (first.empty()) first = result;
        EXPECT_EQ(result, first) << variant;
    }
}

} // namespace
