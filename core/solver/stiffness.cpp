#include "core/solver/stiffness.hpp"

#include <algorithm>

namespace gault::core {

Stiffness::Stiffness(const Grid& grid)
    : nx_(grid.layout().nx), ny_(grid.layout().ny), reach_{grid.degree(0), grid.degree(1)},
      matrix_(2 * Eigen::Index{nx_} * ny_, 2 * Eigen::Index{nx_} * ny_) {
    Eigen::VectorXi entries(size());
    const auto neighbours = [](int at, int reach, int n) {
        return std::min(at + reach, n - 1) - std::max(at - reach, 0) + 1;
    };
    for (int j = 0; j < ny_; ++j)
        for (int i = 0; i < nx_; ++i)
            for (int k = 0; k < 2; ++k)
                entries[row(i, j, k)] = 2 * neighbours(i, reach_[0], nx_) * neighbours(j, reach_[1], ny_);
    matrix_.reserve(entries);
    for (int j = 0; j < ny_; ++j)
        for (int i = 0; i < nx_; ++i)
            for (int k = 0; k < 2; ++k)
                for (int b = std::max(j - reach_[1], 0); b <= std::min(j + reach_[1], ny_ - 1); ++b)
                    for (int a = std::max(i - reach_[0], 0); a <= std::min(i + reach_[0], nx_ - 1); ++a)
                        for (int m = 0; m < 2; ++m)
                            matrix_.insert(row(a, b, m), row(i, j, k)) = 0.0;
    matrix_.makeCompressed();
}

void Stiffness::clear() {
    std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
}

void Stiffness::add(const std::array<int, 2>& a, const std::array<int, 2>& b, const double (&block)[2][2]) {
    const int first_i = std::max(b[0] - reach_[0], 0), first_j = std::max(b[1] - reach_[1], 0);
    const int width = std::min(b[0] + reach_[0], nx_ - 1) - first_i + 1;
    const Eigen::Index within = 2 * (Eigen::Index{a[1] - first_j} * width + a[0] - first_i);
    for (int m = 0; m < 2; ++m) {
        double* column = matrix_.valuePtr() + matrix_.outerIndexPtr()[row(b[0], b[1], m)] + within;
        column[0] += block[0][m];
        column[1] += block[1][m];
    }
}

} // namespace gault::core
