#include "driver_test.hpp"

#include <algorithm>
#include <cstring>

namespace {
using namespace mohr_coulomb_test;

constexpr size_t batch_size = 512;

Tensor add_elastic(const Parameters& p, Tensor stress, const Tensor& strain) {
    for (int i = 0; i < 6; ++i)
        stress[i] += 2 * p.G() * strain[i] + (i < 3 ? p.lame() * (strain[0] + strain[1] + strain[2]) : 0.0);
    return stress;
}
Tensor compliance(const Parameters& p, Tensor stress) {
    const double third = p.lame() / (3 * p.lame() + 2 * p.G()) * (stress[0] + stress[1] + stress[2]);
    for (int i = 0; i < 6; ++i)
        stress[i] = (stress[i] - (i < 3 ? third : 0.0)) / (2 * p.G());
    return stress;
}

// Random admissible stresses: random ones, returned.
std::vector<Tensor> admissible(const Model& model, Random& random, size_t count) {
    Batch b;
    for (size_t i = 0; i < count; ++i) {
        Tensor s = random.tensor(random.magnitude(-2, 7));
        for (int c = 0; c < 3; ++c)
            s[c] -= random.magnitude(-2, 7);
        b.stress_old.push_back(s);
        b.strain.push_back({});
    }
    model.update(b);
    return b.stress;
}

TEST(MohrCoulomb, ReturnsToTheApexUnderIsotropicExtension) {
    const Model soil(Parameters{});
    const Tensor s = soil.update(diagonal(-90e3, -90e3, -90e3), diagonal(1e-3, 1e-3, 1e-3));
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(s[i], 900.40, 0.005); // five digits are given
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(s[i], 1e3 / std::tan(48 * degree), 1e-10); // rounding of 2e3 Pa: 2e-13 a step
    for (int i = 3; i < 6; ++i)
        EXPECT_EQ(s[i], 0.0);
}

// 1e6 increments. What is checked is linear in the stress, so rounding alone limits it: the yield condition
// holds to a few 1e-16 of the stress itself, however far away the trial stress was.
TEST(MohrCoulomb, StaysAdmissibleWhateverTheIncrement) {
    const size_t batches = 1000000 / (soils().size() * batch_size) + 1;
    for (const Parameters& p : soils()) {
        const Model model(p);
        Random random;
        for (size_t n = 0; n < batches; ++n) {
            Batch b;
            b.stress_old = admissible(model, random, batch_size);
            for (size_t i = 0; i < batch_size; ++i)
                b.strain.push_back(random.tensor(random.magnitude(-8, 0)));
            model.update(b);
            Batch again{b.stress, std::vector<Tensor>(batch_size), {}, {}, {}};
            model.update(again);
            for (size_t i = 0; i < batch_size; ++i) {
                const double size = norm(b.stress[i]);
                ASSERT_TRUE(std::isfinite(size));
                ASSERT_LE(p.excess(principal(b.stress[i])), 1e-9 * (1 + size));
                ASSERT_LE(norm(minus(again.stress[i], b.stress[i])), 1e-12 * size + 1e-300);
                ASSERT_GE(b.plastic_strain[i], 0.0);
                if (p.psi < 0 || p.psi > p.phi) continue;
                const Tensor trial = add_elastic(p, b.stress_old[i], b.strain[i]);
                const Tensor plastic = compliance(p, minus(trial, b.stress[i]));
                // Rounding of the trial stress (1e-15 of it) is a spurious plastic strain; stiffness
                // amplifies it.
                const double noise = 1e-15 * norm(trial) / p.G() * (1 + p.lame() / p.G()) * size;
                ASSERT_GE(dot(b.stress[i], plastic), -10 * noise) << p.phi << ' ' << p.psi;
            }
        }
    }
}

TEST(MohrCoulomb, AccumulatesTheEquivalentPlasticStrain) {
    for (const Parameters& p : soils()) {
        const Model model(p);
        Random random;
        Batch b;
        b.stress_old = admissible(model, random, batch_size);
        for (size_t i = 0; i < batch_size; ++i) {
            b.strain.push_back(random.tensor(random.magnitude(-6, -1)));
            b.plastic_strain.push_back(random.uniform(0, 1));
        }
        const std::vector<double> old = b.plastic_strain;
        model.update(b);
        for (size_t i = 0; i < batch_size; ++i) {
            const Tensor trial = add_elastic(p, b.stress_old[i], b.strain[i]);
            const double expected = std::sqrt(2.0 / 3.0) * norm(compliance(p, minus(trial, b.stress[i])));
            // The difference of two stresses, squared and rooted.
            const double rounding = 1e-13 * norm(trial) / p.G();
            // Isotropic parts cancel in the square.
            const double lost = 1e-7 * norm(trial) / p.G() * (p.nu > 0.49);
            ASSERT_NEAR(b.plastic_strain[i] - old[i], expected, 1e-12 + 1e-9 * expected + rounding + lost);
        }
    }
}

// Along straight lines of trial stress the result moves by no more than a fixed multiple of the step: it does
// not jump where one region ends and another begins.
TEST(MohrCoulomb, IsContinuousAcrossTheBordersOfRegions) {
    for (const Parameters& p : soils()) {
        const Model model(p);
        Random random;
        const double size = p.c + 1e3;
        // A return moves along a flow of size 1 + |lambda/G| that meets the surface at a slope of kappa or
        // more.
        const double steepest = 2 * (1 + std::fabs(p.lame() / p.G())) / p.kappa();
        for (int n = 0; n < 60; ++n) {
            const Tensor from = random.tensor(4 * size), step = random.tensor(2e-3 * size);
            Batch b;
            for (int i = 0; i < 4096; ++i) {
                Tensor s = from;
                for (int c = 0; c < 6; ++c) // half of the lines stay in the plane
                    s[c] = c > 3 && n % 2 ? 0.0 : s[c] + i * step[c];
                b.stress_old.push_back(s);
                b.strain.push_back({});
            }
            model.update(b);
            for (size_t i = 1; i < b.stress.size(); ++i)
                ASSERT_LE(norm(minus(b.stress[i], b.stress[i - 1])), steepest * norm(step));
        }
    }
}

// The hexagon has two kinds of closest points: halve the excess of the largest difference; if that overtakes
// the intermediate stress, keep the mean and put the two others on the corner.
TEST(MohrCoulomb, IsTrescaAtNoFriction) {
    const Parameters p{13e6, 0.3, 50e3, 0, 0};
    const Model model(p);
    Random random;
    int corners = 0;
    for (int n = 0; n < 20000; ++n) {
        const Matrix q = random.rotation();
        Principal s{random.uniform(-3e5, 3e5), random.uniform(-3e5, 3e5), random.uniform(-3e5, 3e5)};
        std::sort(s.begin(), s.end(), std::greater<>());
        Principal e = s;
        const double mean = (s[0] + s[1] + s[2]) / 3, over = s[0] - s[2] - 2 * p.c;
        if (over > 0) {
            e = {s[0] - over / 2, s[1], s[2] + over / 2};
            if (e[1] > e[0]) e = {mean + 2 * p.c / 3, mean + 2 * p.c / 3, mean - 4 * p.c / 3}, ++corners;
            if (e[1] < e[2]) e = {mean + 4 * p.c / 3, mean - 2 * p.c / 3, mean - 2 * p.c / 3}, ++corners;
        }
        const Tensor result = model.update(rotated(diagonal(s[0], s[1], s[2]), q), {});
        const Tensor expected = rotated(diagonal(e[0], e[1], e[2]), q);
        ASSERT_LE(norm(minus(result, expected)), 1e-9) << "1e-15 of 5e5 Pa, over some ten operations";
    }
    EXPECT_GT(corners, 2000);
}

// sigma = trial - gamma D dg/dsigma with the gradients of Nayak and Zienkiewicz (1972) in stress invariants:
// no principal directions. Exact where the return is to the plane, whose flow direction is constant.
TEST(MohrCoulomb, ReturnsToThePlaneAsInGeneralStressSpace) {
    const auto gradient = [](const Tensor& s, double angle) {
        const double mean = (s[0] + s[1] + s[2]) / 3, sine = std::sin(angle);
        const Tensor d = minus(s, diagonal(mean, mean, mean));
        const Matrix m = matrix(d);
        const double j2 = dot(d, d) / 2, root = std::sqrt(j2);
        const double j3 = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[1][2]) -
                          m[0][1] * (m[0][1] * m[2][2] - m[1][2] * m[0][2]) +
                          m[0][2] * (m[0][1] * m[1][2] - m[1][1] * m[0][2]);
        const double lode = std::asin(-1.5 * std::sqrt(3.0) * j3 / (j2 * root)) / 3;
        const double c2 = std::cos(lode) * (1 + std::tan(lode) * std::tan(3 * lode) +
                                            sine * (std::tan(3 * lode) - std::tan(lode)) / std::sqrt(3.0));
        const double c3 =
            (std::sqrt(3.0) * std::sin(lode) + std::cos(lode) * sine) / (2 * j2 * std::cos(3 * lode));
        Tensor a{};
        for (int i = 0; i < 6; ++i) {
            double square = 0; // d:d, of which dJ3 = d.d - 2/3 J2 1
            for (int k = 0; k < 3; ++k)
                square += m[row_of[i]][k] * m[k][column_of[i]];
            const double unit = i < 3 ? 1.0 : 0.0;
            a[i] = sine / 3 * unit + c2 * d[i] / (2 * root) + c3 * (square - 2.0 / 3.0 * j2 * unit);
        }
        return a;
    };
    const Parameters p{};
    const Model model(p);
    Random random;
    int checked = 0;
    for (int n = 0; n < 20000; ++n) {
        const double s3 = random.uniform(-400e3, -100e3), s1 = 0.1 * s3, s2 = random.uniform(s3, s1);
        const Tensor trial = rotated(diagonal(s1, s2, s3), random.rotation());
        const Principal s = principal(trial), r = principal(model.update(trial, {}));
        const double gap = std::min({r[0] - r[1], r[1] - r[2], s[0] - s[1], s[1] - s[2]});
        if (p.shear_excess(s) <= 0 || gap < 1e3)
            continue; // on the plane, and no corner of the trial's Lode angle
        const double yield =
            ((s[0] - s[2]) + (s[0] + s[2]) * std::sin(p.phi * degree)) / 2 - p.c * std::cos(p.phi * degree);
        const Tensor normal = gradient(trial, p.phi * degree);
        const Tensor flow = add_elastic(p, Tensor{}, gradient(trial, p.psi * degree));
        const double gamma = yield / dot(normal, flow);
        Tensor expected = trial;
        for (int i = 0; i < 6; ++i)
            expected[i] -= gamma * flow[i];
        // tan 3 lode magnifies rounding (2e-11 Pa) by |s| / gap squared, at most 1e5 here.
        ASSERT_LE(norm(minus(model.update(trial, {}), expected)), 1e-5);
        ++checked;
    }
    EXPECT_GT(checked, 3000);
}

TEST(MohrCoulomb, TurnsWithItsInput) {
    for (const Parameters& p : soils()) {
        const Model model(p);
        Random random;
        const std::vector<Tensor> old = admissible(model, random, batch_size);
        for (const Tensor& s : old) {
            const Matrix q = random.rotation();
            const Tensor strain = random.tensor(random.magnitude(-6, -2));
            const Tensor turned = model.update(rotated(s, q), rotated(strain, q));
            const Tensor expected = rotated(model.update(s, strain), q);
            const double size = norm(add_elastic(p, s, strain)) + norm(s);
            // Rounding of the rotations, 1e-15, magnified by the return as in the test of continuity.
            ASSERT_LE(norm(minus(turned, expected)),
                      1e-14 * size * (1 + std::fabs(p.lame() / p.G())) * (1 + 1 / p.kappa()));
        }
    }
}

// A shear stress of 1e-200 Pa out of the plane changes nothing but the path of the computation.
TEST(MohrCoulomb, UsesAShortPathInThePlaneThatAgreesWithTheGeneralOne) {
    for (const Parameters& p : soils()) {
        const Model model(p);
        Random random;
        Batch plane;
        for (size_t i = 0; i < 40 * batch_size; ++i) {
            // Turns plane ones to any angle, at times to none.
            Tensor s = random.tensor(random.magnitude(0, 6));
            s[4] = s[5] = 0;
            if (i % 7 == 0) s[3] = 0;
            if (i % 11 == 0) s[1] = s[0];
            if (i % 13 == 0) s[2] = s[1];
            plane.stress_old.push_back(s);
            plane.strain.push_back({});
        }
        Batch space = plane;
        for (Tensor& s : space.stress_old)
            s[4] = 1e-200;
        model.update(plane);
        model.update(space);
        for (size_t i = 0; i < plane.stress.size(); ++i)
            ASSERT_LE(norm(minus(plane.stress[i], space.stress[i])),
                      1e-13 * norm(plane.stress_old[i]) * (1 + std::fabs(p.lame() / p.G())));
    }
}

// Moves the free normal strains by Newton's method on the consistent tangent until their stresses are as
// wanted.
Tensor strain_for(const Model& model, const Tensor& stress, Tensor strain, std::vector<int> free,
                  const Tensor& wanted) {
    for (int iteration = 0; iteration < 30; ++iteration) {
        Batch b{{stress}, {strain}, {}, {}, {}};
        model.update(b, true);
        const auto& k = b.tangent[0];
        std::array<double, 2> residual{};
        for (size_t i = 0; i < free.size(); ++i)
            residual[i] = wanted[free[i]] - b.stress[0][free[i]];
        if (free.size() == 1) {
            strain[free[0]] += residual[0] / k[7 * free[0]];
        } else { // two equal ones, moved together
            const double stiffness = k[7 * free[0]] + k[6 * free[0] + free[1]];
            for (int i : free)
                strain[i] += residual[0] / stiffness;
        }
    }
    return strain;
}

TEST(MohrCoulomb, ReachesTheTriaxialStrength) {
    const Parameters p{};
    const Model model(p);
    Tensor s = diagonal(-90e3, -90e3, -90e3);
    for (int step = 0; step < 50; ++step)
        s = model.update(s, strain_for(model, s, diagonal(1e-4, -4e-4, 1e-4), {0, 2}, s));
    const double sine = std::sin(p.phi * degree);
    const double strength = 90e3 * (1 + sine) / (1 - sine) + 2 * p.c * std::cos(p.phi * degree) / (1 - sine);
    EXPECT_NEAR(s[0], -90e3, 1e-6);
    EXPECT_NEAR(s[1], -strength, 1e-9 * strength);
}

TEST(MohrCoulomb, DilatesBySinePsiInTheBiaxialTest) {
    for (const double psi : {-5.0, 0.0, 16.5, 48.0}) {
        Parameters p{};
        p.psi = psi;
        const Model model(p);
        Tensor s = diagonal(-90e3, -90e3, -90e3), strain{};
        for (int step = 0; step < 200; ++step) {
            strain = strain_for(model, s, diagonal(1e-4, -4e-4, 0), {0}, s);
            s = model.update(s, strain);
        }
        EXPECT_NEAR((strain[0] + strain[1]) / (strain[0] - strain[1]), std::sin(psi * degree), 1e-9);
    }
}

TEST(MohrCoulomb, GivesTheSameBitsOnEveryProcessor) {
    for (const std::string& folder : plugin_test::variants())
        for (const Parameters& p : soils()) {
            const Model model(p), variant(p, folder);
            Random random;
            Batch b;
            b.stress_old = admissible(model, random, 4096);
            for (Tensor& s : b.stress_old) {
                b.strain.push_back(random.tensor(random.magnitude(-8, -1)));
                if (random.uniform(0, 1) < 0.5) // plane and general states side by side
                    s[4] = s[5] = b.strain.back()[4] = b.strain.back()[5] = 0;
            }
            Batch other = b;
            model.update(b, true);
            variant.update(other, true);
            ASSERT_EQ(0, std::memcmp(b.stress.data(), other.stress.data(), sizeof(Tensor) * b.stress.size()))
                << folder;
            ASSERT_EQ(0, std::memcmp(b.tangent.data(), other.tangent.data(),
                                     sizeof b.tangent[0] * b.tangent.size()));
            ASSERT_EQ(b.plastic_strain, other.plastic_strain);
        }
}

TEST(MohrCoulomb, SaysItsElasticModuli) {
    const Parameters p{};
    const Model model(p);
    Batch b{{Tensor{}}, {Tensor{}}, {}, {}, {}};
    model.update(b);
    EXPECT_NEAR(b.modulus, 120e6, 1e-6); // E 100 MPa, nu 0.25
    EXPECT_NEAR(b.shear_modulus, 40e6, 1e-6);
}

// Where it flows, the fastest wave along a principal direction, by differences of the very update: on the plane and both edges.
TEST(MohrCoulomb, SaysTheModulusOfSoilThatFlows) {
    const Parameters p{100e6, 0.4, 1e3, 40, -2, {}, {}};
    const Model model(p);
    double fastest = 0, said = 0;
    const Tensor isotropic = diagonal(-100e3, -100e3, -100e3);
    for (const Tensor& shear :
         {diagonal(1e-3, 1e-3, -2e-3), diagonal(1e-3, 0, -1e-3), diagonal(1.4e-3, -7e-4, -7e-4)}) {
        for (int i = 0; i < 3; ++i) {
            Tensor more = shear;
            more[i] += 1e-7;
            Batch b{{isotropic, isotropic}, {shear, more}, {}, {}, {}};
            model.update(b);
            fastest = std::max(fastest, (b.stress[1][i] - b.stress[0][i]) / 1e-7);
            said = b.modulus;
        }
    }
    EXPECT_NEAR(fastest / (p.lame() + 2 * p.G()), 1.88179587, 1e-6); // from a program of its own
    EXPECT_NEAR(said, fastest, 1e-5 * fastest);
}

TEST(MohrCoulomb, RefusesASoilWithoutStrength) {
    try {
        Model model({100e6, 0.25, 0, 0, 0, {}});
        FAIL();
    } catch (const plugin_test::Invalid& e) {
        EXPECT_EQ(e.parameter, "cohesion");
        EXPECT_NE(std::string(e.what()).find("cohesion"), std::string::npos);
    }
}

TEST(MohrCoulomb, RefusesAContractionThatANearlyIncompressibleSoilCannotFollow) {
    EXPECT_NO_THROW(Model({100e6, 0.25, 1e3, 40, -5}));
    try {
        Model model({100e6, 0.49, 1e3, 40, -5});
        FAIL();
    } catch (const plugin_test::Invalid& e) {
        EXPECT_EQ(e.parameter, "dilation_angle");
        EXPECT_NE(std::string(e.what()).find("must be above"), std::string::npos);
    }
}

TEST(MohrCoulomb, RefusesAnInitialStressBeyondItsStrength) {
    const Model model({100e6, 0.25, 1e3, 48, 16.5, 500.0});
    gault_error error{};
    EXPECT_EQ(model.start(diagonal(-90e3, -90e3, -40e3), error), GAULT_OK);
    EXPECT_EQ(model.start(diagonal(-90e3, -90e3, -10e3), error), GAULT_FAILED);
    EXPECT_EQ(error.point, 0);
    EXPECT_NE(std::string(error.text).find("Mohr-Coulomb strength"), std::string::npos);
    EXPECT_EQ(model.start(diagonal(600, 600, 600), error), GAULT_FAILED);
    EXPECT_NE(std::string(error.text).find("tension_strength"), std::string::npos);
}

} // namespace
