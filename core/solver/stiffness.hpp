// The derivative of nodal forces with respect to nodal displacements: a sparse matrix whose pattern follows
// from the grid, two components a node, nodes in rows.
#pragma once
#include "core/grid/grid.hpp"

#include <Eigen/SparseCore>

#include <array>

namespace gault::core {

class Stiffness {
  public:
    explicit Stiffness(const Grid& grid);

    using Matrix = Eigen::SparseMatrix<double>; // by columns
    Matrix& matrix() { return matrix_; }
    Eigen::Index size() const { return matrix_.rows(); }
    Eigen::Index row(int i, int j, int component) const {
        return 2 * (Eigen::Index{j} * nx_ + i) + component;
    }

    void clear();
    // Adds the 2 x 2 block of force at node a from displacement at node b; both belong to one cell.
    void add(const std::array<int, 2>& a, const std::array<int, 2>& b, const double (&block)[2][2]);

  private:
    int nx_, ny_;
    std::array<int, 2> reach_;
    Matrix matrix_;
};

} // namespace gault::core
