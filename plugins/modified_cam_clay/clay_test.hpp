// The clay of the tests, its closed forms, and random admissible states.
#pragma once
#include "laboratory.hpp"

#include <gtest/gtest.h>

#include <random>

namespace modified_cam_clay_test {
using namespace plugin_test;

constexpr double M = 1.2, lambda = 0.15, kappa = 0.03, nu = 0.278, Gamma = 2.74, p0 = 120e3;
constexpr double Lambda = 1.0 - kappa / lambda;
constexpr double g = 1.5 * (1.0 - 2.0 * nu) / (1.0 + nu); // G / K
constexpr double G = 4e6;                                 // where it is constant, Pa
enum State { preconsolidation, specific_volume, plastic_strain };

inline Settings settings(double R = 1.0) {
    return {{"critical_state_ratio", M}, {"compression_index", lambda},    {"swelling_index", kappa},
            {"poisson_ratio", nu},       {"critical_state_volume", Gamma}, {"overconsolidation_ratio", R}};
}
inline Settings rigid_settings(double R = 1.0) { // of a constant shear modulus
    Settings s = settings(R);
    s.erase("poisson_ratio");
    s["shear_modulus"] = G;
    return s;
}
inline Component clay(const Settings& s, const std::string& variant = "") {
    return {"modified_cam_clay", GAULT_MATERIAL, "modified_cam_clay", s, variant};
}
inline Tensor isotropic(double pressure) {
    return {-pressure, -pressure, -pressure, 0.0, 0.0, 0.0};
}

inline double mean_pressure(const Tensor& s) {
    return -(s[0] + s[1] + s[2]) / 3.0;
}
inline double inner(const Tensor& a, const Tensor& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 6; ++i)
        sum += (i < 3 ? 1.0 : 2.0) * a[i] * b[i];
    return sum;
}
inline Tensor deviator(Tensor t) {
    const double mean = (t[0] + t[1] + t[2]) / 3.0;
    for (std::size_t i = 0; i < 3; ++i)
        t[i] -= mean;
    return t;
}
inline double deviator_size(const Tensor& s) {
    return std::sqrt(1.5 * inner(deviator(s), deviator(s)));
}
// f, over the square of p'_c.
inline double yield(const Tensor& s, double size) {
    const double p = mean_pressure(s), q = deviator_size(s) / M;
    return (q * q + p * (p - size)) / (size * size);
}

// Integral of 4 t^2 / (1 - t^4): plastic shear of a normally consolidated clay from t = 0, but for a factor.
inline double shear_function(double t) {
    return std::log((1.0 + t) / (1.0 - t)) - 2.0 * std::atan(t);
}

class Random {
  public:
    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    double magnitude(double low, double high) { return std::pow(10.0, uniform(low, high)); }
    Tensor tensor(double size) {
        Tensor t;
        for (double& x : t)
            x = size * uniform(-1.0, 1.0);
        return t;
    }
    // Within or, every third, on an ellipse of 1 kPa to 10 MPa.
    void state(Batch& b, int64_t i) {
        const double size = magnitude(3.0, 7.0), p = size * uniform(0.01, 0.99);
        const double reach = i % 3 ? uniform(0.0, 1.0) : 1.0;
        Tensor s = deviator(tensor(1.0));
        const double scale = reach * M * std::sqrt(p * (size - p)) / deviator_size(s);
        for (std::size_t c = 0; c < 6; ++c)
            s[c] = scale * s[c] - (c < 3 ? p : 0.0);
        b.set_stress_old(i, s);
        b.state_old[preconsolidation][i] = size;
        b.state_old[specific_volume][i] = uniform(1.3, 4.0);
    }

  private:
    std::mt19937_64 engine_{11};
};

} // namespace modified_cam_clay_test
