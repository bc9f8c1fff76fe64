// One clay, random points of it, and tensors to judge its answers by.
#pragma once
#include "laboratory.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <map>
#include <random>

namespace tresca_test {
using namespace plugin_test;
using Matrix = Eigen::Matrix3d;

constexpr double young_modulus = 15e6, poisson_ratio = 0.3, strength = 50e3; // Pa, 1, Pa
constexpr double shear = young_modulus / (2.0 * (1.0 + poisson_ratio));
constexpr double lame = 2.0 * shear * poisson_ratio / (1.0 - 2.0 * poisson_ratio);
constexpr int row[] = {0, 1, 2, 0, 1, 2}, column[] = {0, 1, 2, 1, 2, 0};

inline Component clay(const std::string& variant = "", double nu = poisson_ratio) {
    return {"tresca",
            GAULT_MATERIAL,
            "tresca",
            {{"young_modulus", young_modulus}, {"poisson_ratio", nu}, {"undrained_strength", strength}},
            variant};
}

inline Matrix matrix(const Tensor& t) {
    Matrix m;
    for (int i = 0; i < 6; ++i)
        m(row[i], column[i]) = m(column[i], row[i]) = t[i];
    return m;
}
inline Tensor tensor(const Matrix& m) {
    Tensor t;
    for (int i = 0; i < 6; ++i)
        t[i] = m(row[i], column[i]);
    return t;
}
inline Tensor diagonal(double x, double y, double z) {
    return {x, y, z, 0.0, 0.0, 0.0};
}
inline Tensor turned(const Tensor& t, const Matrix& q) {
    return tensor(q * matrix(t) * q.transpose());
}
inline std::array<double, 3> principal(const Tensor& t) { // descending
    const Eigen::Vector3d v = Eigen::SelfAdjointEigenSolver<Matrix>(matrix(t)).eigenvalues();
    return {v[2], v[1], v[0]};
}
inline double excess(const Tensor& t) { // beyond the strength, Pa
    const auto s = principal(t);
    return s[0] - s[2] - 2.0 * strength;
}
inline double product(const Tensor& a, const Tensor& b) {
    return (matrix(a) * matrix(b)).trace();
}
inline Tensor minus(Tensor a, const Tensor& b) {
    for (int i = 0; i < 6; ++i)
        a[i] -= b[i];
    return a;
}
inline double size(const Tensor& t) {
    return std::sqrt(product(t, t));
}
inline Tensor elastic_strain(const Tensor& stress) {
    Tensor e;
    for (int i = 0; i < 6; ++i)
        e[i] = (1.0 + poisson_ratio) / young_modulus * stress[i] -
               (i < 3 ? poisson_ratio / young_modulus * (stress[0] + stress[1] + stress[2]) : 0.0);
    return e;
}

struct Random {
    std::mt19937_64 engine{7};
    double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine); }
    Tensor tensor(double most) {
        Tensor t;
        for (double& x : t)
            x = most * uniform(-1.0, 1.0);
        return t;
    }
    Matrix rotation() {
        std::normal_distribution<double> normal;
        const double w = normal(engine), x = normal(engine), y = normal(engine), z = normal(engine);
        return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
    }
};

// Random states within the strength, at a mean stress of up to ten times it, and random strains of 1e-4 to 1e-1.
// Every third point has neither yz nor zx.
inline void fill_at_random(Batch& b) {
    Random random;
    for (int64_t i = 0; i < b.count(); ++i) {
        Tensor strain = random.tensor(std::pow(10.0, random.uniform(-4.0, -1.0)));
        Tensor stress = random.tensor(0.4 * strength); // their largest difference is below 2 s_u
        const double mean = 10.0 * strength * random.uniform(-1.0, 1.0);
        for (int c = 0; c < 3; ++c)
            stress[c] += mean;
        if (i % 3 == 0) strain[4] = strain[5] = stress[4] = stress[5] = 0.0;
        const double factor = std::min(1.0, 2.0 * strength / (excess(stress) + 2.0 * strength));
        for (int c = 0; c < 6; ++c)
            stress[c] = factor * (stress[c] - (c < 3 ? mean : 0.0)) + (c < 3 ? mean : 0.0);
        b.set_strain(i, strain);
        b.set_stress_old(i, stress);
    }
}
inline Tensor strain_of(const Batch& b, int64_t i) {
    Tensor t;
    for (int c = 0; c < 6; ++c)
        t[c] = b.strain[c][i];
    return t;
}
inline Tensor old_of(const Batch& b, int64_t i) {
    Tensor t;
    for (int c = 0; c < 6; ++c)
        t[c] = b.stress_old[c][i];
    return t;
}

// Which part of the hexagon a stress lies on.
inline std::string region(const Tensor& stress) {
    const auto s = principal(stress);
    const double close = 1e-9 * (strength + size(stress));
    if (excess(stress) < -close) return "inside";
    return s[0] - s[1] < close ? "edge s1 = s2" : s[1] - s[2] < close ? "edge s2 = s3" : "face";
}

} // namespace tresca_test
