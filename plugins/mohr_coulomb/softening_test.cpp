#include "driver_test.hpp"

#include <laboratory.hpp>

#include <cstring>

namespace {
using namespace mohr_coulomb_test;
using plugin_test::Control;
using plugin_test::Laboratory;

// Strong and weak, brittle and ductile, with and without dilation, cut-off and cohesion; none snaps back below 1 MPa.
std::vector<Parameters> softening_soils() {
    return {
        {100e6, 0.25, 1e3, 48, 16.5, {}, Ultimate{1e3, 36, 16.5, 0.05}},
        {100e6, 0.25, 1e3, 48, 16.5, {}, Ultimate{0, 36, 0, 0.05}},
        {100e6, 0.25, 0, 40, 10, {}, Ultimate{0, 30, 0, 0.1}},
        {70e6, 0.3, 20e3, 35, 5, {}, Ultimate{5e3, 25, -2, 0.04}},    // contracts in the end
        {15e6, 0.4999, 50e3, 0, 0, {}, Ultimate{20e3, 0, 0, 0.1}},    // clay
        {15e6, 0.3, 50e3, 20, 0, {}, Ultimate{10e3, 0, 0, 0.5}},      // becomes Tresca's
        {100e6, 0.25, 10e3, 45, 15, 5e3, Ultimate{2e3, 35, 0, 0.05}}, // the cut-off is overtaken by the apex
        {100e6, 0.2, 10e3, 30, 10, 0.0, Ultimate{10e3, 30, 0, 0.02}}, // dilation alone
        {100e6, 0.2, 30e3, 30, 30, {}, Ultimate{30e3, 20, 20, 0.05}}};
}

// Random stresses within the strength after random plastic strains, half of them beyond the end of softening: random
// ones, returned to the surface of that strength.
Batch random_states(const Parameters& p, Random& random, size_t count, double most = 1e6) {
    constexpr size_t strengths = 16;
    Batch all;
    for (size_t n = 0; n < strengths; ++n) {
        const double strained = random.uniform(0, 2 * p.ultimate->strain);
        Batch b;
        for (size_t i = 0; i < count / strengths; ++i) {
            b.stress_old.push_back(random.tensor(random.magnitude(1, std::log10(most))));
            for (int c = 0; c < 3; ++c)
                b.stress_old[i][c] -= random.magnitude(1, std::log10(most));
            b.strain.push_back({});
        }
        Model(p.softened(strained)).update(b);
        all.stress_old.insert(all.stress_old.end(), b.stress.begin(), b.stress.end());
        all.plastic_strain.resize(all.stress_old.size(), strained);
    }
    all.strain.resize(all.stress_old.size());
    return all;
}

// Tresca in pure shear, where gamma is tau/G, elastic, and sqrt(3) times the plastic strain. The return has the strength of
// the end of the step and the direction of flow does not turn: exact however long the steps.
TEST(MohrCoulombSoftening, ClayInPureShearFollowsItsClosedForm) {
    const Parameters p{15e6, 0.49, 50e3, 0, 0, {}, Ultimate{20e3, 0, 0, 0.1}};
    const Model clay(p);
    for (const double step : {1e-5, 1e-3, 0.02}) { // tensor shear; softening begins at 0.5 % and ends at 9 %
        Laboratory point(clay.component(), diagonal(-100e3, -100e3, -100e3));
        for (double strain = 0; strain < 0.12;) {
            point.strain_step({0, 0, 0, step, 0, 0});
            strain += step;
            const double slope = (p.c - p.ultimate->c) / p.ultimate->strain / std::sqrt(3.0);
            const double falling = (p.c - slope * 2 * strain) / (1 - slope / p.G());
            const double tau = std::min(2 * p.G() * strain, std::max(falling, p.ultimate->c));
            ASSERT_NEAR(point.stress()[3], tau, 1e-9 * p.c) << strain;
            ASSERT_NEAR(2 * strain, tau / p.G() + std::sqrt(3.0) * point.state(0), 1e-12);
        }
    }
}

// Drained biaxial test: lateral pressure constant, no strain across. On the plane, with kappa, y, mu those of the plastic
// strain x, the axial stress is that of the angle and
//     d(axial plastic) = -mu/m dx,  d(lateral plastic) = 1/m dx,   m = sqrt(2/3 (1 + mu^2)),
// whose integrals are taken here with 4000 parts. The steps of the model err in the direction of flow alone, which is that
// of their ends: with n steps by half a change of mu over n.
struct Biaxial {
    double axial, lateral; // strains
};
Biaxial biaxial(const Parameters& p, double pressure, double strained) {
    const auto stresses = [&](double x) {
        const Parameters now = p.softened(x);
        return (-pressure - now.y()) / now.kappa();
    };
    double axial = 0, lateral = 0;
    constexpr int parts = 4000;
    for (int i = 0; i < parts; ++i) {
        const double dilation = std::sin(p.softened((i + 0.5) / parts * strained).psi * degree),
                     mu = (1 - dilation) / (1 + dilation), m = std::sqrt(2.0 / 3.0 * (1 + mu * mu));
        axial -= mu / m * strained / parts;
        lateral += 1 / m * strained / parts;
    }
    const double change = stresses(strained) + pressure; // across: nu times it, as nothing yields there
    return {axial + (1 - p.nu * p.nu) * change / p.E, lateral - p.nu * (1 + p.nu) * change / p.E};
}
TEST(MohrCoulombSoftening, SandInABiaxialTestFollowsItsStrengthAndDilation) {
    const Parameters p{100e6, 0.25, 1e3, 48, 16.5, {}, Ultimate{0.2e3, 36, 0, 0.05}};
    const Model sand(p);
    const double pressure = 100e3;
    double before = 0;
    for (const int steps : {50, 100, 200, 400}) {
        Laboratory point(sand.component(), diagonal(-pressure, -pressure, -pressure));
        double worst = 0, reached = 0;
        for (int i = 1; i <= steps; ++i) {
            point.step({{{Control::stress, -pressure},
                         {Control::strain, -0.04 / steps},
                         {Control::strain, 0},
                         {Control::strain, 0},
                         {Control::strain, 0},
                         {Control::strain, 0}}});
            reached = point.state(0);
            if (reached == 0) continue;
            const Parameters now = p.softened(reached);
            ASSERT_NEAR(point.stress()[1], (-pressure - now.y()) / now.kappa(),
                        1e-3); // lateral: 1e-10 of 7e5
            ASSERT_GT(point.stress()[0] - point.stress()[2], 0);
            const Biaxial exact = biaxial(p, pressure, reached);
            worst = std::max({worst, std::fabs(point.strain()[1] - exact.axial),
                              std::fabs(point.strain()[0] - exact.lateral)});
        }
        EXPECT_GT(reached, 0.05 * 0.8);
        EXPECT_LT(worst, 0.04 / steps * 0.5); // mu goes from 0.56 to 1
        if (before > 0) {
            EXPECT_NEAR(before / worst, 2.0, 0.2) << "first order";
        }
        before = worst;
    }
}

// A path whose principal directions and Lode angle turn, through edges and plane, in n steps against 40 times as many.
TEST(MohrCoulombSoftening, ConvergesWithTheLengthOfSteps) {
    for (const Parameters& p : softening_soils()) {
        const Model soil(p);
        const auto run = [&](int n) {
            Laboratory point(soil.component(), diagonal(-100e3, -100e3, -100e3));
            for (int i = 0; i < n; ++i) {
                const double turn = (i + 0.5) / n;
                point.strain_step({-0.03 / n, 0.02 * turn / n, 0.01 * (1 - turn) / n, 0.02 * turn / n,
                                   0.01 * (1 - turn) / n, 0.005 / n});
            }
            return point.stress();
        };
        const Tensor exact = run(16000);
        const double coarse = norm(minus(run(50), exact)), fine = norm(minus(run(400), exact));
        EXPECT_LT(fine, 0.01 * norm(exact));
        EXPECT_GT(std::log(coarse / fine) / std::log(8.0), 0.9) << coarse << ' ' << fine;
    }
}

TEST(MohrCoulombSoftening, EndsAsThePerfectlyPlasticSoilOfItsUltimateValues) {
    for (const Parameters& p : softening_soils()) {
        const Model soil(p), end(p.softened(1.0));
        Random random;
        Batch b = random_states(p, random, 4096);
        for (size_t i = 0; i < b.strain.size(); ++i) {
            b.plastic_strain[i] = p.ultimate->strain * random.uniform(1, 3);
            b.strain[i] = random.tensor(random.magnitude(-6, -2));
        }
        Batch other = b;
        soil.update(b);
        end.update(other);
        for (size_t i = 0; i < b.strain.size(); ++i) {
            const double size =
                norm(b.stress[i]) + 2 * p.G() * norm(b.strain[i]) + p.lame() * norm(b.strain[i]);
            ASSERT_LE(norm(minus(b.stress[i], other.stress[i])),
                      1e-13 * size / p.softened(1.0).kappa()); // two ways to an angle
            ASSERT_NEAR(b.plastic_strain[i], other.plastic_strain[i], 1e-13 * size / p.G() / p.kappa());
        }
    }
}

// Increments of 1e-9 to 1e-2 from random states: on or within the surface of the plastic strain, which is
// the old one and that of the elastic strain lost; the same again without strain; no work is gained.
TEST(MohrCoulombSoftening, NeverLeavesTheSurfaceOfItsPlasticStrain) {
    for (const Parameters& p : softening_soils()) {
        const Model soil(p);
        Random random;
        for (int n = 0; n < 20; ++n) {
            Batch b = random_states(p, random, 512);
            for (Tensor& e : b.strain)
                e = random.tensor(random.magnitude(-9, -2));
            const std::vector<double> old = b.plastic_strain;
            try {
                soil.update(b);
            } catch (const std::runtime_error&) {
                ADD_FAILURE() << "no soil here snaps back";
                return;
            }
            Batch again{b.stress, std::vector<Tensor>(512), {}, b.plastic_strain, {}};
            soil.update(again);
            for (size_t i = 0; i < b.strain.size(); ++i) {
                const double size = norm(b.stress[i]);
                ASSERT_LE(p.softened(b.plastic_strain[i]).excess(principal(b.stress[i])), 1e-9 * (1 + size));
                ASSERT_LE(norm(minus(again.stress[i], b.stress[i])), 1e-12 * size + 1e-300);
                ASSERT_GE(b.plastic_strain[i], old[i]);
                Tensor lost = b.stress_old[i];
                for (int c = 0; c < 6; ++c)
                    lost[c] += 2 * p.G() * b.strain[i][c] - b.stress[i][c] +
                               (c < 3 ? p.lame() * (b.strain[i][0] + b.strain[i][1] + b.strain[i][2]) : 0);
                const double third = p.lame() / (3 * p.lame() + 2 * p.G()) * (lost[0] + lost[1] + lost[2]);
                for (int c = 0; c < 6; ++c)
                    lost[c] = (lost[c] - (c < 3 ? third : 0)) / (2 * p.G());
                const double trial = size + (p.lame() + 2 * p.G()) * norm(b.strain[i]);
                ASSERT_NEAR(b.plastic_strain[i] - old[i], std::sqrt(2.0 / 3.0) * norm(lost),
                            1e-9 * norm(lost) + 1e-12 * trial / p.G() + 1e-15 * b.plastic_strain[i]);
                if (p.psi >= 0 && p.ultimate->psi >= 0) {
                    ASSERT_GE(dot(b.stress[i], lost), -1e-12 * trial * trial / p.G());
                }
            }
        }
    }
}

TEST(MohrCoulombSoftening, TurnsWithItsInput) {
    for (const Parameters& p : softening_soils()) {
        const Model soil(p);
        Random random;
        Batch b = random_states(p, random, 512), turned = b;
        std::vector<Matrix> rotation;
        for (size_t i = 0; i < b.strain.size(); ++i) {
            rotation.push_back(random.rotation());
            b.strain[i] = random.tensor(random.magnitude(-6, -2.5));
            turned.strain[i] = rotated(b.strain[i], rotation[i]);
            turned.stress_old[i] = rotated(b.stress_old[i], rotation[i]);
        }
        soil.update(b);
        soil.update(turned);
        for (size_t i = 0; i < b.strain.size(); ++i) {
            const double size = norm(b.stress_old[i]) + (p.lame() + 2 * p.G()) * norm(b.strain[i]);
            ASSERT_LE(norm(minus(turned.stress[i], rotated(b.stress[i], rotation[i]))), 1e-11 * size);
        }
    }
}

// Central differences with 1e-7 of strain, as in tangent_test.cpp. Across the border of a region, or of softening, the two
// one-sided differences are apart, and the point is left out.
TEST(MohrCoulombSoftening, HasTheTangentOfItsUpdate) {
    int checked = 0, softening = 0, upper = 0, lower = 0;
    for (const Parameters& p : softening_soils()) {
        const Model soil(p);
        const double stiffness = p.lame() + 2 * p.G(), h = 1e-7;
        Random random;
        Batch b = random_states(p, random, 1600, 2e5);
        for (Tensor& e : b.strain)
            e = random.tensor(random.magnitude(-4.5, -2.5));
        Batch here = b;
        soil.update(here, true);
        std::vector<Batch> moved(12, b);
        for (int k = 0; k < 12; ++k) {
            for (Tensor& e : moved[k].strain)
                e[k / 2] += k % 2 ? -h : h;
            soil.update(moved[k]);
        }
        for (size_t i = 0; i < b.strain.size(); ++i) {
            const Principal s = principal(here.stress[i]);
            bool smooth = s[0] - s[1] > 2e-6 * stiffness || s[0] - s[1] < 1e-6; // directions turn fast between
            for (int e = 0; e < 36 && smooth; ++e)
                smooth =
                    std::fabs(moved[2 * (e % 6)].stress[i][e / 6] + moved[2 * (e % 6) + 1].stress[i][e / 6] -
                              2 * here.stress[i][e / 6]) < 2e-5 * stiffness * h;
            if (!smooth) continue;
            ++checked;
            if (here.plastic_strain[i] > b.plastic_strain[i] && here.plastic_strain[i] < p.ultimate->strain) {
                ++softening;
                upper += s[0] - s[1] < 1e-6;
                lower += s[1] - s[2] < 1e-6;
            }
            for (int e = 0; e < 36; ++e) {
                const double difference =
                    (moved[2 * (e % 6)].stress[i][e / 6] - moved[2 * (e % 6) + 1].stress[i][e / 6]) / (2 * h);
                ASSERT_NEAR(here.tangent[i][e], difference, 1e-5 * stiffness) << e;
            }
        }
    }
    EXPECT_GT(softening, 800);
    EXPECT_GT(upper, 200);
    EXPECT_GT(lower, 200);
    EXPECT_GT(checked, 2000);
}

TEST(MohrCoulombSoftening, GivesTheSameBitsOnEveryProcessor) {
    for (const std::string& folder : plugin_test::variants())
        for (const Parameters& p : softening_soils()) {
            const Model soil(p), variant(p, folder);
            Random random;
            Batch b = random_states(p, random, 2048);
            for (size_t i = 0; i < b.strain.size(); ++i) {
                b.strain[i] = random.tensor(random.magnitude(-8, -2));
                if (i % 2) b.stress_old[i][4] = b.stress_old[i][5] = b.strain[i][4] = b.strain[i][5] = 0;
            }
            Batch other = b;
            soil.update(b, true);
            variant.update(other, true);
            ASSERT_EQ(0, std::memcmp(b.stress.data(), other.stress.data(), sizeof(Tensor) * b.stress.size()));
            ASSERT_EQ(0, std::memcmp(b.tangent.data(), other.tangent.data(),
                                     sizeof b.tangent[0] * b.tangent.size()));
            ASSERT_EQ(b.plastic_strain, other.plastic_strain);
        }
}

struct OnePoint {
    Model soil;
    plugin_test::Batch batch;
    explicit OnePoint(const Parameters& p, double cell = 1.0) : soil(p), batch(soil.component(), 1) {
        for (int64_t i = 0; i < 8; ++i)
            batch.input[0][i] = cell;
    }
    gault_status update(const Tensor& stress, const Tensor& strain) {
        for (int64_t i = 0; i < 8; ++i)
            batch.set_stress_old(i, stress), batch.set_strain(i, strain);
        return batch.update();
    }
};

// In cells half as long the strength falls over twice the strain.
TEST(MohrCoulombSoftening, IsScaledWithTheLengthOfTheCell) {
    Parameters p{100e6, 0.25, 1e3, 48, 16.5, {}, Ultimate{1e3, 36, 0, 0.02, 8e-3}};
    OnePoint scaled(p, 4e-3);
    p.ultimate->strain = 0.04, p.ultimate->length = 0;
    OnePoint plain(p, 4e-3);
    const Tensor stress = diagonal(-100e3, -600e3, -200e3), strain = diagonal(5e-3, -5e-3, 0);
    ASSERT_EQ(scaled.update(stress, strain), GAULT_OK);
    ASSERT_EQ(plain.update(stress, strain), GAULT_OK);
    EXPECT_GT(plain.batch.state[0][0], 1e-3);
    EXPECT_EQ(scaled.batch.state[0][0], plain.batch.state[0][0]);
    EXPECT_EQ(scaled.batch.stress_at(0), plain.batch.stress_at(0));
}

// Tresca's strength may fall by 3G dx at most where the plastic strain grows by dx: in shear tau = sqrt(3) G dx.
TEST(MohrCoulombSoftening, RefusesToSnapBack) {
    const double G = 5e6, drop = 30e3, limit = drop / (std::sqrt(3.0) * G); // 0.346 %
    const Parameters brittle{2.5 * G, 0.25, 50e3, 0, 0, {}, Ultimate{50e3 - drop, 0, 0, limit, 5e-3}};
    const Tensor at_yield{0, 0, 0, 50e3, 0, 0}, little{0, 0, 0, 1e-6, 0, 0}, much{0, 0, 0, 1e-2, 0, 0};
    OnePoint small(brittle, 0.99 * 5e-3), large(brittle, 1.01 * 5e-3);
    EXPECT_EQ(small.update(at_yield, little), GAULT_OK);
    EXPECT_EQ(small.update(at_yield, much), GAULT_OK);
    EXPECT_EQ(large.update(at_yield, little), GAULT_FAILED);
    EXPECT_NE(std::string(large.batch.error.text).find("snaps back"), std::string::npos);
    EXPECT_NE(std::string(large.batch.error.text).find("smaller cells"), std::string::npos);
    EXPECT_EQ(large.update(at_yield, much), GAULT_RETRY);
    EXPECT_EQ(large.update(at_yield, {0, 0, 0, -1e-6, 0, 0}), GAULT_OK) << "unloads";
}

TEST(MohrCoulombSoftening, BearsHugeAndMeaninglessIncrements) {
    for (const Parameters& p : softening_soils()) {
        OnePoint point(p);
        for (const double size : {0.0, 1e-300, 1e-12, 1.0, 1e6, 1e300, std::nan("")}) {
            const gault_status status =
                point.update(diagonal(-1e5, -2e5, -1e5), {size, -size, size / 2, size, 0, size});
            if (status != GAULT_OK || !(size < 1e7)) continue;
            for (double s : point.batch.stress_at(0))
                EXPECT_TRUE(std::isfinite(s)) << size;
        }
    }
}

TEST(MohrCoulombSoftening, SaysWhichParametersMakeNoSense) {
    const auto refused = [](plugin_test::Settings more) {
        plugin_test::Settings all = settings(Parameters{});
        for (const auto& [name, value] : more)
            all[name] = value;
        try {
            Model soil(all);
        } catch (const plugin_test::Invalid& e) {
            return e.parameter;
        }
        return std::string("none");
    };
    EXPECT_EQ(refused({{"softening_strain", 0.05}}), "softening_strain");
    EXPECT_EQ(refused({{"regularisation_length", 0.05}}), "regularisation_length");
    EXPECT_EQ(refused({{"ultimate_friction_angle", 0.6}}), "softening_strain");
    EXPECT_EQ(refused({{"ultimate_friction_angle", 1.0}, {"softening_strain", 0.05}}),
              "ultimate_friction_angle");
    EXPECT_EQ(refused({{"ultimate_cohesion", 2e3}, {"softening_strain", 0.05}}), "ultimate_cohesion");
    EXPECT_EQ(
        refused({{"ultimate_cohesion", 0.0}, {"ultimate_friction_angle", 0.0}, {"softening_strain", 0.05}}),
        "ultimate_cohesion");
    EXPECT_EQ(
        refused({{"poisson_ratio", 0.49}, {"ultimate_dilation_angle", -0.2}, {"softening_strain", 0.05}}),
        "ultimate_dilation_angle");
    EXPECT_EQ(refused({{"ultimate_cohesion", 0.0}, {"softening_strain", 0.05}}), "none");
}

} // namespace
