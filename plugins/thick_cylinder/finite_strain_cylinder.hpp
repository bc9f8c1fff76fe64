// Current radii of a thick cylinder of Mohr-Coulomb soil in plane strain, expanded to a cavity pressure, at
// finite strain: Cauchy stress from logarithmic elastic strain. Plastic zone in closed form, after Yu, H. S.
// and Houlsby, G. T. (1991), Geotechnique 41, 173-183, and Yu, H. S. (1992), Computers and Geotechnics 14,
// 21-41; they linearise the elastic zone (in Case III a displacement 0.03 % larger), which is integrated
// here. On the current radii the stresses are those of MohrCoulombCylinder but for terms of the order of the
// elastic strain. Compression positive.
#pragma once
#include "mohr_coulomb_cylinder.hpp"

#include <optional>

namespace thick_cylinder {

struct DeformedRadii { // m, current
    double inner, outer;
};

class FiniteStrainCylinder {
  public:
    // Initial radii in m; isotropic initial pressure in Pa, which stays on the outside.
    FiniteStrainCylinder(const Elastic& elastic, const MohrCoulomb& soil, double inner, double outer,
                         double initial_pressure)
        : elastic_(elastic), soil_(soil), a0_(inner), b0_(outer), p0_(initial_pressure) {}

    // Nothing where an elastic rim cannot carry the pressure. The pressure is at least the initial one.
    std::optional<DeformedRadii> at(double pressure) const {
        const double q = soil_.overstress(p0_);
        const double plastic_rim =
            b0_ * std::exp(q * (1.0 - elastic_.poisson_ratio) / (2.0 * soil_.alpha() * elastic_.shear()));
        const auto mismatch = [&](double b) { return mismatch_at(rim(b), pressure); };
        if (mismatch(plastic_rim) > 0.0) return std::nullopt;
        const double b = bisect(mismatch, b0_, plastic_rim);
        const Rim elastic = rim(b);
        if (!elastic.yields) return DeformedRadii{elastic.radius, b};
        return DeformedRadii{elastic.radius * std::pow(ratio(elastic, pressure), -1.0 / power()), b};
    }

  private:
    struct Strain { // logarithmic, extension positive
        double radial, hoop;
    };
    struct Rim { // the elastic zone: where it ends inside, there or at the cavity, and the radial stress
                 // there
        double radius, initial_radius, pressure; // m, m, Pa
        bool yields;
    };

    double tension() const { return soil_.strength() / (soil_.alpha() - 1.0); }
    double power() const { return (soil_.alpha() - 1.0) / soil_.alpha(); }
    double ratio(const Rim& r, double pressure) const {
        return (pressure + tension()) / (r.pressure + tension());
    }

    Stresses stresses(const Strain& e) const {
        const double shear = elastic_.shear(), nu = elastic_.poisson_ratio;
        const double volumetric = 2.0 * shear * nu / (1.0 - 2.0 * nu) * (e.radial + e.hoop);
        return {p0_ - volumetric - 2.0 * shear * e.radial, p0_ - volumetric - 2.0 * shear * e.hoop};
    }
    double yield(const Strain& e) const {
        const Stresses s = stresses(e);
        return s.radial - soil_.alpha() * s.hoop - soil_.strength();
    }

    // Equilibrium and compatibility, hoop = ln(r/r0), radial = ln(dr/dr0), with d/d(ln r0) of both.
    Strain slope(const Strain& e) const {
        const double nu = elastic_.poisson_ratio, difference = e.radial - e.hoop,
                     stretch = std::exp(difference);
        return {-((1.0 - 2.0 * nu) * difference * stretch + nu * (stretch - 1.0)) / (1.0 - nu),
                stretch - 1.0};
    }
    Strain advanced(const Strain& e, double h) const { // Runge-Kutta, fourth order
        const auto moved = [&e](const Strain& k, double d) {
            return Strain{e.radial + d * k.radial, e.hoop + d * k.hoop};
        };
        const Strain k1 = slope(e), k2 = slope(moved(k1, 0.5 * h)), k3 = slope(moved(k2, 0.5 * h)),
                     k4 = slope(moved(k3, h));
        return {e.radial + h / 6.0 * (k1.radial + 2.0 * k2.radial + 2.0 * k3.radial + k4.radial),
                e.hoop + h / 6.0 * (k1.hoop + 2.0 * k2.hoop + 2.0 * k3.hoop + k4.hoop)};
    }

    // From the outside, at the radius b under the initial pressure, inwards to first yield or to the cavity.
    Rim rim(double b) const {
        constexpr int steps = 400;
        const double h = std::log(a0_ / b0_) / steps, nu = elastic_.poisson_ratio, hoop = std::log(b / b0_);
        Strain e{-nu / (1.0 - nu) * hoop, hoop};
        double initial_radius = a0_;
        const bool plastic_outside = yield(e) >= 0.0;
        bool yields = plastic_outside;
        if (plastic_outside) initial_radius = b0_;
        for (int i = 0; i < steps && !yields; ++i) {
            const Strain next = advanced(e, h);
            yields = yield(next) > 0.0;
            if (yields) {
                const double part = bisect([&](double s) { return yield(advanced(e, s * h)); }, 0.0, 1.0);
                initial_radius = b0_ * std::exp((i + part) * h);
                e = advanced(e, part * h);
            } else {
                e = next;
            }
        }
        return {initial_radius * std::exp(e.hoop), initial_radius, stresses(e).radial, yields};
    }

    // Positive where the rim is too small for the pressure.
    double mismatch_at(const Rim& rim, double pressure) const {
        if (!rim.yields) return pressure - rim.pressure;
        const double alpha = soil_.alpha(), beta = soil_.beta(), nu = elastic_.poisson_ratio;
        const double gamma = alpha * (beta + 1.0) / ((alpha - 1.0) * beta), n = (1.0 + beta) / beta;
        const double eta = std::exp((beta + 1.0) * (1.0 - 2.0 * nu) * (1.0 + nu) * soil_.overstress(p0_) /
                                    (elastic_.young_modulus * (alpha - 1.0) * beta));
        const double d2 =
            (rim.pressure + tension()) * ((beta * (1.0 - nu) - nu) + ((1.0 - nu) - beta * nu) / alpha);
        return lambda(ratio(rim, pressure), gamma, d2 / (2.0 * elastic_.shear() * beta)) -
               eta / gamma * (std::pow(rim.initial_radius / rim.radius, n) - std::pow(a0_ / rim.radius, n));
    }
    // Integral from 1 to r of rho^(-gamma-1) exp(xi rho) d rho: Simpson's rule in ln rho.
    static double lambda(double r, double gamma, double xi) {
        const auto f = [&](double y) { return std::exp(-gamma * y + xi * std::exp(y)); };
        constexpr int intervals = 400;
        const double h = std::log(r) / intervals;
        double sum = f(0.0) + f(h * intervals);
        for (int i = 1; i < intervals; ++i)
            sum += (i % 2 ? 4.0 : 2.0) * f(i * h);
        return sum * h / 3.0;
    }

    Elastic elastic_;
    MohrCoulomb soil_;
    double a0_, b0_, p0_;
};

} // namespace thick_cylinder
