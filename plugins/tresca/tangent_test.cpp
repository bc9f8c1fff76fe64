#include "clay_test.hpp"

namespace {
using namespace tresca_test;

using Stiffness = std::array<double, 36>;

Stiffness tangent_at(const Component& c, const Tensor& trial) {
    Batch b(c, 1, true);
    b.set_strain(0, elastic_strain(trial));
    EXPECT_EQ(b.update(), GAULT_OK);
    Stiffness t;
    for (std::size_t e = 0; e < 36; ++e)
        t[e] = b.tangent[e][0];
    return t;
}
Stiffness differences(const Component& c, const Tensor& trial, double h) { // a unit of xy is xy and yx
    Batch b(c, 12);
    for (int k = 0; k < 12; ++k) {
        Tensor strain = elastic_strain(trial);
        strain[k / 2] += k % 2 ? -h : h;
        b.set_strain(k, strain);
    }
    EXPECT_EQ(b.update(), GAULT_OK);
    Stiffness t;
    for (int r = 0; r < 6; ++r)
        for (int j = 0; j < 6; ++j)
            t[6 * r + j] = (b.stress[r][2 * j] - b.stress[r][2 * j + 1]) / (2.0 * h);
    return t;
}

// Central differences over 1e-7 of strain, 2 Pa of stress, err by (2 Pa / difference of principal stresses)^2, below
// 1e-7, and by rounding, 1e-10 Pa / 1e-7 = 1e-3 Pa of 2e7. Trial states nearer than 5 kPa to another region are left
// out.
TEST(TrescaTangent, IsTheDerivativeOfTheUpdateInEveryRegion) {
    const Component c = clay();
    Random random;
    std::map<std::string, int> seen;
    for (int n = 0; n < 1500; ++n) {
        std::array<double, 3> t;
        for (double& x : t)
            x = 4.0 * strength * random.uniform(-1.0, 1.0);
        std::sort(t.begin(), t.end(), std::greater<>());
        const double middle = std::abs(t[1] - (t[0] + t[1] + t[2]) / 3.0), far = 0.1 * strength;
        if (std::min(t[0] - t[1], t[1] - t[2]) < far || std::abs(t[0] - t[2] - 2.0 * strength) < far ||
            std::abs(middle - 2.0 / 3.0 * strength) < far)
            continue;
        const Tensor trial = turned(diagonal(t[0], t[1], t[2]), random.rotation());
        const Stiffness found = tangent_at(c, trial), expected = differences(c, trial, 1e-7);
        for (int r = 0; r < 6; ++r)
            for (int j = 0; j < 6; ++j) {
                ASSERT_NEAR(found[6 * r + j], expected[6 * r + j], 1e-6 * (lame + 2.0 * shear));
                // Associated flow; a shear column counts twice.
                ASSERT_NEAR(found[6 * r + j] * (j < 3 ? 2.0 : 1.0), found[6 * j + r] * (r < 3 ? 2.0 : 1.0),
                            1e-6)
                    << r << ' ' << j;
            }
        Batch b(c, 1);
        b.set_strain(0, elastic_strain(trial));
        ASSERT_EQ(b.update(), GAULT_OK);
        ++seen[region(b.stress_at(0))];
    }
    for (const char* name : {"inside", "face", "edge s1 = s2", "edge s2 = s3"})
        EXPECT_GT(seen[name], 30) << name;
}

// Triaxial and isotropic states, where principal directions are not unique but the tangent is.
TEST(TrescaTangent, HasTheLimitAtCoincidentPrincipalStresses) {
    const Component c = clay();
    Random random;
    for (const Tensor& at : {diagonal(0.0, 0.0, -4.0 * strength), diagonal(4.0 * strength, 0.0, 0.0),
                             diagonal(-strength, -strength, -strength)})
        for (int n = 0; n < 20; ++n) {
            const Tensor trial = n ? turned(at, random.rotation()) : at;
            const Stiffness found = tangent_at(c, trial), expected = differences(c, trial, 1e-7);
            for (std::size_t e = 0; e < 36; ++e)
                ASSERT_NEAR(found[e], expected[e], 1e-6 * (lame + 2.0 * shear)) << n << ' ' << e;
        }
}

} // namespace
