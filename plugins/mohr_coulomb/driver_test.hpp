// Drives the shared library through the contract, as the host does, and long-double principal stresses to
// judge it by.
#pragma once
#include <gtest/gtest.h>
#include <plugin_fixture.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace mohr_coulomb_test {

using plugin_test::degree;
using plugin_test::Tensor; // xx yy zz xy yz zx
using Principal = std::array<double, 3>;
using Matrix = std::array<std::array<double, 3>, 3>;
constexpr int row_of[] = {0, 1, 2, 0, 1, 2}, column_of[] = {0, 1, 2, 1, 2, 0};

struct Ultimate { // Pa, deg, m
    double c, phi, psi, strain;
    double length = 0; // 0: not regularised
};

struct Parameters { // Pa, deg
    double E = 100e6, nu = 0.25, c = 1e3, phi = 48, psi = 16.5;
    std::optional<double> t{};
    std::optional<Ultimate> ultimate{};
    // The soil without softening whose strength is that after this plastic strain, in a cell of 1 m.
    Parameters softened(double plastic_strain) const {
        if (!ultimate) return *this;
        const Ultimate& u = *ultimate;
        const double share = std::min(plastic_strain / (u.strain * (u.length > 0 ? u.length : 1)), 1.0);
        return {E, nu, c + share * (u.c - c), phi + share * (u.phi - phi), psi + share * (u.psi - psi), t};
    }
    double kappa() const { return (1 - std::sin(phi * degree)) / (1 + std::sin(phi * degree)); }
    double y() const { return 2 * c * std::cos(phi * degree) / (1 + std::sin(phi * degree)); }
    double G() const { return E / (2 * (1 + nu)); }
    double lame() const { return E * nu / ((1 + nu) * (1 - 2 * nu)); }
    double shear_excess(const Principal& s) const { return s[0] - kappa() * s[2] - y(); } // > 0: outside, Pa
    double excess(const Principal& s) const {
        return t ? std::max(shear_excess(s), s[0] - *t) : shear_excess(s);
    }
};

inline Matrix matrix(const Tensor& t) {
    Matrix m{};
    for (int i = 0; i < 6; ++i)
        m[row_of[i]][column_of[i]] = m[column_of[i]][row_of[i]] = t[i];
    return m;
}
inline Tensor rotated(const Tensor& t, const Matrix& q) { // q t q^T
    const Matrix m = matrix(t);
    Tensor r{};
    for (int i = 0; i < 6; ++i)
        for (int k = 0; k < 3; ++k)
            for (int l = 0; l < 3; ++l)
                r[i] += q[row_of[i]][k] * m[k][l] * q[column_of[i]][l];
    return r;
}
inline double dot(const Tensor& a, const Tensor& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}
inline double norm(const Tensor& a) {
    return std::sqrt(dot(a, a));
}
inline Tensor minus(Tensor a, const Tensor& b) {
    for (int i = 0; i < 6; ++i)
        a[i] -= b[i];
    return a;
}
inline Tensor diagonal(double a, double b, double c) {
    return {a, b, c, 0, 0, 0};
}

// Descending, by classical Jacobi in long double.
inline Principal principal(const Tensor& t) {
    long double m[3][3];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            m[i][j] = matrix(t)[i][j];
    for (int turn = 0; turn < 60; ++turn) {
        int p = 0, q = 1;
        if (std::fabs(m[0][2]) > std::fabs(m[p][q])) q = 2;
        if (std::fabs(m[1][2]) > std::fabs(m[p][q])) p = 1, q = 2;
        if (m[p][q] == 0) break;
        const long double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
        const long double tangent =
            std::copysign(1 / (std::fabs(theta) + std::sqrt(theta * theta + 1)), theta);
        const long double c = 1 / std::sqrt(tangent * tangent + 1), s = tangent * c;
        const int r = 3 - p - q;
        m[p][p] -= tangent * m[p][q];
        m[q][q] += tangent * m[p][q];
        const long double rp = m[r][p], rq = m[r][q];
        m[r][p] = m[p][r] = c * rp - s * rq;
        m[r][q] = m[q][r] = s * rp + c * rq;
        m[p][q] = m[q][p] = 0;
    }
    Principal s{double(m[0][0]), double(m[1][1]), double(m[2][2])};
    std::sort(s.begin(), s.end(), std::greater<>());
    return s;
}

struct Random {
    std::mt19937_64 engine{20240229};
    double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine); }
    double magnitude(double a, double b) { return std::pow(10.0, uniform(a, b)); } // 10^a to 10^b
    Tensor tensor(double size) {
        Tensor t;
        for (double& x : t)
            x = size * uniform(-1, 1);
        return t;
    }
    Matrix rotation() { // of a random unit quaternion
        std::normal_distribution<double> normal;
        double w = normal(engine), x = normal(engine), y = normal(engine), z = normal(engine);
        const double n = std::sqrt(w * w + x * x + y * y + z * z);
        w /= n, x /= n, y /= n, z /= n;
        return {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                 {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                 {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
    }
};

// Points in, points out. Lengths of all vectors are equal.
struct Batch {
    std::vector<Tensor> stress_old, strain;
    std::vector<Tensor> stress;
    std::vector<double> plastic_strain; // in: old (0 if empty); out: new
    std::vector<std::array<double, 36>> tangent;
    double modulus = 0, shear_modulus = 0;
};

inline plugin_test::Settings settings(const Parameters& p) {
    plugin_test::Settings s{{"young_modulus", p.E},
                            {"poisson_ratio", p.nu},
                            {"cohesion", p.c},
                            {"friction_angle", p.phi * degree},
                            {"dilation_angle", p.psi * degree}};
    if (p.t) s["tension_strength"] = *p.t;
    if (p.ultimate) {
        s["ultimate_cohesion"] = p.ultimate->c;
        s["ultimate_friction_angle"] = p.ultimate->phi * degree;
        s["ultimate_dilation_angle"] = p.ultimate->psi * degree;
        s["softening_strain"] = p.ultimate->strain;
        if (p.ultimate->length > 0) s["regularisation_length"] = p.ultimate->length;
    }
    return s;
}

class Model {
  public:
    explicit Model(const Parameters& p, const std::string& variant = "") : Model(settings(p), variant) {}
    explicit Model(const plugin_test::Settings& s, const std::string& variant = "")
        : component_("mohr_coulomb", GAULT_MATERIAL, "mohr_coulomb", s, variant) {}
    const plugin_test::Component& component() const { return component_; }

    void update(Batch& b, bool tangent = false) const {
        const int64_t count = int64_t(b.strain.size());
        plugin_test::Batch batch(component_, count, tangent);
        for (int64_t i = 0; i < (count + 7) / 8 * 8; ++i) {
            const size_t from = size_t(std::min(i, count - 1));
            batch.set_strain(i, b.strain[from]);
            batch.set_stress_old(i, b.stress_old[from]);
            if (!b.plastic_strain.empty()) batch.state_old[0][i] = b.plastic_strain[from];
        }
        if (batch.update() != GAULT_OK) throw std::runtime_error(batch.error.text);
        b.stress.resize(size_t(count));
        b.plastic_strain.assign(batch.state[0].data(), batch.state[0].data() + count);
        b.modulus = batch.modulus[count - 1];
        b.shear_modulus = batch.shear_modulus[count - 1];
        b.tangent.resize(tangent ? size_t(count) : 0);
        for (int64_t i = 0; i < count; ++i) {
            b.stress[size_t(i)] = batch.stress_at(i);
            for (size_t c = 0; tangent && c < 36; ++c)
                b.tangent[size_t(i)][c] = batch.tangent[c][i];
        }
    }
    Tensor update(const Tensor& stress_old, const Tensor& strain) const {
        Batch b{{stress_old}, {strain}, {}, {}, {}};
        update(b);
        return b.stress[0];
    }
    gault_status start(const Tensor& stress, gault_error& error) const {
        plugin_test::Columns strain(6, plugin_test::Column(1)), old(6, plugin_test::Column(1));
        gault_points points{};
        points.size = sizeof points;
        points.count = 1;
        points.padded = GAULT_LANES;
        for (size_t c = 0; c < 6; ++c) {
            old[c] = plugin_test::Column(1, stress[c]);
            points.strain[c] = strain[c].data();
            points.stress_old[c] = points.stress[c] = old[c].data();
        }
        return component_.api<gault_material_api>().start(component_.self(), &points, &error);
    }

  private:
    plugin_test::Component component_;
};

// The soils that the random tests run through, perfectly plastic.
inline std::vector<Parameters> soils() {
    return {{},                                  // Fahey's
            {70e6, 0.3, 1e3, 40, -2},            // Case III
            {100e6, 0.45, 1e3, 40, -5},          // close to the limit of contraction, -5.6 deg
            {100e6, 0.25, 1e-6, 48, 16.5},       // hardly any cohesion
            {100e6, 0.25, 0, 35, 0},             // none
            {13e6, 0.3, 50e3, 0, 0},             // Tresca
            {15e6, 0.4999, 50e3, 0, 0},          // nearly incompressible
            {100e6, 0.25, 1e3, 1e-7, 0},         // a friction angle that is nearly 0
            {100e6, -0.5, 1e3, 30, 10},          // auxetic
            {100e6, 0.2, 1e3, 30, 30},           // associated
            {100e6, 0.2, 1e3, 75, 40},           //
            {100e6, 0.25, 1e3, 48, 16.5, 500.0}, // cut-off
            {100e6, 0.25, 1e3, 40, -5, 0.0},     //
            {100e6, 0.45, 10e3, 30, 0, 5e3},     //
            {13e6, 0.3, 50e3, 0, 0, 10e3},       // Tresca with a cut-off
            {100e6, 0.25, 10e3, 30, 10, 10e3 / std::tan(30 * degree) - 1e-6}}; // all but at the apex
}

} // namespace mohr_coulomb_test
