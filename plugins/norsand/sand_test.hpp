// The sands of the tests, and NorSand written a second time: one point, tiny explicit steps, plain doubles.
#pragma once
#include "laboratory.hpp"

#include <gtest/gtest.h>

#include <random>

namespace norsand_test {
using namespace plugin_test;

struct Soil { // of Erksak 330/0.7 sand about, unless said otherwise
    double gamma = 0.816, lambda = 0.0135, M = 1.26, N = 0.35, chi = 4.0, H = 70.0, slope = 340.0;
    double shear = 52e6, power = 0.5, reference = 100e3, nu = 0.2, psi = -0.15;
    double softening = 0.0, cap = 0.0, overconsolidation = 1.0;

    Settings settings() const {
        return {{"critical_state_void_ratio", gamma},
                {"critical_state_slope", lambda},
                {"critical_state_ratio", M},
                {"volumetric_coupling", N},
                {"dilatancy_coefficient", chi},
                {"hardening_modulus", H},
                {"hardening_slope", slope},
                {"shear_modulus", shear},
                {"shear_exponent", power},
                {"reference_pressure", reference},
                {"poisson_ratio", nu},
                {"state_parameter", psi},
                {"undrained_softening", softening},
                {"internal_cap", cap},
                {"overconsolidation_ratio", overconsolidation}};
    }
    Component component(const std::string& variant = "") const {
        return {"norsand", GAULT_MATERIAL, "norsand", settings(), variant};
    }
    double g() const { return 1.5 * (1.0 - 2.0 * nu) / (1.0 + nu); } // G / K
    double G(double p) const { return shear * std::pow(p / reference, power); }
    double chi_i() const { return chi / (1.0 - chi * lambda / M); }
    double state(double e, double p) const { return e - gamma + lambda * std::log(p / 1e3); }
    double friction(double theta) const { return M - M * M / (3.0 + M) * std::cos(1.5 * theta + M_PI / 4.0); }
};

enum State { void_ratio, image_pressure, plastic_strain, state_parameter };

inline Tensor isotropic(double pressure) {
    return {-pressure, -pressure, -pressure, 0.0, 0.0, 0.0};
}
inline double mean_pressure(const Tensor& s) {
    return -(s[0] + s[1] + s[2]) / 3.0;
}
inline Tensor deviator(Tensor t) {
    const double mean = (t[0] + t[1] + t[2]) / 3.0;
    for (std::size_t i = 0; i < 3; ++i)
        t[i] -= mean;
    return t;
}
inline double deviator_size(const Tensor& t) {
    const Tensor s = deviator(t);
    double sum = 0.0;
    for (std::size_t i = 0; i < 6; ++i)
        sum += (i < 3 ? 1.5 : 3.0) * s[i] * s[i];
    return std::sqrt(sum);
}
inline double lode_angle(const Tensor& t) { // 30 deg in triaxial compression
    const Tensor s = deviator(t);
    const double q = deviator_size(t);
    const double det = s[0] * (s[1] * s[2] - s[4] * s[4]) - s[3] * (s[3] * s[2] - s[4] * s[5]) +
                       s[5] * (s[3] * s[4] - s[1] * s[5]);
    return q == 0.0 ? 0.0 : std::asin(std::max(-1.0, std::min(1.0, -13.5 * det / (q * q * q)))) / 3.0;
}

// Explicit steps so short that neither their length nor the linearised yield condition matters.
class Plain {
  public:
    Plain(const Soil& soil, const Tensor& stress)
        : soil_(soil), stress_(stress),
          e_(soil.gamma - soil.lambda * std::log(mean_pressure(stress) / 1e3) + soil.psi),
          image_(mean_pressure(stress) * std::exp(-1.0)) {} // isotropic: at the tip

    void strain(const Tensor& increment, int steps) {
        Tensor part = increment;
        for (double& x : part)
            x /= steps;
        for (int i = 0; i < steps; ++i)
            step(part);
    }
    const Tensor& stress() const { return stress_; }
    double void_ratio() const { return e_; }
    double image() const { return image_; }

  private:
    void step(const Tensor& de) {
        const double p_old = mean_pressure(stress_), volumetric = -(de[0] + de[1] + de[2]);
        const double G = soil_.G(p_old), K = G / soil_.g();
        const Tensor shear = deviator(de);
        double p = p_old + K * volumetric;
        Tensor s = deviator(stress_);
        for (std::size_t i = 0; i < 6; ++i)
            s[i] += 2.0 * G * shear[i];
        e_ -= (1.0 + e_) * volumetric;

        const double q = deviator_size(s), psi = soil_.state(e_, p), psi_i = soil_.state(e_, image_);
        const double friction = soil_.friction(lode_angle(s)),
                     at_image = soil_.M - soil_.N * soil_.chi_i() * std::abs(psi_i);
        const double m = friction * at_image / soil_.M, x = std::log(image_ / p), D = -m * x;
        const double excess = q - m * p * (1.0 + x);
        if (excess > 0.0) {
            const double dilatancy = soil_.chi_i() * psi_i, limit = std::exp(-dilatancy / at_image);
            double h = std::max(1.0, soil_.H - soil_.slope * psi) * friction / soil_.M * std::exp(-2.0 * x) *
                       (limit - std::exp(x));
            if (soil_.softening > 0.0 && D > 0.0 && psi > 0.0)
                h -= (1.0 - soil_.chi * soil_.lambda / soil_.M) * D * (m * (1.0 + x)) /
                     (friction / soil_.M * (at_image - dilatancy)) * K / p;
            const double turn =
                -(psi_i > 0.0 ? 1.0 : -1.0) * soil_.N * soil_.chi_i() * soil_.lambda / at_image;
            const double multiplier = excess / (3.0 * G + K * D * D + m * p * h * (1.0 + turn * (1.0 + x)));
            image_ *= std::exp(h * multiplier);
            p -= K * D * multiplier;
            for (double& component : s)
                component *= 1.0 - 3.0 * G * multiplier / q;
        }
        for (std::size_t i = 0; i < 6; ++i)
            stress_[i] = s[i] - (i < 3 ? p : 0.0);
    }

    Soil soil_;
    Tensor stress_;
    double e_, image_;
};

} // namespace norsand_test
