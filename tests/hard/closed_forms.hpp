// Exact pressures of cavities, compression positive, SI.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

namespace gault::core::test {

// An infinite Mohr-Coulomb soil under p0, finite strain: Yu and Houlsby (1991).
struct YuHoulsby {
    double young_modulus = 100e6, nu = 0.25, cohesion = 1e3, phi = 48.0, psi = 16.5, p0 = 90e3; // degrees
    // The pressure at a / a0, by bisection in R, which the pressure is linear in.
    double pressure(double opening) const {
        double low = 1.0, high = 2.0;
        while (opening_at(high) < opening)
            high *= 2.0;
        for (int n = 0; n < 200; ++n)
            (opening_at(0.5 * (low + high)) < opening ? low : high) = 0.5 * (low + high);
        return (2.0 * alpha() * q() * low / (1.0 + alpha()) - y()) / (alpha() - 1.0);
    }

  private:
    static double ratio(double angle) {
        const double s = std::sin(angle * std::numbers::pi / 180.0);
        return (1.0 + s) / (1.0 - s);
    }
    double alpha() const { return ratio(phi); }
    double beta() const { return ratio(psi); }
    double y() const { return 2.0 * cohesion * std::sqrt(alpha()); }
    double q() const { return y() + (alpha() - 1.0) * p0; }

    // a / a0; infinite beyond the limit pressure.
    double opening_at(double r) const {
        const double a = alpha(), b = beta(), shear = young_modulus / (2.0 * (1.0 + nu));
        const double gamma = a * (b + 1.0) / ((a - 1.0) * b), delta = q() / (2.0 * (1.0 + a) * shear);
        const double eta =
            std::exp((b + 1.0) * (1.0 - 2.0 * nu) * (1.0 + nu) * q() / (young_modulus * (a - 1.0) * b));
        const double xi = 2.0 * delta / ((a - 1.0) * b) * ((1.0 - nu) * (a * b + 1.0) - nu * (a + b));
        double integral = 0.0; // Simpson's rule in ln(rho)
        constexpr int n = 400;
        const double h = std::log(r) / n;
        for (int i = 0; i <= n; ++i) {
            const double rho = std::exp(i * h), weight = i == 0 || i == n ? 1.0 : i % 2 ? 4.0 : 2.0;
            integral += weight * h / 3.0 * std::pow(rho, -gamma) * std::exp(xi * rho);
        }
        const double left = std::pow(1.0 - delta, (b + 1.0) / b) - gamma / eta * integral;
        return left > 0.0 ? std::pow(std::pow(r, -gamma) / left, b / (b + 1.0)) : HUGE_VAL;
    }
};

inline double dilogarithm(double x) { // Li2, 0 <= x < 1
    double sum = 0.0, power = 1.0;
    for (int k = 1; k < 4000; ++k)
        sum += (power *= x) / (static_cast<double>(k) * k);
    return sum;
}

// The mean stress at the current radius r in an incompressible Tresca cylinder under p0 outside: Hencky strains.
struct UndrainedCylinder {
    double a0 = 0.02, b0 = 0.2, su = 50e3, G = 5e6, p0 = 100e3;
    double mean(double r, double cavity_strain) const {
        const double kk = a0 * a0 * (std::pow(1.0 + cavity_strain, 2) - 1.0), q = 1.0 - std::exp(-su / G);
        const double c2 = kk / q, b2 = b0 * b0 + kk, r2 = r * r;
        if (r2 >= c2) { // elastic
            const double e = -0.5 * std::log(1.0 - kk / r2);
            return p0 + G * (dilogarithm(kk / r2) - dilogarithm(kk / b2)) - 2.0 * G * e;
        }
        const double at_c = c2 >= b2 ? p0 : p0 + G * (dilogarithm(q) - dilogarithm(kk / b2));
        return at_c + su * std::log(std::min(c2, b2) / r2) - su;
    }
};

} // namespace gault::core::test
