// The same physics as the kernels', point by point in plain matrices and with the basis by the Cox-de Boor
// recursion.
#pragma once
#include "core/grid/axis.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace gault::core::plain {

using Matrix = std::array<std::array<double, 3>, 3>;

inline Matrix identity() {
    return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
}
inline Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k)
                c[i][j] += a[i][k] * b[k][j];
    return c;
}
inline Matrix combine(double p, const Matrix& a, double q, const Matrix& b) {
    Matrix c{};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            c[i][j] = p * a[i][j] + q * b[i][j];
    return c;
}
inline Matrix transposed(const Matrix& a) {
    Matrix c{};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            c[i][j] = a[j][i];
    return c;
}
inline double determinant(const Matrix& a) {
    return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
           a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
           a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}
inline Matrix inverted(const Matrix& a) {
    Matrix c{};
    const double det = determinant(a);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            c[j][i] = (a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1]) / det;
        }
    return c;
}
inline Matrix tensor(const std::array<double, 6>& s) {
    return {{{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}}};
}
inline std::array<double, 6> components(const Matrix& m) {
    return {m[0][0], m[1][1], m[2][2], m[0][1], m[1][2], m[2][0]};
}

// N_i and dN_i/dx of every function of an axis at x, inside a cell.
inline std::vector<double> basis(const Axis& axis, double x, int degree) {
    std::vector<double> knots(axis.degree(), axis.lower());
    knots.insert(knots.end(), axis.knots().begin(), axis.knots().end());
    knots.insert(knots.end(), axis.degree(), axis.upper());
    std::vector<double> n(knots.size() - 1);
    for (std::size_t i = 0; i < n.size(); ++i)
        n[i] = knots[i] <= x && x < knots[i + 1] ? 1.0 : 0.0;
    for (int p = 1; p <= degree; ++p)
        for (std::size_t i = 0; i + p + 1 < knots.size(); ++i) {
            const double left = knots[i + p] - knots[i], right = knots[i + p + 1] - knots[i + 1];
            n[i] = (left > 0.0 ? (x - knots[i]) / left * n[i] : 0.0) +
                   (right > 0.0 ? (knots[i + p + 1] - x) / right * n[i + 1] : 0.0);
        }
    return n;
}
inline std::vector<double> slopes(const Axis& axis, double x) {
    const int p = axis.degree();
    std::vector<double> knots(p, axis.lower());
    knots.insert(knots.end(), axis.knots().begin(), axis.knots().end());
    knots.insert(knots.end(), p, axis.upper());
    const auto lower = basis(axis, x, p - 1);
    std::vector<double> slope(axis.nodes());
    for (int i = 0; i < axis.nodes(); ++i) {
        const double left = knots[i + p] - knots[i], right = knots[i + p + 1] - knots[i + 1];
        slope[i] = p * ((left > 0.0 ? lower[i] / left : 0.0) - (right > 0.0 ? lower[i + 1] / right : 0.0));
    }
    return slope;
}

struct Step { // of one point, in three dimensions; z is the hoop direction or out of plane
    std::array<double, 6> strain, stress_old;
    double cosine, sine; // of the rotation, counter-clockwise
};

inline Matrix turn(double angle) {
    return {{{std::cos(angle), -std::sin(angle), 0}, {std::sin(angle), std::cos(angle), 0}, {0, 0, 1}}};
}

// From the deformation gradients at the ends of the step: strain by the mid-point rule, rotation by Hughes
// and Winget. Strain and old stress are turned to the end of the step: from its middle, and from its start.
inline Step step(const Matrix& f_old, const Matrix& f_new, const std::array<double, 6>& stress, bool rotate) {
    const Matrix rate = product(combine(1.0, f_new, -1.0, f_old), inverted(combine(0.5, f_old, 0.5, f_new)));
    const double angle = 2.0 * std::atan(0.25 * (rate[1][0] - rate[0][1]));
    const auto turned = [](const Matrix& m, double by) {
        return product(product(turn(by), m), transposed(turn(by)));
    };
    Step result;
    result.strain = components(turned(combine(0.5, rate, 0.5, transposed(rate)), 0.5 * angle));
    result.stress_old = components(turned(tensor(stress), rotate ? angle : 0.0));
    result.cosine = std::cos(angle);
    result.sine = std::sin(angle);
    return result;
}

} // namespace gault::core::plain
