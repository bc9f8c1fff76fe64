// The law once more, for tests: one point, full 3 x 3 tensors, the textbook's formulas one after another, explicit
// Euler. It shares no line with the plugin.
#pragma once
#include <Eigen/Dense>

#include <cmath>

namespace plain {

using Matrix = Eigen::Matrix3d;

struct Sand { // Hochstetten sand (von Wolffersdorff 1996; Niemunis and Herle 1997)
    double phi_c = 33.0 * M_PI / 180.0, h_s = 1e9, n = 0.25;
    double e_d0 = 0.55, e_c0 = 0.95, e_i0 = 1.05, alpha = 0.25, beta = 1.0, p_t = 100.0;
    double R = 1e-4, m_R = 5.0, m_T = 2.0, beta_r = 0.5, chi = 6.0;
    bool remembers = false;
};

inline double dot(const Matrix& a, const Matrix& b) {
    return a.cwiseProduct(b).sum();
}
inline double bauer(const Sand& s, double pressure) {
    return std::exp(-std::pow(3.0 * pressure / s.h_s, s.n));
}
inline double f_d(const Sand& s, double e, double pressure) {
    const double b = bauer(s, pressure);
    return std::pow((e - s.e_d0 * b) / (s.e_c0 * b - s.e_d0 * b), s.alpha);
}
inline double a_of(const Sand& s) {
    return std::sqrt(3.0) * (3.0 - std::sin(s.phi_c)) / (2.0 * std::sqrt(2.0) * std::sin(s.phi_c));
}

struct Point {
    Matrix stress, memory = Matrix::Zero();
    double e;
};

struct Operators { // stress rate L:D + N |D| without memory
    Matrix t, t_dev;
    double f_s, F, a, f_d; // f_s includes 1 / tr(T^ T^)
    Matrix linear(const Matrix& d) const { return f_s * (F * F * d + a * a * dot(t, d) * t); }
    Matrix nonlinear() const { return f_s * f_d * a * F * (t + t_dev); }
    Matrix limit_direction() const { // L^-1 N
        const double square = dot(t, t);
        const Matrix sum = t + t_dev;
        return f_d * a / F * (sum - a * a * dot(t, sum) / (F * F + a * a * square) * t);
    }
};

inline Operators operators(const Sand& s, const Matrix& stress, double e) {
    Operators o;
    const Matrix shifted = stress - s.p_t * Matrix::Identity();
    const double p = -shifted.trace() / 3.0;
    o.t = shifted / shifted.trace();
    o.t_dev = o.t - Matrix::Identity() / 3.0;
    const double tan_psi = std::sqrt(3.0) * o.t_dev.norm();
    const double cube = std::pow(o.t_dev.squaredNorm(), 1.5);
    const double cos_3_theta =
        cube > 0.0 ? -std::sqrt(6.0) * (o.t_dev * o.t_dev * o.t_dev).trace() / cube : 1.0;
    o.F = std::sqrt(tan_psi * tan_psi / 8.0 +
                    (2.0 - tan_psi * tan_psi) / (2.0 + std::sqrt(2.0) * tan_psi * cos_3_theta)) -
          tan_psi / (2.0 * std::sqrt(2.0));
    o.a = a_of(s);
    o.f_d = f_d(s, e, p);
    const double b = bauer(s, p), e_i = s.e_i0 * b;
    const double loosest = std::pow((s.e_i0 - s.e_d0) / (s.e_c0 - s.e_d0), s.alpha);
    const double f_b = s.h_s / s.n * std::pow(s.e_i0 / s.e_c0, s.beta) * (1.0 + e_i) / e_i *
                       std::pow(3.0 * p / s.h_s, 1.0 - s.n) /
                       (3.0 + o.a * o.a - o.a * std::sqrt(3.0) * loosest);
    o.f_s = f_b * std::pow(s.e_c0 * b / e, s.beta) / dot(o.t, o.t);
    return o;
}

inline void euler(const Sand& s, Point& at, const Matrix& d) {
    const Operators o = operators(s, at.stress, at.e);
    Matrix stress_rate = o.linear(d) + o.nonlinear() * d.norm(), memory_rate = Matrix::Zero();
    if (s.remembers) {
        const double length = at.memory.norm(), rho = length / s.R;
        const Matrix h = length > 0.0 ? Matrix(at.memory / length) : Matrix(Matrix::Zero());
        const double along = dot(h, d), x = std::pow(rho, s.chi);
        stress_rate = (x * s.m_T + (1.0 - x) * s.m_R) * o.linear(d);
        memory_rate = d;
        if (along > 0.0) {
            stress_rate += x * (1.0 - s.m_T) * along * o.linear(h) + x * along * o.nonlinear();
            memory_rate -= h * along * std::pow(rho, s.beta_r);
        } else {
            stress_rate += x * (s.m_R - s.m_T) * along * o.linear(h);
        }
    }
    at.stress += stress_rate;
    at.memory += memory_rate;
    at.e += (1.0 + at.e) * d.trace();
}

} // namespace plain
