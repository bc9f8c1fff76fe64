#include "driver_test.hpp"

#include <gault/tensor.hpp>

namespace {
using namespace mohr_coulomb_test;

struct Decomposed {
    Principal value;
    Matrix vector;
};

Decomposed decompose(const Tensor& t, bool sort = false) {
    gault::SymmetricTensor packs;
    for (int c = 0; c < 6; ++c)
        packs[c] = t[c];
    gault::Spectral s = gault::spectral(packs);
    if (sort) gault::sort_descending(s);
    Decomposed d;
    for (int i = 0; i < 3; ++i) {
        d.value[i] = s.value[i][0];
        for (int k = 0; k < 3; ++k)
            d.vector[i][k] = s.vector[i][k][0];
    }
    return d;
}

// Every rotation rounds by some 3e-16 and five sweeps have fifteen: 4e-15 in sum, rarely reached.
constexpr double rounding = 4e-15;

void expect_decomposition(const Tensor& t) {
    const Decomposed d = decompose(t);
    const double size = norm(t);
    Principal sorted = d.value;
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    const Principal exact = principal(t);
    for (int i = 0; i < 3; ++i) {
        ASSERT_NEAR(sorted[i], exact[i], rounding * size);
        for (int j = 0; j < 3; ++j) {
            double product = 0, entry = 0;
            for (int k = 0; k < 3; ++k) {
                product += d.vector[i][k] * d.vector[j][k];
                entry += d.value[k] * d.vector[k][i] * d.vector[k][j];
            }
            ASSERT_NEAR(product, i == j ? 1.0 : 0.0, rounding);
            ASSERT_NEAR(entry, matrix(t)[i][j], rounding * size);
        }
    }
}

TEST(Tensor, DecomposesRandomTensors) {
    Random random;
    for (int n = 0; n < 20000; ++n)
        expect_decomposition(random.tensor(random.magnitude(-100, 100)));
}

TEST(Tensor, DecomposesTensorsWithCoincidentValues) {
    Random random;
    for (int n = 0; n < 20000; ++n) {
        const double gap = n % 3 ? random.magnitude(-18, -6) : 0.0,
                     other = n % 2 ? 1.0 : random.uniform(-1, 1);
        expect_decomposition(rotated(diagonal(1.0, 1.0 + gap, other), random.rotation()));
    }
}

TEST(Tensor, DecomposesTensorsOfHugeRatios) {
    Random random;
    for (int n = 0; n < 20000; ++n) {
        expect_decomposition(
            rotated(diagonal(1.0, random.magnitude(-18, 0), random.magnitude(-18, 0)), random.rotation()));
        Tensor t;
        for (double& x : t)
            x = random.uniform(-1, 1) * random.magnitude(-18, 0);
        expect_decomposition(t);
    }
}

TEST(Tensor, LeavesADiagonalTensorAsItIs) {
    for (const Tensor& t : {Tensor{}, diagonal(3, 3, 3), diagonal(1, -2, 5)}) {
        const Decomposed d = decompose(t);
        for (int i = 0; i < 3; ++i) {
            EXPECT_EQ(d.value[i], t[i]);
            for (int k = 0; k < 3; ++k)
                EXPECT_EQ(d.vector[i][k], i == k ? 1.0 : 0.0);
        }
    }
}

TEST(Tensor, SortsValuesWithTheirDirections) {
    Random random;
    for (int n = 0; n < 1000; ++n) {
        const Tensor t = random.tensor(1.0);
        const Decomposed d = decompose(t, true);
        ASSERT_GE(d.value[0], d.value[1]);
        ASSERT_GE(d.value[1], d.value[2]);
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) {
                double product = 0;
                for (int l = 0; l < 3; ++l)
                    product += matrix(t)[k][l] * d.vector[i][l];
                ASSERT_NEAR(product, d.value[i] * d.vector[i][k], rounding * norm(t));
            }
    }
}

} // namespace
