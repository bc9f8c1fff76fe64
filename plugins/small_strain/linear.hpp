// Matrices that act on the six components of a symmetric tensor, in every lane its own: [row][column], where a unit of
// column xy means xy and yx together, as in the contract's tangent. Products of such matrices are then plain products.
#pragma once
#include <gault/tensor.hpp>

namespace small_strain {
inline namespace GAULT_ISA {

using gault::Mask;
using gault::Pack;
using gault::select;
using gault::SymmetricTensor;

using Matrix = std::array<SymmetricTensor, 6>;

inline constexpr double multiplicity[] = {1, 1, 1, 2, 2, 2};

GAULT_INLINE Pack dot(const SymmetricTensor& a, const SymmetricTensor& b) {
    return (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) + 2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}
GAULT_INLINE Pack norm(const SymmetricTensor& a) {
    return gault::sqrt(dot(a, a));
}
GAULT_INLINE Pack trace(const SymmetricTensor& a) {
    return a[0] + a[1] + a[2];
}
GAULT_INLINE SymmetricTensor deviator(SymmetricTensor a) {
    const Pack mean = trace(a) / 3.0;
    for (int i = 0; i < 3; ++i)
        a[i] -= mean;
    return a;
}
GAULT_INLINE SymmetricTensor minus(SymmetricTensor a, const SymmetricTensor& b) {
    for (int i = 0; i < 6; ++i)
        a[i] -= b[i];
    return a;
}
GAULT_INLINE SymmetricTensor select_lanes(Mask where, const SymmetricTensor& yes, const SymmetricTensor& no) {
    SymmetricTensor t;
    for (int i = 0; i < 6; ++i)
        t[i] = select(where, yes[i], no[i]);
    return t;
}

inline Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c;
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) {
            c[i][j] = a[i][0] * b[0][j];
            for (int k = 1; k < 6; ++k)
                c[i][j] += a[i][k] * b[k][j];
        }
    return c;
}

// Solves a x = b for `columns` right-hand sides, in place. Rows are exchanged lane by lane, so that every lane has its
// own pivots. A lane whose matrix is singular gets values that are not finite, or large.
template <std::size_t columns>
void solve(Matrix& a, std::array<std::array<Pack, columns>, 6>& b) {
    const auto exchange = [](Mask where, Pack& x, Pack& y) {
        const Pack old = x;
        x = select(where, y, x);
        y = select(where, old, y);
    };
    for (int k = 0; k < 6; ++k) {
        for (int r = k + 1; r < 6; ++r) {
            const Mask larger = gault::abs(a[r][k]) > gault::abs(a[k][k]);
            if (!gault::any(larger)) continue;
            for (int c = k; c < 6; ++c)
                exchange(larger, a[k][c], a[r][c]);
            for (std::size_t c = 0; c < columns; ++c)
                exchange(larger, b[k][c], b[r][c]);
        }
        const Pack inverse = 1.0 / a[k][k];
        for (int r = k + 1; r < 6; ++r) {
            const Pack factor = a[r][k] * inverse;
            for (int c = k + 1; c < 6; ++c)
                a[r][c] -= factor * a[k][c];
            for (std::size_t c = 0; c < columns; ++c)
                b[r][c] -= factor * b[k][c];
        }
    }
    for (int k = 5; k >= 0; --k)
        for (std::size_t c = 0; c < columns; ++c) {
            for (int j = k + 1; j < 6; ++j)
                b[k][c] -= a[k][j] * b[j][c];
            b[k][c] /= a[k][k];
        }
}

} // namespace GAULT_ISA
} // namespace small_strain
