#include "plain_law_test.hpp"

#include "laboratory.hpp"

#include <gtest/gtest.h>

#include <random>

namespace {
using namespace plugin_test;
using plain::Matrix;

constexpr int void_ratio = 0, memory = 1, mobilised = 7; // states
constexpr double radius = 1e-4;
const plain::Sand hochstetten; // without memory

Settings settings(double e0, bool remembers) {
    Settings s{{"friction_angle", 33.0 * degree},
               {"granular_hardness", 1e9},
               {"exponent", 0.25},
               {"e_d0", 0.55},
               {"e_c0", 0.95},
               {"e_i0", 1.05},
               {"alpha", 0.25},
               {"beta", 1.0},
               {"initial_void_ratio", e0}};
    if (remembers)
        for (const auto& [name, value] : {std::pair{"intergranular_radius", radius},
                                          {"m_r", 5.0},
                                          {"m_t", 2.0},
                                          {"beta_r", 0.5},
                                          {"chi", 6.0}})
            s[name] = value;
    return s;
}
Component sand(double e0, bool remembers, const std::string& variant = "") {
    return {"hypoplastic_sand", GAULT_MATERIAL, "hypoplastic_sand", settings(e0, remembers), variant};
}
Tensor isotropic(double pressure) {
    return {-pressure, -pressure, -pressure, 0.0, 0.0, 0.0};
}
Matrix matrix(const Tensor& t) {
    Matrix m;
    m << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
    return m;
}
Tensor tensor(const Matrix& m) {
    return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(2, 0)};
}
double effective_pressure(const Laboratory& lab) { // the p* of the law
    return lab.p() + hochstetten.p_t;
}
// sin phi of Matsuoka and Nakai, from the invariants: sin^2 = (I1 I2 - 9 I3) / (I1 I2 - I3).
double matsuoka_nakai(const Tensor& stress) {
    const Matrix t = hochstetten.p_t * Matrix::Identity() - matrix(stress);
    const double i1 = t.trace(), i2 = 0.5 * (i1 * i1 - (t * t).trace()), i3 = t.determinant();
    return std::sqrt((i1 * i2 - 9.0 * i3) / (i1 * i2 - i3));
}
Controls constant_pressure(const Controls& path, double pressure) {
    Controls c = path;
    for (std::size_t i = 0; i < 3; ++i)
        c[i] = {Control::stress, -pressure};
    return c;
}

// ---- asymptotic states ---------------------------------------------------------------------------------

// e - e_c and the stress ratio relax exponentially with strain; 300 % leave less than 1e-4 of 0.25.
TEST(HypoplasticSand, ReachesTheCriticalStateFromDenseAndLoose) {
    for (double e0 : {0.6, 0.88}) {
        const Component c = sand(e0, false);
        Laboratory lab(c, isotropic(100e3));
        for (int i = 0; i < 600; ++i)
            lab.triaxial_drained(-5e-3, -100e3);
        const double s1 = hochstetten.p_t - lab.stress()[0], s3 = hochstetten.p_t - lab.stress()[1];
        EXPECT_NEAR((s1 - s3) / (s1 + s3), std::sin(hochstetten.phi_c), 1e-4) << e0;
        EXPECT_NEAR(lab.state(void_ratio),
                    hochstetten.e_c0 * plain::bauer(hochstetten, effective_pressure(lab)), 1e-4)
            << e0;
        EXPECT_NEAR(lab.state(mobilised), hochstetten.phi_c, 1e-4) << e0;
    }
}

// The critical surface is that of Matsuoka and Nakai: in extension and in simple shear as in compression.
TEST(HypoplasticSand, FailsAtTheSurfaceOfMatsuokaAndNakaiInExtensionAndSimpleShear) {
    const Component c = sand(0.75, false);
    Laboratory extension(c, isotropic(100e3)), shear(c, isotropic(100e3));
    for (int i = 0; i < 600; ++i) {
        extension.triaxial_drained(5e-3, -100e3);
        Controls simple_shear{};
        simple_shear[3] = {Control::strain, 5e-3};
        shear.step(constant_pressure(simple_shear, 100e3));
    }
    const double expected = std::sin(hochstetten.phi_c);
    EXPECT_NEAR(matsuoka_nakai(extension.stress()), expected, 1e-4);
    EXPECT_NEAR(matsuoka_nakai(shear.stress()), expected, 1e-4);
    EXPECT_NEAR(std::sin(shear.state(mobilised)), expected, 1e-4);
    EXPECT_GT(shear.stress()[3], 0.5 * shear.p());
}

// Bauer's law, of which f_b is the derivative. e is exact for the strain, so only the stress has an
// error: 1e-5 of it would move e on the line by n load^n e < 0.2 e times that.
TEST(HypoplasticSand, FollowsBauersLawInIsotropicCompression) {
    const double start = 1e3;
    const Component c =
        sand(hochstetten.e_i0 * plain::bauer(hochstetten, start + hochstetten.p_t) - 1e-15, false);
    Laboratory lab(c, isotropic(start));
    while (lab.p() < 100e6) {
        lab.strain_step({-5e-4, -5e-4, -5e-4, 0.0, 0.0, 0.0});
        EXPECT_NEAR(lab.state(void_ratio),
                    hochstetten.e_i0 * plain::bauer(hochstetten, effective_pressure(lab)), 2e-6);
    }
}

// The ratio at which the rate of stress is in the direction of the stress, at a given f_d.
double ratio_of_proportional_compression(double f_d) {
    double low = 0.2, high = 1.0;
    for (int i = 0; i < 60; ++i) {
        const double ratio = 0.5 * (low + high);
        plain::Sand s = hochstetten;
        s.p_t = 0.0;
        plain::Operators o =
            plain::operators(s, Eigen::Vector3d(-1e5, -ratio * 1e5, -ratio * 1e5).asDiagonal(), 0.8);
        o.f_d = f_d;
        Matrix axial = Matrix::Zero();
        axial(0, 0) = -1.0;
        const Matrix rate = o.linear(axial) + o.nonlinear();
        (rate(1, 1) / rate(0, 0) > ratio ? low : high) = ratio;
    }
    return low;
}

// Uniaxial compression forgets where it began. f_d still drifts with the pressure, and the stress ratio follows
// late: half a percent is allowed.
TEST(HypoplasticSand, TendsToTheRatioOfProportionalCompressionInTheOedometer) {
    std::vector<double> ratio;
    for (double initial_ratio : {0.4, 1.0}) {
        const Component c = sand(0.80, false);
        Laboratory lab(c, {-10e3, -initial_ratio * 10e3, -initial_ratio * 10e3, 0.0, 0.0, 0.0});
        while (lab.stress()[0] > -1e6)
            lab.oedometer(-5e-4);
        const double f_d = plain::f_d(hochstetten, lab.state(void_ratio), effective_pressure(lab));
        ratio.push_back(lab.stress()[1] / lab.stress()[0]);
        EXPECT_NEAR(ratio.back(), ratio_of_proportional_compression(f_d), 0.005 * ratio.back());
    }
    EXPECT_NEAR(ratio[0], ratio[1], 0.005 * ratio[0]);
}

// Where sigma_1 has its peak at constant sigma_3 no stress changes: f_d |L^-1 N| = 1, and the strain is in the
// direction of -L^-1 N. In the step that holds the peak q is within the square of a step's share of it.
TEST(HypoplasticSand, PeaksAtTheLimitSurfaceOfItsDensity) {
    const Component c = sand(0.6, false);
    Laboratory lab(c, isotropic(100e3));
    double q = 0.0;
    Tensor before = lab.strain(), increment{};
    while (lab.q() >= q) {
        q = lab.q();
        before = lab.strain();
        lab.triaxial_drained(-1e-4, -100e3);
        for (std::size_t i = 0; i < 6; ++i)
            increment[i] = lab.strain()[i] - before[i];
    }
    const auto o = plain::operators(hochstetten, matrix(lab.stress()), lab.state(void_ratio));
    const Matrix direction = o.limit_direction();
    EXPECT_NEAR(direction.norm(), 1.0, 1e-3);
    EXPECT_NEAR((increment[0] + increment[1] + increment[2]) / increment[0],
                direction.trace() / direction(0, 0), 1e-3);
    EXPECT_GT(lab.state(mobilised), 43.0 * degree);
}

// ---- intergranular strain ------------------------------------------------------------------------------

// |d| = 1e-9 of a strain moves the memory by 1e-5 of its radius, so the stiffness by chi times that, at most.
TEST(HypoplasticSand, IsStifferAfterAReversalAndAfterATurn) {
    const Component c = sand(0.7, true);
    Laboratory lab(c, isotropic(100e3));
    for (int i = 0; i < 40; ++i)
        lab.oedometer(-1e-4);
    Tensor h{};
    for (int i = 0; i < 6; ++i)
        h[static_cast<std::size_t>(i)] = lab.state(memory + i);
    EXPECT_NEAR(matrix(h).norm(), radius, 1e-6 * radius);

    const auto o = plain::operators(hochstetten, matrix(lab.stress()), lab.state(void_ratio));
    const double size = 1e-9;
    const Matrix on = matrix({-size, 0.0, 0.0, 0.0, 0.0, 0.0}),
                 turned = matrix({0.0, 0.0, 0.0, size, 0.0, 0.0});
    const std::pair<Matrix, Matrix> cases[] = {{on, o.linear(on) + o.nonlinear() * size},
                                               {-on, 5.0 * o.linear(-on)},
                                               {turned, 2.0 * o.linear(turned)}};
    for (const auto& [strain, expected] : cases) {
        Batch b(c, 1);
        b.set_stress_old(0, lab.stress());
        for (int i = 0; i < 7; ++i)
            b.state_old[static_cast<std::size_t>(i)][0] = lab.state(i);
        b.set_strain(0, tensor(strain));
        ASSERT_EQ(b.update(), GAULT_OK);
        const Matrix change = matrix(b.stress_at(0)) - matrix(lab.stress());
        EXPECT_LT((change - expected).norm(), 1e-4 * expected.norm());
    }
}

double compaction_by_cycles(const Component& c, int cycles) {
    Laboratory lab(c, isotropic(1e3));
    const auto load_to = [&lab](double stress) {
        const double sign = -lab.stress()[0] < stress ? -1.0 : 1.0;
        while ((-lab.stress()[0] - stress) * sign > 0.0)
            lab.oedometer(sign * 1e-5);
    };
    load_to(100e3);
    const double before = lab.state(void_ratio);
    for (int i = 0; i < cycles; ++i) {
        load_to(50e3);
        load_to(100e3);
    }
    return before - lab.state(void_ratio);
}

// Niemunis and Herle (1997): small cycles of the model without memory ratchet, those with it hardly do.
TEST(HypoplasticSand, RatchetsMuchLessWithItsMemory) {
    const double without = compaction_by_cycles(sand(0.695, false), 10);
    const double with = compaction_by_cycles(sand(0.695, true), 10);
    EXPECT_GT(without, 0.03);
    EXPECT_GT(with, 0.0);
    EXPECT_LT(with, 0.05 * without);
}

// ---- integration ---------------------------------------------------------------------------------------

// A path that loads, turns and reverses, all components in it.
const std::array<Tensor, 4> legs{{{-2e-3, -1e-3, -5e-4, 0.0, 0.0, 0.0},
                                  {-1e-3, 5e-4, 0.0, 1e-3, -4e-4, 3e-4},
                                  {5e-4, 0.0, -3e-4, -8e-4, 0.0, 2e-4},
                                  {-2e-3, 1e-3, 1e-3, 0.0, 5e-4, 0.0}}};
const Tensor start_of_path{-100e3, -60e3, -50e3, 5e3, 2e3, -3e3};

plain::Point walk_plainly(bool remembers, int steps) {
    plain::Sand s = hochstetten;
    s.remembers = remembers;
    plain::Point at{matrix(start_of_path), Matrix::Zero(), 0.7};
    for (const Tensor& leg : legs)
        for (int i = 0; i < steps; ++i)
            plain::euler(s, at, matrix(leg) / steps);
    return at;
}
Tensor walk(const Component& c, int steps) {
    Laboratory lab(c, start_of_path);
    for (Tensor leg : legs) {
        for (double& e : leg)
            e /= steps;
        for (int i = 0; i < steps; ++i)
            lab.strain_step(leg);
    }
    return lab.stress();
}

// Euler's error falls with the step; extrapolated from two lengths, its rest is of its square, 1e-7 here. The
// integration allows itself 1e-5 in a substep, of the stress and of the memory, and the turns of the memory add up
// to a few of these.
TEST(HypoplasticSand, AgreesWithAPlainIntegrationInTinySteps) {
    for (bool remembers : {false, true}) {
        const int steps = 20000;
        const Matrix fine = walk_plainly(remembers, 2 * steps).stress;
        const Matrix extrapolated = 2.0 * fine - walk_plainly(remembers, steps).stress;
        const Matrix found = matrix(walk(sand(0.7, remembers), 1));
        EXPECT_LT((found - extrapolated).norm(), 5e-5 * extrapolated.norm()) << remembers;
        EXPECT_LT((fine - extrapolated).norm(), 5e-4 * extrapolated.norm()) << remembers;
    }
}

// The strain of a step is straight, so on a straight leg its division changes nothing but the errors that the
// integration tolerates: a few of 1e-5, as above.
TEST(HypoplasticSand, DoesNotDependOnTheDivisionOfAStraightPath) {
    for (bool remembers : {false, true}) {
        const Component c = sand(0.7, remembers);
        const Matrix whole = matrix(walk(c, 1));
        for (int steps : {2, 7, 100})
            EXPECT_LT((matrix(walk(c, steps)) - whole).norm(), 3e-5 * whole.norm()) << steps;
    }
}

// A circle of strain, replaced by a polygon: its sides miss the arc by the square of their length.
Matrix around_a_circle(const Component& c, int steps) {
    Laboratory lab(c, isotropic(100e3));
    const auto place = [steps](int i) {
        const double angle = M_PI * i / steps, size = 2e-3;
        return Tensor{size * (std::cos(angle) - 1.0), 0.0, 0.0, size * std::sin(angle), 0.0, 0.0};
    };
    for (int i = 0; i < steps; ++i) {
        Tensor increment = place(i + 1);
        for (std::size_t k = 0; k < 6; ++k)
            increment[k] -= place(i)[k];
        lab.strain_step(increment);
    }
    return matrix(lab.stress());
}
TEST(HypoplasticSand, ConvergesWithTheSquareOfTheStepOnACurvedPath) {
    for (bool remembers : {false, true}) {
        const Component c = sand(0.7, remembers);
        const Matrix exact = around_a_circle(c, 1024);
        const double coarse = (around_a_circle(c, 16) - exact).norm();
        const double fine = (around_a_circle(c, 32) - exact).norm();
        const double order = std::log2(coarse / fine);
        RecordProperty(remembers ? "order_with_memory" : "order", std::to_string(order));
        EXPECT_GT(order, 1.7) << remembers;
        EXPECT_LT(order, 2.5) << remembers;
    }
}

// ---- what always holds ---------------------------------------------------------------------------------

// States of all pressures and densities, memories within the radius, strains of 1e-9 to 1e-2.
void fill_at_random(Batch& b, bool remembers, unsigned seed = 7) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int64_t i = 0; i < b.count(); ++i) {
        const double pressure = std::pow(10.0, 4.0 + 2.0 * uniform(random));
        Tensor stress = isotropic(pressure), strain, h;
        const double size = std::pow(10.0, -5.5 + 3.5 * uniform(random));
        for (std::size_t k = 0; k < 6; ++k) {
            stress[k] += (k < 3 ? 0.3 : 0.2) * pressure * uniform(random);
            strain[k] = size * uniform(random);
            h[k] = (remembers ? 0.3 * radius : 0.0) * uniform(random);
            b.state_old[memory + k][i] = h[k];
        }
        b.set_stress_old(i, stress);
        b.set_strain(i, strain);
        b.state_old[void_ratio][i] = plain::bauer(hochstetten, pressure) * (0.8 + 0.25 * uniform(random));
    }
}

TEST(HypoplasticSand, StaysAdmissibleOverRandomIncrements) {
    for (bool remembers : {false, true}) {
        const Component c = sand(0.7, remembers);
        Batch b(c, 400);
        fill_at_random(b, remembers);
        for (int step = 0; step < 20; ++step) {
            ASSERT_EQ(b.update(), GAULT_OK) << b.error.text;
            for (int64_t i = 0; i < b.count(); ++i) {
                const Matrix t = matrix(b.stress_at(i));
                const double p = hochstetten.p_t - t.trace() / 3.0;
                ASSERT_LE(t.trace(), 1e-12 * p);
                const Eigen::SelfAdjointEigenSolver<Matrix> principal(t, Eigen::EigenvaluesOnly);
                ASSERT_LE(principal.eigenvalues()[2] - hochstetten.p_t, -0.0099 * p);
                Tensor h{};
                for (std::size_t k = 0; k < 6; ++k)
                    h[k] = b.state[memory + k][i];
                ASSERT_LE(matrix(h).norm(), radius * (1.0 + 1e-14));
                ASSERT_GT(b.state[void_ratio][i], 0.0);
                ASSERT_TRUE(b.state[mobilised][i] >= 0.0 && b.state[mobilised][i] <= 0.5 * M_PI);
                ASSERT_TRUE(b.modulus[i] > 0.0 && std::isfinite(b.modulus[i]));
                ASSERT_TRUE(b.shear_modulus[i] > 0.0 && b.shear_modulus[i] < b.modulus[i]);
            }
            b.advance();
            for (int64_t i = 0; i < b.count(); ++i) // onwards, with the strain of another point
                for (Column& e : b.strain)
                    std::swap(e[i], e[(i * 7 + 3) % b.count()]);
        }
    }
}

// The traction on a plane, for a strain of a wave through it: n.(M:(n v)) for every polarisation v.
TEST(HypoplasticSand, BoundsTheStiffnessOfEveryWave) {
    for (bool remembers : {false, true}) {
        const Component c = sand(0.7, remembers);
        Batch b(c, 4000);
        fill_at_random(b, remembers);
        std::mt19937_64 random(11);
        std::normal_distribution<double> normal;
        std::vector<Eigen::Vector3d> planes;
        const double size = 1e-8;
        for (int64_t i = 0; i < b.count(); ++i) {
            const Eigen::Vector3d n =
                Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
            Eigen::Vector3d v = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
            if (i % 2) v = i % 4 == 1 ? n : Eigen::Vector3d(-n);
            planes.push_back(n);
            b.set_strain(i, tensor(0.5 * size * (n * v.transpose() + v * n.transpose())));
        }
        ASSERT_EQ(b.update(), GAULT_OK);
        double most = 0.0;
        for (int64_t i = 0; i < b.count(); ++i) {
            Tensor old{};
            for (std::size_t k = 0; k < 6; ++k)
                old[k] = b.stress_old[k][i];
            const Matrix change = matrix(b.stress_at(i)) - matrix(old);
            const double stiffness = (change * planes[static_cast<std::size_t>(i)]).norm() / size;
            ASSERT_LE(stiffness, b.modulus[i] * (1.0 + 1e-6)) << i;
            most = std::max(most, stiffness / b.modulus[i]);
        }
        EXPECT_GT(most, 0.8); // and it is not a lavish bound
    }
}

TEST(HypoplasticSand, HasNoTensileMeanStressAndCarriesLoadAgainAfterBeingPulled) {
    for (bool remembers : {false, true}) {
        const Component c = sand(0.7, remembers);
        Laboratory lab(c, {-50e3, -25e3, -25e3, 0.0, 0.0, 0.0});
        for (int i = 0; i < 40; ++i) {
            lab.strain_step({1e-3, 2e-4, 0.0, 5e-4, 0.0, 0.0});
            EXPECT_GE(lab.p(), -1e-9);
        }
        EXPECT_LT(lab.p(), 1e-9);
        EXPECT_LT(lab.q(), 3.0 * hochstetten.p_t);
        for (int i = 0; i < 80; ++i)
            lab.strain_step({-1e-3, -2e-4, 0.0, -5e-4, 0.0, 0.0});
        EXPECT_GT(lab.p(), 50e3);
    }
}

// Large strains are refused with a RETRY, not a number fails, all in no time.
TEST(HypoplasticSand, AnswersAbsurdIncrements) {
    const Component c = sand(0.7, true);
    Batch b(c, 1);
    b.set_stress_old(0, isotropic(100e3));
    ASSERT_EQ(b.start(), GAULT_OK);
    for (double size : {0.5, 1e3, 1e150}) {
        b.set_strain(0, {size, -size, 0.0, size, 0.0, 0.0});
        EXPECT_EQ(b.update(), GAULT_RETRY) << size;
        EXPECT_EQ(b.suggested(), 0.1);
    }
    b.set_strain(0, {std::nan(""), 0.0, 0.0, 0.0, 0.0, 0.0});
    EXPECT_EQ(b.update(), GAULT_FAILED);
    for (double size : {0.0, 1e-300, 1e-18, 0.05}) {
        b.set_strain(0, {-size, size, 0.0, size, 0.0, 0.0});
        EXPECT_EQ(b.update(), GAULT_OK) << size;
        EXPECT_TRUE(std::isfinite(b.stress[0][0]));
    }
}

// ---- symmetries ----------------------------------------------------------------------------------------

TEST(HypoplasticSand, TurnsWithTheFrame) {
    const Matrix r =
        (Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, -1.0).normalized())).toRotationMatrix();
    for (bool remembers : {false, true}) {
        const Component c = sand(0.7, remembers);
        Batch b(c, 500), turned(c, 500);
        fill_at_random(b, remembers);
        fill_at_random(turned, remembers);
        const auto turn = [&r](Columns& columns, std::size_t first, int64_t i) {
            Tensor t{};
            for (std::size_t k = 0; k < 6; ++k)
                t[k] = columns[first + k][i];
            t = tensor(r * matrix(t) * r.transpose());
            for (std::size_t k = 0; k < 6; ++k)
                columns[first + k][i] = t[k];
        };
        for (int64_t i = 0; i < b.count(); ++i) {
            turn(turned.stress_old, 0, i);
            turn(turned.strain, 0, i);
            turn(turned.state_old, memory, i);
        }
        ASSERT_EQ(b.update(), GAULT_OK);
        ASSERT_EQ(turned.update(), GAULT_OK);
        for (int64_t i = 0; i < b.count(); ++i) {
            const Matrix expected = r * matrix(b.stress_at(i)) * r.transpose();
            ASSERT_LT((matrix(turned.stress_at(i)) - expected).norm(), 1e-9 * (100.0 + expected.norm())) << i;
        }
    }
}

// Stresses enter over h_s and p_t only.
TEST(HypoplasticSand, IsHomogeneousInStressAndHardness) {
    Settings scaled = settings(0.7, true);
    scaled["granular_hardness"] = 8e9;
    scaled["minimum_pressure"] = 800.0;
    const Component c = sand(0.7, true);
    const Component hard("hypoplastic_sand", GAULT_MATERIAL, "hypoplastic_sand", scaled);
    Batch b(c, 500), h(hard, 500);
    fill_at_random(b, true);
    fill_at_random(h, true);
    for (Column& s : h.stress_old)
        for (int64_t i = 0; i < h.count(); ++i)
            s[i] *= 8.0;
    ASSERT_EQ(b.update(), GAULT_OK);
    ASSERT_EQ(h.update(), GAULT_OK);
    for (int64_t i = 0; i < b.count(); ++i)
        for (std::size_t k = 0; k < 6; ++k)
            ASSERT_NEAR(h.stress[k][i], 8.0 * b.stress[k][i], 1e-9 * (800.0 + std::abs(h.stress[0][i])));
}

TEST(HypoplasticSand, KnowsNoRate) {
    const Component c = sand(0.7, true);
    Batch slow(c, 100), fast(c, 100);
    fill_at_random(slow, true);
    fill_at_random(fast, true);
    fast.set_dt(1e-9);
    ASSERT_EQ(slow.update(), GAULT_OK);
    ASSERT_EQ(fast.update(), GAULT_OK);
    for (int64_t i = 0; i < slow.count(); ++i)
        EXPECT_EQ(slow.stress_at(i), fast.stress_at(i));
}

TEST(HypoplasticSand, GivesTheSameBitsOnEveryProcessorAndInEveryBatch) {
    std::vector<Tensor> first;
    for (const std::string& variant : variants()) {
        const Component c = sand(0.7, true, variant);
        Batch b(c, 1001);
        fill_at_random(b, true);
        ASSERT_EQ(b.update(), GAULT_OK);
        std::vector<Tensor> result;
        for (int64_t i = 0; i < b.count(); ++i)
            result.push_back(b.stress_at(i));
        if (first.empty()) first = result;
        EXPECT_EQ(result, first) << variant;

        Batch alone(c, 1); // beside no neighbour
        for (int64_t i : {0, 500, 1000}) {
            for (std::size_t k = 0; k < 6; ++k) {
                alone.strain[k][0] = b.strain[k][i];
                alone.stress_old[k][0] = b.stress_old[k][i];
            }
            for (std::size_t k = 0; k < b.state_old.size(); ++k)
                alone.state_old[k][0] = b.state_old[k][i];
            ASSERT_EQ(alone.update(), GAULT_OK);
            EXPECT_EQ(alone.stress_at(0), result[static_cast<std::size_t>(i)]);
        }
    }
}

// ---- what it refuses -----------------------------------------------------------------------------------

TEST(HypoplasticSand, RefusesAnInadmissibleInitialState) {
    const auto answer = [](double e0, const Tensor& stress) {
        const Component c = sand(e0, true);
        Batch b(c, 1);
        b.set_stress_old(0, stress);
        return b.start() == GAULT_OK ? std::string("ok") : std::string(b.error.text);
    };
    EXPECT_EQ(answer(0.7, isotropic(100e3)), "ok");
    EXPECT_EQ(answer(0.7, isotropic(0.0)), "ok");
    EXPECT_EQ(answer(0.7, isotropic(-1.0)), "the initial mean stress is tensile");
    EXPECT_EQ(answer(0.7, {-100e3, -100e3, 1e3, 0.0, 0.0, 0.0}),
              "an initial stress is tensile, or all but lacks lateral pressure");
    EXPECT_EQ(answer(0.45, isotropic(100e3)),
              "the initial void ratio is less than the densest at the initial stress");
    EXPECT_EQ(answer(1.0, isotropic(100e3)),
              "the initial void ratio is more than the loosest at the initial stress");
    EXPECT_EQ(answer(0.85, {-100e3, -20e3, -20e3, 0.0, 0.0, 0.0}),
              "the initial stress is beyond the strength at the void ratio");
}

TEST(HypoplasticSand, RefusesParametersThatMakeNoSense) {
    const auto refused = [](const std::string& name, double value) {
        Settings s = settings(0.7, true);
        s[name] = value;
        try {
            const Component c("hypoplastic_sand", GAULT_MATERIAL, "hypoplastic_sand", s);
        } catch (const Invalid& e) {
            return e.parameter;
        }
        return std::string();
    };
    EXPECT_EQ(refused("e_c0", 0.5), "e_c0");
    EXPECT_EQ(refused("e_i0", 0.9), "e_i0");
    EXPECT_EQ(refused("m_t", 6.0), "m_t");
    Settings s = settings(0.7, false);
    s["m_r"] = 5.0;
    EXPECT_THROW(Component("hypoplastic_sand", GAULT_MATERIAL, "hypoplastic_sand", s), Invalid);
    s = settings(0.7, true);
    s.erase("chi");
    EXPECT_THROW(Component("hypoplastic_sand", GAULT_MATERIAL, "hypoplastic_sand", s), Invalid);
    s = settings(0.7, false);
    s["alpha"] = 1.0, s["friction_angle"] = 45.0 * degree, s["e_i0"] = 1.6;
    EXPECT_THROW(Component("hypoplastic_sand", GAULT_MATERIAL, "hypoplastic_sand", s), Invalid);
}

} // namespace
