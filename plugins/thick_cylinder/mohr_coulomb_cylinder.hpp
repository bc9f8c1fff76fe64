// Thick cylinder of Mohr-Coulomb soil in plane strain under a cavity pressure above the isotropic initial
// pressure, which stays on the outside: small strain, on given radii. Hill (1950), ch. V; Yu, H. S. (1992),
// Expansion of a thick cylinder of soils, Computers and Geotechnics 14, 21-41. Compression positive.
#pragma once
#include "lame.hpp"

#include <cmath>

namespace thick_cylinder {

struct MohrCoulomb {
    double cohesion, friction_angle, dilation_angle; // Pa, rad, rad

    double alpha() const { return (1.0 + std::sin(friction_angle)) / (1.0 - std::sin(friction_angle)); }
    double beta() const { return (1.0 + std::sin(dilation_angle)) / (1.0 - std::sin(dilation_angle)); }
    double strength() const { // Y, Pa: unconfined
        return 2.0 * cohesion * std::cos(friction_angle) / (1.0 - std::sin(friction_angle));
    }
    double overstress(double p0) const { return strength() + (alpha() - 1.0) * p0; } // Q, Pa
};

// p = scale (c/a)^k - Y / (alpha - 1) once the soil is plastic to c = b sqrt(t).
inline double pressure_scale(const MohrCoulomb& soil, double p0, double t) { // S, Pa
    const double alpha = soil.alpha();
    return 2.0 * alpha * soil.overstress(p0) / ((alpha - 1.0) * ((1.0 + alpha) + (alpha - 1.0) * t));
}

// Root of an increasing or decreasing function between two points where its signs differ.
template <class Function>
double bisect(Function f, double low, double high) {
    const bool rising = f(low) < 0.0;
    for (int i = 0; i < 200 && low < high; ++i) {
        const double middle = 0.5 * (low + high);
        if (middle == low || middle == high) break;
        ((f(middle) < 0.0) == rising ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

struct MohrCoulombCylinder {
    MohrCoulomb soil;
    double inner, outer, initial_pressure; // a, b, m; p0, Pa

    double tension() const { return soil.strength() / (soil.alpha() - 1.0); } // Y / (alpha - 1), Pa
    double power() const { return (soil.alpha() - 1.0) / soil.alpha(); }      // k

    double first_yield() const { // Pa
        const double alpha = soil.alpha(), m = outer * outer / (inner * inner);
        return initial_pressure +
               soil.overstress(initial_pressure) * (m - 1.0) / ((1.0 + alpha) * m + alpha - 1.0);
    }
    double collapse() const { // Pa, plastic to the outside
        return (soil.overstress(initial_pressure) * std::pow(outer / inner, power()) - soil.strength()) /
               (soil.alpha() - 1.0);
    }
    // c, m; the inner radius where the soil is elastic. The pressure is below collapse().
    double plastic_radius(double pressure) const {
        if (pressure <= first_yield()) return inner;
        const auto excess = [&](double c) {
            const double t = c * c / (outer * outer);
            return pressure_scale(soil, initial_pressure, t) * std::pow(c / inner, power()) - tension() -
                   pressure;
        };
        return bisect(excess, inner, outer);
    }
    Stresses at(double r, double pressure, double plastic) const { // plastic: plastic_radius(pressure)
        if (plastic <= inner) return Lame(inner, outer, pressure, initial_pressure).at(r);
        const double alpha = soil.alpha();
        if (r < plastic) {
            const double radial = -tension() + (pressure + tension()) * std::pow(inner / r, power());
            return {radial, (radial - soil.strength()) / alpha};
        }
        const double b2 = outer * outer, c2 = plastic * plastic;
        const double scale = soil.overstress(initial_pressure) / ((1.0 + alpha) * b2 / c2 + alpha - 1.0);
        return {initial_pressure + scale * (b2 / (r * r) - 1.0),
                initial_pressure - scale * (b2 / (r * r) + 1.0)};
    }
};

} // namespace thick_cylinder
