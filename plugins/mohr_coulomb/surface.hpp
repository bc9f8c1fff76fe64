// The Mohr-Coulomb surface with its tension cut-off, and every constant of the return to it. Principal
// stresses s1 >= s2 >= s3, tension positive:
//
//     shear     F = s1 - kappa s3 - y <= 0
//               kappa = (1 - sin phi)/(1 + sin phi)
//               y = 2 c cos phi/(1 + sin phi)
//     flow      (1, 0, -mu)
//               mu = (1 - sin psi)/(1 + sin psi)
//     tension   s1 <= t, associated
//
// Multipliers are carried as D = 2G gamma, so that lengths are stresses: a plane return is
// s - D (1 + l, l, l - mu) with l = (lambda/2G)(1 - mu).
// Nothing divides by sin phi except the apex, which does not exist at phi = 0.
// A Number is a double where the strength is the same everywhere, and Sensitive where it softens.
#pragma once
#include <gault/component.hpp>

#include <cmath>
#include <limits>

namespace mohr_coulomb {
inline namespace GAULT_ISA {

enum Region {
    elastic,
    plane,
    compression_edge,
    extension_edge,
    apex,
    tension_plane,
    tension_edge,
    fixed_point,
    line
};
constexpr int region_count = 9;

struct Soil { // Pa, rad
    double young_modulus, poisson_ratio, cohesion, friction_angle, dilation_angle;
    double tension_strength; // infinity: none
};

template <class Number>
struct SurfaceOf {
    double lame, twice_shear;                  // Pa
    Number kappa, y;                           // 1, Pa
    Number apex, tension;                      // Pa; infinity where there is none
    Number tension_s3;                         // s3 where the shear plane meets the cut-off, Pa
    bool cut_off;                              // the cut-off lies before the apex, somewhere
    Number mu, l;                              // see above
    double poisson;                            // ratio
    Number per_f;                              // D of a plane return, per unit of F
    Number per_f_compression, per_f_extension; // of the edges s1 = s2 and s2 = s3
    // Plane, per unit of F: -d s2, d s3, mu D, equivalent strain.
    Number s2_loss, s3_gain, order_23, strain_gain;
    Number s3_gain_compression, s3_gain_extension; // edges, per unit of their F
    Number half_kappa;
    double tension_ratio;                // -d s2/d s1 of a return to the cut-off: lambda/(lambda + 2G)
    double strain_measure, trace_weight; // square of the equivalent strain: measure (D:D - weight (tr D)^2)
};
using Surface = SurfaceOf<double>;

template <class Number>
struct JacobiansOf {
    Number of[region_count][9]; // d s / d s_trial, row-major, of every region
};
using Jacobians = JacobiansOf<double>;

// Least admissible dilation angle, rad: below it an elastic-plastic step of a nearly incompressible soil has
// no solution.
inline double least_dilation(const Soil& m) {
    const double kappa = std::pow(std::tan(0.25 * gault::pi - 0.5 * m.friction_angle), 2);
    const double stiffness = m.poisson_ratio / (1.0 - 2.0 * m.poisson_ratio) * (1.0 - kappa);
    double most = std::numeric_limits<double>::infinity(); // of mu: both edges must keep a positive hardness
    if (stiffness > kappa) most = (stiffness + 0.5) / (stiffness - kappa);
    if (2.0 * stiffness > kappa) most = std::fmin(most, (stiffness + 1.0) / (stiffness - 0.5 * kappa));
    return std::isinf(most) ? -0.5 * gault::pi : std::asin((1.0 - most) / (1.0 + most));
}

namespace detail {

// d s / d s_trial of s_trial - flow (normal . s_trial) / (normal . flow), after averaging the components that
// an edge joins.
template <class Number>
void project(Number* jacobian, const double (&average)[9], const Number (&flow)[3], const Number (&normal)[3],
             Number inverse) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            jacobian[3 * i + j] = average[3 * i + j] - flow[i] * normal[j] * inverse;
}

template <class Number>
void set_elasticity(SurfaceOf<Number>& k, double young_modulus, double poisson_ratio) {
    const double nu = poisson_ratio, a = nu / (1.0 + nu);
    k.twice_shear = young_modulus / (1.0 + nu);
    k.lame = nu / (1.0 - 2.0 * nu) * k.twice_shear;
    k.poisson = nu;
    k.tension_ratio = nu / (1.0 - nu);
    const double measure = std::sqrt(2.0 / 3.0) / k.twice_shear;
    k.strain_measure = measure * measure;
    k.trace_weight = a * (2.0 - 3.0 * a);
}

// What follows from the elasticity, kappa and mu.
template <class Number>
GAULT_INLINE void set_returns(SurfaceOf<Number>& k) {
    using std::sqrt;
    const double ratio = k.poisson / (1.0 - 2.0 * k.poisson); // lambda/2G
    k.l = ratio * (1.0 - k.mu);
    const Number low = k.l - k.mu, joined = k.l - 0.5 * k.mu;
    k.per_f = 1.0 / (1.0 + k.l - k.kappa * low);
    k.per_f_compression = 1.0 / (0.5 + k.l - k.kappa * low);
    k.per_f_extension = 1.0 / (1.0 + k.l - k.kappa * joined);
    k.s2_loss = k.l * k.per_f;
    k.s3_gain = -low * k.per_f;
    k.order_23 = k.mu * k.per_f;
    k.strain_gain = std::sqrt(2.0 / 3.0) / k.twice_shear * sqrt(1.0 + k.mu * k.mu) * k.per_f;
    k.s3_gain_compression = -low * k.per_f_compression;
    k.s3_gain_extension = -joined * k.per_f_extension;
    k.half_kappa = 0.5 * k.kappa;
}

} // namespace detail

// Three quarters of the strength and more, seen from the isotropic stress (s1 + s3)/2.
GAULT_INLINE Mask is_mobilised(Pack kappa, Pack y, Pack s1, Pack s3) {
    const Pack lever = 0.125 * (1.0 - kappa);
    return (1.0 - lever) * s1 - (kappa + lever) * s3 > 0.75 * y;
}

// `value` makes a Real of a Number of the surface.
template <class Real, class Number, class Value>
JacobiansOf<Real> jacobians(const SurfaceOf<Number>& k, Value value) {
    using detail::project;
    constexpr double none[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    constexpr double first[9] = {.5, .5, 0, .5, .5, 0, 0, 0, 1}, last[9] = {1, 0, 0, 0, .5, .5, 0, .5, .5};
    const Real l = value(k.l), mu = value(k.mu), kappa = value(k.kappa), per_f = value(k.per_f);
    const Real low = l - mu, joined = l - 0.5 * mu, high = l + 0.5, half = -.5 * kappa;
    const double r = k.tension_ratio, nu = k.poisson;
    JacobiansOf<Real> j;
    for (auto& region : j.of)
        for (Real& entry : region)
            entry = 0.0; // apex and fixed points stay so
    project<Real>(j.of[elastic], none, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 0.0);
    project<Real>(j.of[plane], none, {1.0 + l, l, low}, {1.0, 0.0, -kappa}, per_f);
    project<Real>(j.of[compression_edge], first, {high, high, low}, {.5, .5, -kappa},
                  value(k.per_f_compression));
    project<Real>(j.of[extension_edge], last, {1.0 + l, joined, joined}, {1.0, half, half},
                  value(k.per_f_extension));
    project<Real>(j.of[tension_plane], none, {1.0, r, r}, {1.0, 0.0, 0.0}, 1.0);
    j.of[tension_edge][6] = j.of[tension_edge][7] = -nu;
    j.of[tension_edge][8] = 1.0;
    j.of[line][3] = j.of[line][5] = -nu;
    j.of[line][4] = 1.0;
    return j;
}

inline Surface surface(const Soil& m) {
    Surface k{};
    detail::set_elasticity(k, m.young_modulus, m.poisson_ratio);
    const double root = std::tan(0.25 * gault::pi - 0.5 * m.friction_angle);
    k.kappa = m.friction_angle > 0.0 ? root * root : 1.0;
    k.y = 2.0 * m.cohesion * (m.friction_angle > 0.0 ? root : 1.0);
    k.mu = m.dilation_angle == 0.0 ? 1.0 : std::pow(std::tan(0.25 * gault::pi - 0.5 * m.dilation_angle), 2);
    detail::set_returns(k);

    const double vertex = m.friction_angle > 0.0 ? m.cohesion / std::tan(m.friction_angle) : HUGE_VAL;
    k.cut_off = m.tension_strength < vertex;
    k.apex = k.cut_off ? HUGE_VAL : vertex;
    k.tension = k.cut_off ? m.tension_strength : HUGE_VAL;
    k.tension_s3 = k.cut_off ? (k.tension - k.y) / k.kappa : 0.0;
    return k;
}

inline Jacobians jacobians(const Surface& k) {
    return jacobians<double>(k, [](double x) { return x; });
}

// P-wave modulus of soil that yields, Pa: the largest d s_i / d e_i of the shear surface. Above lambda + 2G
// where flow is not associated, without bound towards the limit of contraction.
inline double yielding_modulus(const Surface& k, const Jacobians& j) {
    double most = k.lame + k.twice_shear;
    for (const Region region : {plane, compression_edge, extension_edge})
        for (int i = 0; i < 3; ++i) {
            const double* row = &j.of[region][3 * i];
            most = std::fmax(most, k.lame * (row[0] + row[1] + row[2]) + k.twice_shear * row[i]);
        }
    return most;
}

} // namespace GAULT_ISA
} // namespace mohr_coulomb
