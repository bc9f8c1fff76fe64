// Moduli that follow from a DDSDDE of any anisotropy, symmetric or not.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstring>

namespace umat {

struct Moduli {
    double p_wave; // an upper bound, Pa
    double shear;  // of the nearest isotropic stiffness (Voigt's average), Pa
};

// Cyclic Jacobi rotations of a symmetric matrix; what they leave beside the diagonal is added to it
// (Gershgorin), so the answer is never below the largest eigenvalue.
inline double largest_eigenvalue(double (&a)[5][5]) {
    for (int sweep = 0; sweep < 6; ++sweep)
        for (int p = 0; p < 5; ++p)
            for (int q = p + 1; q < 5; ++q) {
                const double half = 0.5 * (a[q][q] - a[p][p]),
                             radius = std::sqrt(half * half + a[p][q] * a[p][q]);
                if (radius == 0.0) continue;
                const double t = (half < 0.0 ? -a[p][q] : a[p][q]) / (std::abs(half) + radius);
                const double c = 1.0 / std::sqrt(1.0 + t * t), s = t * c;
                for (int k = 0; k < 5; ++k) {
                    const double x = a[k][p], y = a[k][q];
                    a[k][p] = c * x - s * y, a[k][q] = s * x + c * y;
                }
                for (int k = 0; k < 5; ++k) {
                    const double x = a[p][k], y = a[q][k];
                    a[p][k] = c * x - s * y, a[q][k] = s * x + c * y;
                }
            }
    double largest = 0.0;
    for (int i = 0; i < 5; ++i) {
        double row = a[i][i];
        for (int j = 0; j < 5; ++j)
            if (j != i) row += std::abs(a[i][j]);
        largest = i == 0 ? row : std::max(largest, row);
    }
    return largest;
}

// Waves along n that move along m feel E:C:E with E = sym(m n), whose trace t = m.n is at most 1 and whose
// deviator has the squared length 1/2 + t^2 / 6. Volume, coupling and deviator of C are therefore weighed
// apart: exact for isotropy, never too low otherwise. Of an unsymmetric C the symmetric part bounds the
// eigenvalues.
inline Moduli moduli(const double (&ddsdde)[36]) {
    const double r2 = std::sqrt(0.5), r3 = std::sqrt(1.0 / 3.0), r6 = std::sqrt(1.0 / 6.0),
                 two = std::sqrt(2.0);
    const double basis[3][3] = {{r3, r3, r3}, {r2, -r2, 0.0}, {r6, r6, -2.0 * r6}}; // volume, two deviators
    double half[6][6] = {}, c[6][6] = {}; // in the basis: rows, then columns too
    for (int j = 0; j < 6; ++j)
        for (int i = 0; i < 6; ++i) {
            if (i >= 3) half[i][j] = two * ddsdde[i + 6 * j]; // shear in Mandel's notation
            for (int k = 0; k < 3 && i < 3; ++k)
                half[i][j] += basis[i][k] * ddsdde[k + 6 * j];
        }
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) {
            if (j >= 3) c[i][j] = two * half[i][j];
            for (int k = 0; k < 3 && j < 3; ++k)
                c[i][j] += half[i][k] * basis[j][k];
        }
    double coupling = 0.0, trace = 0.0, deviator[5][5];
    for (int i = 1; i < 6; ++i) {
        const double b = 0.5 * (c[0][i] + c[i][0]);
        coupling += b * b;
        trace += c[i][i];
        for (int j = 1; j < 6; ++j)
            deviator[i - 1][j - 1] = 0.5 * (c[i][j] + c[j][i]);
    }
    return {(std::max(c[0][0], 0.0) + std::sqrt(8.0 * coupling) +
             2.0 * std::max(largest_eigenvalue(deviator), 0.0)) /
                3.0,
            std::max(trace, 0.0) / 10.0};
}

// Of one call after another: points that are elastic have the same DDSDDE, and what is known of it is not found anew.
class Known {
  public:
    template <class Call>
    Moduli moduli_of(const Call& call) {
        if (!call.has_finite_tangent()) return {0.0, 0.0};
        if (std::memcmp(ddsdde_, call.ddsdde, sizeof ddsdde_) != 0) {
            std::memcpy(ddsdde_, call.ddsdde, sizeof ddsdde_);
            moduli_ = moduli(ddsdde_);
        }
        return moduli_;
    }

  private:
    double ddsdde_[36] = {};
    Moduli moduli_{0.0, 0.0};
};

} // namespace umat
