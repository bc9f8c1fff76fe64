// The step: admissible, convergent, objective, differentiated, the same everywhere.
#include "driver_test.hpp"

#include <limits>

namespace {
using namespace small_strain_test;

constexpr std::size_t count = 64;

std::vector<Tensor> random_start(const Parameters& p, Random& random) {
    std::vector<Tensor> stress;
    while (stress.size() < count) {
        Tensor s = isotropic(random.magnitude(3.0, 6.0));
        for (std::size_t i = 0; i < 3; ++i)
            s[i] *= random.uniform(0.6, 1.0);
        if (p.excess(s) < 0.0) stress.push_back(s);
    }
    return stress;
}
// Half of them nearly without change of volume, so that not all is apex or elastic.
Tensor random_strain(Random& random, double from = -9.0, double to = -2.0) {
    Tensor e = random.tensor(random.magnitude(from, to));
    const double keep = random.uniform(0.0, 1.0) < 0.5 ? 0.95 * (e[0] + e[1] + e[2]) / 3.0 : 0.0;
    for (std::size_t i = 0; i < 3; ++i)
        e[i] -= keep;
    return e;
}
std::vector<Tensor> random_strains(Random& random) {
    std::vector<Tensor> strain;
    for (std::size_t i = 0; i < count; ++i)
        strain.push_back(random_strain(random));
    return strain;
}

TEST(SmallStrainReturn, StaysWithinItsStrengthAndItsBounds) {
    for (const Parameters& p : soils()) {
        Random random;
        const Component c = soil(p);
        Samples samples(c, random_start(p, random));
        int yielded = 0;
        for (int n = 0; n < 150; ++n) {
            samples.step(random_strains(random));
            for (int64_t i = 0; i < int64_t(count); ++i) {
                const Tensor s = samples.batch.stress_at(i);
                ASSERT_LE(p.excess(s), 1e-12 * norm(s) + 1e-9) << p.phi; // rounding of the composed stress
                for (std::size_t k = 0; k < element_components; ++k)
                    ASSERT_LE(std::abs(samples.batch.state[k][i]), 1.0);
                ASSERT_GE(samples.batch.state[stiffness_ratio][i], 0.01);
                ASSERT_GE(samples.batch.state[lost_stiffness][i], 0.0);
                ASSERT_LE(samples.batch.state[lost_stiffness][i], 1.0);
                ASSERT_GE(samples.batch.state[plastic_strain][i], samples.batch.state_old[plastic_strain][i]);
                yielded +=
                    samples.batch.state[plastic_strain][i] > samples.batch.state_old[plastic_strain][i];
            }
            samples.batch.advance();
        }
        EXPECT_GT(yielded, 500);
    }
}

TEST(SmallStrainReturn, KeepsAStateThatIsNotStrained) {
    for (const Parameters& p : soils()) {
        Random random;
        const Component c = soil(p);
        Samples samples(c, random_start(p, random));
        for (int n = 0; n < 40; ++n)
            samples.advance(random_strains(random));
        samples.step(std::vector<Tensor>(count, Tensor{}));
        // Rounding of the stress, 1e-9 Pa of 10 MPa, is 5e-18 of strain, and the least yield strain is 2e-8.
        for (int64_t i = 0; i < int64_t(count); ++i) {
            EXPECT_LE(norm(minus(samples.batch.stress_at(i), samples.stress(i))),
                      1e-11 * norm(samples.stress(i)) + 1e-8);
            for (std::size_t k = 0; k < element_components; ++k)
                EXPECT_NEAR(samples.batch.state[k][i], samples.batch.state_old[k][i], 2e-9);
        }
    }
}

// A path that turns, yields and unloads; against 64 times as many steps. Backward Euler is of first order.
TEST(SmallStrainReturn, ConvergesWithTheLengthOfTheStep) {
    Parameters p;
    p.m = 0.5;
    const Component c = soil(p);
    const auto end = [&](int steps) {
        Samples samples(c, {isotropic(100e3)});
        const auto at = [](double t) -> Tensor {
            return {-2e-3 * t, 1e-3 * std::sin(4.0 * t),        1e-3 * t * t, 2e-3 * std::sin(6.0 * t),
                    1e-3 * t,  5e-4 * (1.0 - std::cos(5.0 * t))};
        };
        for (int i = 0; i < steps; ++i)
            samples.advance({minus(at(double(i + 1) / steps), at(double(i) / steps))});
        return samples.stress();
    };
    const Tensor exact = end(20480);
    std::vector<double> error;
    for (const int steps : {40, 80, 160, 320})
        error.push_back(norm(minus(end(steps), exact)) / norm(exact));
    EXPECT_LT(error[0], 0.05);
    EXPECT_GT(std::log2(error[0] / error[3]) / 3.0, 0.9);
    RecordProperty("order", std::to_string(std::log2(error[0] / error[3]) / 3.0));
    RecordProperty("error_40", std::to_string(error[0]));
}

TEST(SmallStrainReturn, DoesNotDependOnTheFrame) {
    for (const Parameters& p : soils()) {
        Random random;
        const Component c = soil(p);
        std::vector<Tensor> start = random_start(p, random), turned = start;
        std::vector<Eigen::Matrix3d> q;
        for (std::size_t i = 0; i < count; ++i) {
            q.push_back(random.rotation());
            turned[i] = rotated(start[i], q[i]);
        }
        Samples a(c, start), b(c, turned);
        for (int n = 0; n < 40; ++n) {
            std::vector<Tensor> strain = random_strains(random), same = strain;
            for (std::size_t i = 0; i < count; ++i)
                same[i] = rotated(strain[i], q[i]);
            a.advance(strain);
            b.advance(same);
        }
        for (int64_t i = 0; i < int64_t(count);
             ++i) // rounding, amplified by stiffness at every one of 40 steps
            EXPECT_LE(norm(minus(rotated(a.stress(i), q[std::size_t(i)]), b.stress(i))),
                      1e-9 * norm(a.stress(i)) + 1e-4);
    }
}

using Tangent = Eigen::Matrix<double, 6, 6>;
Tangent tangent_of(const Batch& b, int64_t i) {
    Tangent t;
    for (int e = 0; e < 36; ++e)
        t(e / 6, e % 6) = b.tangent[static_cast<std::size_t>(e)][i];
    return t;
}

// Stress after a strain that is shifted in one component.
Columns shifted(Samples& samples, std::vector<Tensor> strain, std::size_t column, double by) {
    for (Tensor& e : strain)
        e[column] += by;
    samples.step(strain);
    return samples.batch.stress;
}

// h = 1e-9 of strain: central differences of a map that bends within some 1e-5 of strain err by (1e-9/1e-5)^2, and by
// rounding, 1e-10 Pa / 1e-9 = 0.1 Pa, of 1e8.
TEST(SmallStrainReturn, HasTheTangentOfItsStep) {
    constexpr double h = 1e-9;
    int compared = 0, yielding = 0;
    for (const Parameters& p : soils()) {
        Random random;
        const Component c = soil(p);
        Samples samples(c, random_start(p, random), true);
        for (int n = 0; n < 25; ++n) {
            std::vector<Tensor> strain;
            for (std::size_t i = 0; i < count; ++i)
                strain.push_back(random_strain(random, -5.0, -3.0));
            samples.step(strain);
            const Columns here = samples.batch.stress;
            std::vector<Tangent> t;
            std::vector<double> stiffness, flow;
            for (int64_t i = 0; i < int64_t(count); ++i) {
                t.push_back(tangent_of(samples.batch, i));
                stiffness.push_back(samples.batch.modulus[i]);
                flow.push_back(samples.batch.state[plastic_strain][i] -
                               samples.batch.state_old[plastic_strain][i]);
            }
            for (std::size_t column = 0; column < 6; ++column) {
                const Columns forward = shifted(samples, strain, column, h);
                const Columns backward = shifted(samples, strain, column, -h);
                for (int64_t i = 0; i < int64_t(count); ++i) {
                    double bend = 0.0, off = 0.0;
                    for (std::size_t r = 0; r < 6; ++r) {
                        const double up = forward[r][i] - here[r][i], down = here[r][i] - backward[r][i];
                        bend = std::max(bend, std::abs(up - down) / h);
                        off = std::max(
                            off, std::abs(0.5 * (up + down) / h - t[std::size_t(i)](int(r), int(column))));
                    }
                    // Where they differ, an element or the strength begins to yield in between.
                    if (bend > 2e-5 * stiffness[std::size_t(i)]) continue;
                    ++compared;
                    yielding += flow[std::size_t(i)] > 0.0;
                    ASSERT_LE(off, 1e-5 * stiffness[std::size_t(i)]) << p.phi << ' ' << p.m << ' ' << i;
                }
            }
            samples.step(strain);
            samples.batch.advance();
        }
    }
    EXPECT_GT(compared, 50000);
    EXPECT_GT(yielding, 10000);
}

// The largest eigenvalue of the acoustic tensor, over random directions, of points that do not flow: where they do, an
// unsymmetric tangent may have a larger one.
TEST(SmallStrainReturn, KeepsItsWavesBelowItsModulus) {
    constexpr int index[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    for (const Parameters& p : soils()) {
        Random random;
        const Component c = soil(p);
        Samples samples(c, random_start(p, random), true);
        for (int n = 0; n < 20; ++n) {
            samples.step(random_strains(random));
            for (int64_t i = 0; i < int64_t(count); ++i) {
                if (samples.batch.state[plastic_strain][i] > samples.batch.state_old[plastic_strain][i])
                    continue;
                const Tangent t = tangent_of(samples.batch, i);
                const Eigen::Vector3d d = random.rotation().col(0);
                Eigen::Matrix3d acoustic = Eigen::Matrix3d::Zero();
                for (int a = 0; a < 3; ++a)
                    for (int b = 0; b < 3; ++b)
                        for (int k = 0; k < 3; ++k)
                            for (int l = 0; l < 3; ++l)
                                acoustic(a, b) +=
                                    d[k] * d[l] * t(index[a][k], index[b][l]) * (b == l ? 1.0 : 0.5);
                const double fastest = acoustic.eigenvalues().real().maxCoeff();
                ASSERT_LE(fastest, (1.0 + 1e-9) * samples.batch.modulus[i]);
            }
            samples.batch.advance();
        }
    }
}

TEST(SmallStrainReturn, AnswersEveryIncrement) {
    for (const Parameters& p : soils()) {
        const Component c = soil(p);
        for (const double size : {1e-300, 1e-30, 1e-3, 1.0, 1e3, 1e30, 1e300}) {
            Samples samples(c, {isotropic(100e3)});
            samples.batch.set_strain(0, {-size, 0.3 * size, 0.1 * size, size, -0.7 * size, 0.2 * size});
            const gault_status status = samples.batch.update();
            ASSERT_TRUE(status == GAULT_OK || (size > 0.1 && status == GAULT_RETRY)) << size;
            ASSERT_TRUE(status != GAULT_OK || std::isfinite(norm(samples.batch.stress_at(0))));
        }
        Samples samples(c, {isotropic(100e3)});
        samples.batch.set_strain(0, {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0, 0.0, 0.0, 0.0});
        EXPECT_EQ(samples.batch.update(), GAULT_FAILED);
    }
}

// Whatever the instruction set and the neighbours: the same bits.
TEST(SmallStrainReturn, GivesTheSameBitsOnEveryProcessor) {
    for (const Parameters& p : soils()) {
        std::vector<Columns> first;
        std::vector<std::string> all = variants();
        for (const std::string& variant : all) {
            const Component c = soil(p, variant);
            for (const bool reversed : {false, true}) {
                Random random;
                std::vector<Tensor> start = random_start(p, random);
                if (reversed) std::reverse(start.begin(), start.end());
                Samples samples(c, start, true);
                for (int n = 0; n < 20; ++n) {
                    std::vector<Tensor> strain = random_strains(random);
                    if (reversed) std::reverse(strain.begin(), strain.end());
                    samples.advance(strain);
                }
                if (first.empty()) first = {samples.batch.stress, samples.batch.state, samples.batch.tangent};
                const Columns* found[] = {&samples.batch.stress, &samples.batch.state,
                                          &samples.batch.tangent};
                for (std::size_t which = 0; which < 3; ++which)
                    for (std::size_t k = 0; k < first[which].size(); ++k)
                        for (int64_t i = 0; i < int64_t(count); ++i)
                            ASSERT_EQ((*found[which])[k][reversed ? int64_t(count) - 1 - i : i],
                                      first[which][k][i])
                                << variant << reversed;
            }
        }
    }
}

} // namespace
