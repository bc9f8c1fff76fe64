// Backbone, Masing's rules, memory, strength, and what follows for a pressuremeter.
#include "driver_test.hpp"

namespace {
using namespace small_strain_test;

// Shear stress after one step to each of these strains: elements on a straight path are integrated exactly.
std::vector<double> first_loading(const Parameters& p, const std::vector<double>& gamma) {
    const Component c = soil(p);
    Samples samples(c, std::vector<Tensor>(gamma.size(), isotropic(100e3)));
    std::vector<Tensor> strain;
    for (double g : gamma)
        strain.push_back(shear(g));
    samples.advance(strain);
    std::vector<double> tau;
    for (std::size_t i = 0; i < gamma.size(); ++i)
        tau.push_back(samples.stress(static_cast<int64_t>(i))[3]);
    return tau;
}
std::vector<double> logarithmic(double from, double to, int count) {
    std::vector<double> x;
    for (int i = 0; i <= count; ++i)
        x.push_back(from * std::pow(to / from, double(i) / count));
    return x;
}

// G_s/G_0 = 1/(1 + 0.385 gamma/gamma_07) from 1e-6 to 1e-2, or up to where its tangent is G_ur, and straight on.
TEST(SmallStrain, FollowsTheModifiedHyperbola) {
    for (const double share : {1.0 / 3.0, 0.1, 6.4e-4}) {
        const Parameters p = strong(share);
        const std::vector<double> gamma = logarithmic(1e-6, 1e-2, 4000), tau = first_loading(p, gamma);
        double most = 0.0, least = 0.0;
        for (std::size_t i = 0; i < gamma.size(); ++i) {
            const double off = tau[i] / p.backbone(gamma[i]) - 1.0;
            most = std::max(most, off), least = std::min(least, off);
        }
        EXPECT_LT(most, p.ripple());
        EXPECT_GT(least, -p.ripple());
        RecordProperty("largest_error_" + std::to_string(share), std::to_string(std::max(most, -least)));
        EXPECT_LT(p.ripple(), 0.01);
        const double least_strain = 1e-9;
        EXPECT_NEAR(first_loading(p, {least_strain})[0] / least_strain, p.G_0,
                    1e-5 * p.G_0); // 1e-16 of 100 kPa over it
    }
}

TEST(SmallStrain, HasLostAQuarterOfItsStiffnessAtTheReferenceStrain) {
    const Parameters p = strong(0.1);
    EXPECT_NEAR(first_loading(p, {p.gamma_07})[0] / (p.G_0 * p.gamma_07), 0.722, 1.1 * p.ripple());
}

// D = 4/pi (1 + 1/x)(1 - ln(1 + x)/x) - 2/pi, Masing's rules on a hyperbola. Areas and secant are off by a ripple each, so
// D + 2/pi = 4 area/(pi gamma tau) by two of D + 2/pi, which is at most 4/pi; a soil that is hardly strained does not damp
// before its first element slips.
TEST(SmallStrain, DampsAsMasingsRulesSay) {
    const Parameters p = strong(6.4e-4);
    for (const double x : {0.1, 0.3, 1.0, 3.0, 10.0, 30.0}) {
        const double gamma = x * p.unit();
        SimpleShear s(p);
        s.to(gamma);
        const double top = s.tau(), before = s.work();
        s.to(-gamma, 2000);
        s.to(gamma, 2000);
        const double damping = (s.work() - before) / (4.0 * M_PI * 0.5 * top * gamma);
        const double expected = 4.0 / M_PI * (1.0 + 1.0 / x) * (1.0 - std::log1p(x) / x) - 2.0 / M_PI;
        EXPECT_NEAR(damping, expected, 2.0 * p.ripple() * (expected + 2.0 / M_PI)) << x;
        RecordProperty("damping_" + std::to_string(x), std::to_string(damping - expected));
    }
}

// From wherever loading turns, stress changes by twice the backbone at half of the strain; to rounding.
TEST(SmallStrain, ClosesItsLoops) {
    const Parameters p = strong(0.1);
    for (const double gamma : {2e-5, 3e-4, 5e-3}) {
        SimpleShear s(p);
        s.to(gamma);
        const double top = s.tau();
        const std::vector<double> corner = s.states();
        const std::vector<double> half = logarithmic(1e-3 * gamma, gamma, 40),
                                  virgin = first_loading(p, half);
        for (std::size_t i = 0; i < half.size(); ++i) {
            s.to(gamma - 2.0 * half[i]);
            EXPECT_NEAR(s.tau(), top - 2.0 * virgin[i], 1e-11 * top) << gamma;
        }
        s.to(gamma, 7);
        EXPECT_NEAR(s.tau(), top, 1e-11 * top);
        const std::vector<double> back = s.states();
        for (std::size_t c = 0; c < corner.size(); ++c)
            EXPECT_NEAR(back[c], corner[c], 1e-10) << c;
    }
}

// A small cycle on the way leaves no trace: no stiffness is won by turning, no memory is lost.
TEST(SmallStrain, RemembersTheLargeCycleThroughSmallOnes) {
    const Parameters p = strong(0.1);
    SimpleShear straight(p), disturbed(p);
    straight.to(1e-3);
    straight.to(-5e-4);
    disturbed.to(1e-3);
    for (const double on_the_way : {8e-4, 3e-4, 1e-4, -2e-4}) {
        disturbed.to(on_the_way);
        for (int cycle = 0; cycle < 5; ++cycle) {
            disturbed.to(on_the_way + 4e-5);
            disturbed.to(on_the_way);
        }
    }
    disturbed.to(-5e-4);
    EXPECT_NEAR(disturbed.tau(), straight.tau(), 1e-10 * p.backbone(1e-3));
    const std::vector<double> a = straight.states(), b = disturbed.states();
    for (std::size_t c = 0; c < a.size(); ++c)
        EXPECT_NEAR(b[c], a[c], 1e-10);
}

// A soil at failure that turns is as stiff as a virgin one at half of the strain, whatever the strain at failure was.
TEST(SmallStrain, UnloadsFromFailureAsMasingsRulesSay) {
    const Parameters p = clay();
    SimpleShear s(p);
    s.to(2e-2, 10);
    EXPECT_NEAR(s.tau(), p.c, 1e-9 * p.c);
    const std::vector<double> half{1e-6, 1e-5, 1e-4, 5e-4}, virgin = first_loading(p, half);
    for (std::size_t i = 0; i < half.size(); ++i) {
        s.to(2e-2 - 2.0 * half[i]);
        EXPECT_NEAR(s.tau(), p.c - 2.0 * virgin[i], 1e-8 * p.c);
    }
}

// Undrained, around a cavity in an infinite soil, gamma falls with the square of the radius, so P = int tau/gamma dgamma
// (Palmer 1972) and, for a loop of the cavity strain A in the plastic zone, dP = 2 int tau/gamma dgamma up to gamma = A:
// G_ur = dP/2A = G_0 ln(1 + A/u)/(A/u), u = gamma_07/0.385. Here tau is what the soil answers as it turns from failure.
TEST(SmallStrain, GivesAPressuremeterModulusThatFallsWithTheAmplitudeOfItsLoop) {
    Parameters p = clay();
    p.G_ur = 0.01 * p.G_0, p.c = 23e3; // fails at gamma of 0.2 %, above all amplitudes
    const Component c = soil(p);
    double last = p.G_0;
    for (const double amplitude : {1e-4, 3e-4, 1e-3}) {
        const std::vector<double> change = logarithmic(1e-4 * amplitude, 2.0 * amplitude, 400);
        Samples samples(c, std::vector<Tensor>(change.size(), isotropic(100e3)));
        samples.advance(std::vector<Tensor>(change.size(), shear(5e-2)));
        std::vector<Tensor> back;
        for (double g : change)
            back.push_back(shear(-g));
        samples.advance(back);
        double pressure = p.G_0 * change[0]; // from 0 to the first point
        const double step = std::log(change[1] / change[0]);
        for (std::size_t i = 0; i + 1 < change.size(); ++i)
            pressure +=
                0.5 * step * (2.0 * p.c - samples.stress(int64_t(i))[3] - samples.stress(int64_t(i) + 1)[3]);
        const double modulus = pressure / (2.0 * amplitude), a = amplitude / p.unit();
        EXPECT_NEAR(modulus, p.G_0 * std::log1p(a) / a, 1.1 * p.ripple() * modulus);
        EXPECT_LT(modulus, 0.9 * last);
        last = modulus;
    }
}

TEST(SmallStrain, FailsInTriaxialCompressionWhereMohrCoulombDoes) {
    Parameters p;
    p.m = 0.5;
    const Component c = soil(p);
    Laboratory lab(c, isotropic(100e3));
    for (int step = 0; step < 200; ++step)
        lab.triaxial_drained(-1e-4, -100e3);
    const double ratio = (1.0 + std::sin(p.phi)) / (1.0 - std::sin(p.phi));
    const double expected = ratio * 100e3 + 2.0 * p.c * std::sqrt(ratio);
    EXPECT_NEAR(-lab.stress()[0], expected, 1e-8 * expected);
    const Tensor before = lab.strain();
    for (int step = 0; step < 10; ++step)
        lab.triaxial_drained(-1e-4, -100e3);
    const Tensor after = lab.strain(); // stress is constant: all strain is plastic, (1, 1, -2 mu) gamma
    const double mu = (1.0 - std::sin(p.psi)) / (1.0 + std::sin(p.psi));
    EXPECT_NEAR((after[1] - before[1] + after[2] - before[2]) / (before[0] - after[0]), 1.0 / mu, 1e-6);
}

TEST(SmallStrain, IsElasticInVolume) {
    const Parameters p;
    const Component c = soil(p);
    Samples samples(c, {isotropic(100e3)});
    samples.advance({{-1e-3, -1e-3, -1e-3, 0.0, 0.0, 0.0}});
    EXPECT_NEAR(-samples.stress()[0], 100e3 + 3e-3 * p.bulk(), 1e-3);
}

// (p + c cot phi)^m from the start; later only where the soil yields, so that no elastic cycle can win energy.
TEST(SmallStrain, IsStifferUnderPressure) {
    Parameters p;
    p.m = 0.5;
    const double a = p.c / std::tan(p.phi);
    const auto expected = [&](double mean) { return p.G_0 * std::sqrt((mean + a) / (p.p_ref + a)); };
    const Component c = soil(p);
    Samples samples(c, {isotropic(400e3)});
    samples.step({Tensor{}});
    EXPECT_NEAR(samples.batch.shear_modulus[0], expected(400e3), 1e-9 * p.G_0);
    samples.advance({{-1e-4, -1e-4, -1e-4, 0.0, 0.0, 0.0}});
    samples.step({Tensor{}});
    EXPECT_NEAR(samples.batch.shear_modulus[0], expected(400e3), 1e-9 * p.G_0);
    for (int i = 0; i < 40; ++i)
        samples.advance({shear(1e-3)}); // dilates, and may not: pressure grows
    samples.step({Tensor{}});
    const Tensor s = samples.stress();
    const double mean = -(s[0] + s[1] + s[2]) / 3.0;
    EXPECT_GT(mean, 600e3);
    EXPECT_NEAR(samples.batch.shear_modulus[0], expected(mean), 1e-9 * expected(mean));
}

// Work done on every sample along a random path in short steps: of backward Euler, which is not below the exact one.
struct Work {
    std::vector<double> done, most;
    std::vector<Tensor> strain;
    explicit Work(std::size_t count) : done(count, 0.0), most(count, 0.0), strain(count, Tensor{}) {}

    void move(Samples& samples, const std::vector<Tensor>& to, int steps) {
        std::vector<Tensor> part(to.size());
        for (std::size_t i = 0; i < to.size(); ++i) {
            part[i] = minus(to[i], strain[i]);
            for (double& e : part[i])
                e /= steps;
        }
        for (int n = 0; n < steps; ++n) {
            samples.advance(part);
            for (std::size_t i = 0; i < to.size(); ++i) {
                done[i] += dot(samples.stress(static_cast<int64_t>(i)), part[i]);
                most[i] = std::max(most[i], std::abs(done[i]));
            }
        }
        strain = to;
    }
    void wander(Samples& samples, Random& random, double from, double to) {
        std::vector<Tensor> target = strain;
        for (Tensor& e : target)
            e = minus(e, random.tensor(random.magnitude(from, to)));
        move(samples, target, 10);
    }
};

// Stored energy is least, 0, in a soil without stress and history: from there no strain path whatever gives work back.
TEST(SmallStrain, GivesBackNoMoreThanItWasGiven) {
    Random random;
    for (const Parameters& p : soils()) {
        if (p.m > 0.0) continue;
        const Component c = soil(p);
        Samples samples(c, std::vector<Tensor>(32, Tensor{}));
        Work work(32);
        for (int n = 0; n < 100; ++n) {
            work.wander(samples, random, -7.0, -3.0);
            for (std::size_t i = 0; i < work.done.size(); ++i)
                ASSERT_GE(work.done[i], -1e-9 * work.most[i]);
        }
    }
}

// Under pressure, and with a stiffness that depends on it: a closed strain path within the strength takes work.
TEST(SmallStrain, WinsNoEnergyFromCyclesWithinItsStrength) {
    Random random;
    for (const Parameters& p : soils()) {
        const Component c = soil(p);
        Samples samples(c, std::vector<Tensor>(32, isotropic(400e3)));
        Work work(32);
        for (int n = 0; n < 30; ++n) {
            work.wander(samples, random, -7.0, -4.5);
            work.move(samples, std::vector<Tensor>(32, Tensor{}), 10);
            for (std::size_t i = 0; i < work.done.size(); ++i) {
                ASSERT_EQ(samples.batch.state_old[plastic_strain][int64_t(i)], 0.0);
                ASSERT_GE(work.done[i], -1e-9 * work.most[i]);
            }
        }
    }
}

TEST(SmallStrain, RefusesWhatIsNotASoil) {
    const auto refused = [](const char* parameter, double value, Parameters p = {}) {
        Settings s = settings(p);
        s[parameter] = value;
        try {
            const Component c{"small_strain", GAULT_MATERIAL, "small_strain", s};
        } catch (const Invalid& e) {
            return e.parameter;
        }
        return std::string("nothing");
    };
    EXPECT_EQ(refused("unload_reload_shear_modulus", 100e6), "unload_reload_shear_modulus");
    EXPECT_EQ(refused("unload_reload_shear_modulus", 1e3), "unload_reload_shear_modulus");
    EXPECT_EQ(refused("dilation_angle", 41.0 * degree), "dilation_angle");
    EXPECT_EQ(refused("exponent", 0.5, clay()), "exponent");
    EXPECT_EQ(refused("cohesion", 0.0, clay()), "cohesion");
    const Component c = soil(Parameters{});
    EXPECT_THROW(Samples(c, {{-100e3, -100e3, -600e3, 0.0, 0.0, 0.0}}), std::runtime_error);
    EXPECT_THROW(Samples(c, {{5e3, 5e3, 5e3, 0.0, 0.0, 0.0}}), std::runtime_error);
}

} // namespace
