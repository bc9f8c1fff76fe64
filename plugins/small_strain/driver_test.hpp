// The soils of the tests, one point on a strain path, and the closed forms that they are judged by.
#pragma once
#include "laboratory.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <random>

namespace small_strain_test {
using namespace plugin_test;

struct Parameters { // Pa, 1, rad
    double G_0 = 100e6, G_ur = 33e6, gamma_07 = 1e-4, nu = 0.2, p_ref = 100e3, m = 0.0;
    double c = 1e3, phi = 40.0 * degree, psi = 10.0 * degree;

    double unit() const { return gamma_07 / 0.385; } // strain of x = 1
    double bulk() const { return 2.0 * G_0 * (1.0 + nu) / (3.0 * (1.0 - 2.0 * nu)); }
    double cut_off() const { return std::sqrt(G_0 / G_ur) - 1.0; } // x where the tangent modulus is G_ur
    // The modified hyperbola, and beyond its cut-off the straight line with slope G_ur: shear stress, Pa.
    double backbone(double gamma) const {
        const double x = gamma / unit(), end = std::min(x, cut_off());
        return G_0 * unit() * end / (1.0 + end) + G_ur * (x - end) * unit();
    }
    // The error of the polyline of ten elements. A polyline of equal ripple e on a curve tau turns by
    // dx sqrt(|tau''| / 2 tau)/2 = sqrt(2 e) between corners; on x/(1 + x) the integral is atan(sqrt x).
    double ripple() const { return 0.5 * std::pow(std::atan(std::sqrt(cut_off())) / 10.0, 2); }
    double excess(const Tensor& s) const; // > 0: beyond the strength, Pa
};

inline Parameters clay() { // undrained, no failure below 80 kPa
    Parameters p;
    p.nu = 0.49, p.c = 80e3, p.phi = 0.0, p.psi = 0.0;
    return p;
}
inline Parameters strong(double least_share) { // does not fail
    Parameters p = clay();
    p.c = 1e9, p.G_ur = least_share * p.G_0;
    return p;
}
inline std::vector<Parameters> soils() {
    Parameters dense, dry = dense, loose, associated, hardly, wide = dense;
    dense.m = 0.5;
    dry.c = 0.0, dry.m = 0.6, dry.phi = 33.0 * degree, dry.psi = 0.0,
    dry.G_ur = 10e6; // no cohesion, no dilation
    associated.psi = associated.phi = 30.0 * degree;
    hardly.G_ur = 95e6; // hardly degrades
    wide.m = 0.9, wide.G_ur = 1e6;
    return {loose, dense, dry, associated, hardly, wide, clay()};
}

inline Settings settings(const Parameters& p) {
    return {{"initial_shear_modulus", p.G_0},
            {"unload_reload_shear_modulus", p.G_ur},
            {"reference_shear_strain", p.gamma_07},
            {"poisson_ratio", p.nu},
            {"reference_pressure", p.p_ref},
            {"exponent", p.m},
            {"cohesion", p.c},
            {"friction_angle", p.phi},
            {"dilation_angle", p.psi}};
}
inline Component soil(const Parameters& p, const std::string& variant = "") {
    return {"small_strain", GAULT_MATERIAL, "small_strain", settings(p), variant};
}

constexpr int element_components = 60, stiffness_ratio = 60, lost_stiffness = 61, plastic_strain = 62;

inline double dot(const Tensor& a, const Tensor& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}
inline double norm(const Tensor& a) {
    return std::sqrt(dot(a, a));
}
inline Tensor minus(Tensor a, const Tensor& b) {
    for (std::size_t i = 0; i < 6; ++i)
        a[i] -= b[i];
    return a;
}
inline Eigen::Matrix3d matrix(const Tensor& t) {
    Eigen::Matrix3d m;
    m << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
    return m;
}
inline Tensor rotated(const Tensor& t, const Eigen::Matrix3d& q) {
    const Eigen::Matrix3d m = q * matrix(t) * q.transpose();
    return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(2, 0)};
}
inline double Parameters::excess(const Tensor& s) const {
    const Eigen::Vector3d v = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix(s)).eigenvalues();
    return (v[2] - v[0]) + (v[2] + v[0]) * std::sin(phi) - 2.0 * c * std::cos(phi);
}

struct Random {
    std::mt19937_64 engine{20240229};
    double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine); }
    double magnitude(double a, double b) { return std::pow(10.0, uniform(a, b)); }
    Tensor tensor(double size) {
        Tensor t;
        for (double& x : t)
            x = size * uniform(-1.0, 1.0);
        return t;
    }
    Eigen::Matrix3d rotation() {
        std::normal_distribution<double> n;
        return Eigen::Quaterniond(n(engine), n(engine), n(engine), n(engine)).normalized().toRotationMatrix();
    }
};

// Many points that start from the same or from different stresses and are strained step by step.
class Samples {
  public:
    Samples(const Component& c, const std::vector<Tensor>& stress, bool with_tangent = false)
        : batch(c, static_cast<int64_t>(stress.size()), with_tangent) {
        for (std::size_t i = 0; i < (stress.size() + 7) / 8 * 8; ++i)
            batch.set_stress_old(static_cast<int64_t>(i), stress[std::min(i, stress.size() - 1)]);
        if (batch.start() != GAULT_OK) throw std::runtime_error(batch.error.text);
    }
    void step(const std::vector<Tensor>& strain) {
        for (std::size_t i = 0; i < (strain.size() + 7) / 8 * 8; ++i)
            batch.set_strain(static_cast<int64_t>(i), strain[std::min(i, strain.size() - 1)]);
        if (batch.update() != GAULT_OK) throw std::runtime_error("the step was refused");
    }
    void advance(const std::vector<Tensor>& strain) {
        step(strain);
        batch.advance();
    }
    Tensor stress(int64_t i = 0) const {
        Tensor t;
        for (std::size_t c = 0; c < 6; ++c)
            t[c] = batch.stress_old[c][i];
        return t;
    }
    Batch batch;
};

inline Tensor shear(double gamma) {
    return {0.0, 0.0, 0.0, 0.5 * gamma, 0.0, 0.0};
}
inline Tensor isotropic(double p) { // compression positive
    return {-p, -p, -p, 0.0, 0.0, 0.0};
}

// Simple shear of one point, by steps of the engineering strain gamma.
class SimpleShear {
  public:
    explicit SimpleShear(const Parameters& p) : soil_(soil(p)), samples_(soil_, {isotropic(100e3)}) {}
    void to(double gamma, int steps = 1) {
        const double by = (gamma - gamma_) / steps;
        for (int i = 0; i < steps; ++i) {
            const double before = tau();
            samples_.advance({shear(by)});
            work_ += 0.5 * (before + tau()) * by;
        }
        gamma_ = gamma;
    }
    double tau() const { return samples_.stress()[3]; }
    double work() const { return work_; } // by the trapezoidal rule
    std::vector<double> states() const {
        std::vector<double> s;
        for (int c = 0; c < element_components; ++c)
            s.push_back(samples_.batch.state_old[static_cast<std::size_t>(c)][0]);
        return s;
    }

  private:
    Component soil_;
    Samples samples_;
    double gamma_ = 0.0, work_ = 0.0;
};

} // namespace small_strain_test
