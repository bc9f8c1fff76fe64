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
#pragma once
#include <gault/component.hpp>

#include <cmath>
#include <limits>

namespace mohr_coulomb {

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

struct Surface {
    double lame, twice_shear;                  // Pa
    double kappa, y;                           // 1, Pa
    double apex, tension;                      // Pa; infinity where there is none
    double tension_s3;                         // s3 where the shear plane meets the cut-off, Pa
    bool cut_off;                              // the cut-off lies before the apex
    double mu, l, poisson;                     // see above
    double per_f;                              // D of a plane return, per unit of F
    double per_f_compression, per_f_extension; // of the edges s1 = s2 and s2 = s3
    // Plane, per unit of F: -d s2, d s3, mu D, equivalent strain.
    double s2_loss, s3_gain, order_23, strain_gain;
    double s3_gain_compression, s3_gain_extension; // edges, per unit of their F
    double half_kappa;
    double tension_ratio;                // -d s2/d s1 of a return to the cut-off: lambda/(lambda + 2G)
    double strain_measure, trace_weight; // square of the equivalent strain: measure (D:D - weight (tr D)^2)
    double jacobian[region_count][9];    // d s / d s_trial, row-major, of every region
};

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
inline void project(double* jacobian, const double (&average)[9], const double (&flow)[3],
                    const double (&normal)[3], double inverse) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            jacobian[3 * i + j] = average[3 * i + j] - flow[i] * normal[j] * inverse;
}

inline void fill_jacobians(Surface& k) {
    constexpr double none[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    constexpr double first[9] = {.5, .5, 0, .5, .5, 0, 0, 0, 1}, last[9] = {1, 0, 0, 0, .5, .5, 0, .5, .5};
    const double low = k.l - k.mu, joined = k.l - 0.5 * k.mu, high = k.l + 0.5, r = k.tension_ratio,
                 nu = k.poisson;
    for (auto& region : k.jacobian)
        for (double& entry : region)
            entry = 0.0; // apex and fixed points stay so
    project(k.jacobian[elastic], none, {0, 0, 0}, {0, 0, 0}, 0.0);
    project(k.jacobian[plane], none, {1 + k.l, k.l, low}, {1, 0, -k.kappa}, k.per_f);
    project(k.jacobian[compression_edge], first, {high, high, low}, {.5, .5, -k.kappa}, k.per_f_compression);
    project(k.jacobian[extension_edge], last, {1 + k.l, joined, joined}, {1, -.5 * k.kappa, -.5 * k.kappa},
            k.per_f_extension);
    project(k.jacobian[tension_plane], none, {1, r, r}, {1, 0, 0}, 1.0);
    k.jacobian[tension_edge][6] = k.jacobian[tension_edge][7] = -nu;
    k.jacobian[tension_edge][8] = 1.0;
    k.jacobian[line][3] = k.jacobian[line][5] = -nu;
    k.jacobian[line][4] = 1.0;
}

} // namespace detail

inline Surface surface(const Soil& m) {
    Surface k{};
    const double nu = m.poisson_ratio, root = std::tan(0.25 * gault::pi - 0.5 * m.friction_angle);
    const double ratio = nu / (1.0 - 2.0 * nu); // lambda/2G
    k.twice_shear = m.young_modulus / (1.0 + nu);
    k.lame = ratio * k.twice_shear;
    k.poisson = nu;
    k.kappa = m.friction_angle > 0.0 ? root * root : 1.0;
    k.y = 2.0 * m.cohesion * (m.friction_angle > 0.0 ? root : 1.0);
    k.mu = m.dilation_angle == 0.0 ? 1.0 : std::pow(std::tan(0.25 * gault::pi - 0.5 * m.dilation_angle), 2);
    k.l = ratio * (1.0 - k.mu);

    const double vertex = m.friction_angle > 0.0 ? m.cohesion / std::tan(m.friction_angle) : HUGE_VAL;
    k.cut_off = m.tension_strength < vertex;
    k.apex = k.cut_off ? HUGE_VAL : vertex;
    k.tension = k.cut_off ? m.tension_strength : HUGE_VAL;
    k.tension_s3 = k.cut_off ? (k.tension - k.y) / k.kappa : 0.0;
    k.tension_ratio = nu / (1.0 - nu);

    const double low = k.l - k.mu, joined = k.l - 0.5 * k.mu;
    k.per_f = 1.0 / (1.0 + k.l - k.kappa * low);
    k.per_f_compression = 1.0 / (0.5 + k.l - k.kappa * low);
    k.per_f_extension = 1.0 / (1.0 + k.l - k.kappa * joined);

    const double a = nu / (1.0 + nu), measure = std::sqrt(2.0 / 3.0) / k.twice_shear;
    k.s2_loss = k.l * k.per_f;
    k.s3_gain = -low * k.per_f;
    k.order_23 = k.mu * k.per_f;
    k.strain_gain = measure * std::sqrt(1.0 + k.mu * k.mu) * k.per_f;
    k.s3_gain_compression = -low * k.per_f_compression;
    k.s3_gain_extension = -joined * k.per_f_extension;
    k.half_kappa = 0.5 * k.kappa;
    k.strain_measure = measure * measure;
    k.trace_weight = a * (2.0 - 3.0 * a);
    detail::fill_jacobians(k);
    return k;
}

} // namespace mohr_coulomb
