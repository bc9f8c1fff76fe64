#include "driver_test.hpp"

#include <map>

namespace {
using namespace mohr_coulomb_test;

// Which region returned: told from the result, not by the plugin.
std::string region(const Parameters& p, const Principal& trial, const Principal& s) {
    const double close = 1e-9 * (1 + std::fabs(s[0]) + std::fabs(s[2]));
    const bool high = s[0] - s[1] < close, low = s[1] - s[2] < close;
    const bool tension = p.t && s[0] > *p.t - close, shear = p.shear_excess(s) > -close;
    if (p.excess(trial) <= 0) return "elastic";
    if (high && low) return "apex";
    if (tension && shear)
        return high ? "cut-off, s1 = s2 vertex" : low ? "cut-off, s2 = s3 vertex" : "cut-off line";
    if (tension) return high ? "cut-off edge" : "cut-off plane";
    return high ? "edge s1 = s2" : low ? "edge s2 = s3" : "plane";
}

using Tangent = std::array<double, 36>;

// Central differences with a unit of tensor shear: both xy and yx.
std::optional<Tangent> differences(const Model& model, const Tensor& stress, const Tensor& strain, double h,
                                   double tolerance) {
    Batch b;
    for (int c = 0; c < 6; ++c)
        for (const double sign : {1.0, -1.0}) {
            b.stress_old.push_back(stress);
            b.strain.push_back(strain);
            b.strain.back()[c] += sign * h;
        }
    model.update(b);
    const Tensor here = model.update(stress, strain);
    Tangent t{};
    for (int c = 0; c < 6; ++c)
        for (int r = 0; r < 6; ++r) {
            t[6 * r + c] = (b.stress[2 * c][r] - b.stress[2 * c + 1][r]) / (2 * h);
            const double one_sided = (b.stress[2 * c][r] - here[r]) / h;
            if (std::fabs(one_sided - t[6 * r + c]) > tolerance)
                return std::nullopt; // across the border of a region
        }
    return t;
}

// h = 1e-7 of strain moves the stress by some 10 Pa of 1e5: the central difference errs by the square of the
// ratio of h to the angle between principal directions, 1e-6 at worst, and by rounding, 1e-11 Pa / 1e-7 =
// 1e-4 Pa. Relative to the stiffness 1e-5 leaves room for both.
TEST(MohrCoulombTangent, IsTheDerivativeOfTheUpdateInEveryRegion) {
    const Parameters sand{}, cut{100e6, 0.25, 10e3, 30, 10, 5e3}, contracting{70e6, 0.3, 10e3, 40, -2},
        clay{13e6, 0.3, 50e3, 0, 0}, cut_clay{13e6, 0.3, 50e3, 0, 0, 10e3};
    std::map<std::string, int> seen;
    for (const Parameters& p : {sand, cut, contracting, clay, cut_clay}) {
        const Model model(p);
        Random random;
        for (int n = 0; n < 4000; ++n) {
            const double size = 20e3 + 5 * p.c;
            Principal s{random.uniform(-size, size), random.uniform(-size, size),
                        random.uniform(-size, size)};
            std::sort(s.begin(), s.end(), std::greater<>());
            if (s[0] - s[1] < 0.05 * size || s[1] - s[2] < 0.05 * size) continue;
            const Tensor stress = rotated(diagonal(s[0], s[1], s[2]), random.rotation());
            const double stiffness = p.lame() + 2 * p.G();
            const auto expected = differences(model, stress, Tensor{}, 1e-7, 1e-3 * stiffness);
            if (!expected) continue;
            Batch b{{stress}, {Tensor{}}, {}, {}, {}};
            model.update(b, true);
            const std::string name = region(p, s, principal(b.stress[0]));
            ++seen[name];
            for (int e = 0; e < 36; ++e)
                ASSERT_NEAR(b.tangent[0][e], (*expected)[e], 1e-5 * stiffness) << name << ", entry " << e;
        }
    }
    for (const char* name :
         {"elastic", "plane", "edge s1 = s2", "edge s2 = s3", "apex", "cut-off plane", "cut-off edge",
          "cut-off line", "cut-off, s1 = s2 vertex", "cut-off, s2 = s3 vertex"})
        EXPECT_GT(seen[name], 20) << name;
}

// Trial states with two equal principal stresses well inside a region, where the update is differentiable: on
// the edges, in front of the cut-off plane (s2 = s3) and of its edge (s1 = s2).
TEST(MohrCoulombTangent, HasTheLimitAtCoincidentPrincipalStresses) {
    const Parameters sand{}, cut{100e6, 0.25, 10e3, 30, 10, 5e3};
    struct Case {
        Parameters soil;
        Principal trial;
        const char* region;
    };
    const Case cases[] = {{sand, {-10e3, -10e3, -300e3}, "edge s1 = s2"},
                          {sand, {-10e3, -200e3, -200e3}, "edge s2 = s3"},
                          {sand, {20e3, 20e3, 20e3}, "apex"},
                          {cut, {9e3, -3e3, -3e3}, "cut-off plane"},
                          {cut, {9e3, 9e3, -3e3}, "cut-off edge"},
                          {cut, {12e3, 12e3, -25e3}, "cut-off, s1 = s2 vertex"},
                          {cut, {-90e3, -90e3, -90e3}, "elastic"}};
    Random random;
    for (const Case& c : cases)
        for (int n = 0; n < 50; ++n) {
            const Model model(c.soil);
            const Tensor stress = rotated(diagonal(c.trial[0], c.trial[1], c.trial[2]),
                                          n ? random.rotation() : Matrix{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
            const double stiffness = c.soil.lame() + 2 * c.soil.G();
            const auto expected = differences(model, stress, Tensor{}, 1e-7, 0.01 * stiffness);
            ASSERT_TRUE(expected) << c.region;
            Batch b{{stress}, {Tensor{}}, {}, {}, {}};
            model.update(b, true);
            ASSERT_EQ(region(c.soil, c.trial, principal(b.stress[0])), c.region);
            for (int e = 0; e < 36;
                 ++e) // first-order differences of a curved map: h times stiffness over stress, 1e-3
                ASSERT_NEAR(b.tangent[0][e], (*expected)[e], 2e-3 * stiffness) << c.region << ", entry " << e;
        }
}

TEST(MohrCoulombTangent, IsSymmetricOnlyIfTheFlowIsAssociated) {
    for (const double psi : {10.0, 30.0}) {
        const Model model({100e6, 0.2, 1e3, 30, psi});
        Batch b{{{-10e3, -40e3, -90e3, 5e3, 3e3, -2e3}}, {Tensor{}}, {}, {}, {}};
        model.update(b, true);
        double most = 0; // a unit of tensor shear is two of the work-conjugate one: shear columns count half
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j)
                most = std::max(most, std::fabs(b.tangent[0][6 * i + j] * (j < 3 ? 1 : 0.5) -
                                                b.tangent[0][6 * j + i] * (i < 3 ? 1 : 0.5)));
        if (psi == 30.0)
            EXPECT_LT(most, 1e-6);
        else
            EXPECT_GT(most, 1e6);
    }
}

} // namespace
