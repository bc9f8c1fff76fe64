// One coordinate of the background grid: cells between knots, and the basis over them.
#pragma once
#include "core/base/aligned.hpp"

#include <array>
#include <vector>

namespace gault::core {

// Linear (2 functions a cell) or quadratic B-spline (3 functions a cell) on clamped, non-uniform knots: the
// first and the last function are 1 on the end of the axis, so a wall node is the wall (de Boor 1978; Steffen
// et al. 2008). Degree 0, one cell with the one function 1: nothing varies along this axis.
class Axis {
  public:
    Axis(std::vector<double> knots, int degree); // knots strictly increasing, m; degree 0, 1 or 2

    // `cells` cells from lower to upper, each `ratio` times as long as the one before.
    static std::vector<double> graded(double lower, double upper, int cells, double ratio);

    int degree() const { return degree_; }
    int cells() const { return static_cast<int>(knots_.size()) - 1; }
    int nodes() const { return cells() + degree_; } // functions of cell e: e ... e + degree
    const std::vector<double>& knots() const { return knots_; }
    double lower() const { return knots_.front(); }
    double upper() const { return knots_.back(); }
    double node(int i) const; // Greville abscissa: sum over i of node(i) N_i(x) = x

    int cell_of(double x) const; // clamped to the axis

    struct Weights {
        std::array<double, 3> value{}, slope{}; // N and dN/dx of the cell's functions; slope in 1/m
    };
    Weights weights(int cell, double xi) const; // xi in [0, 1] within the cell

    // Per-cell coefficients, from which a kernel evaluates the basis: with a = 1 - xi,
    // quadratic N = {left a^2, 1 - left a^2 - right xi^2, right xi^2}; linear N = {a, xi}.
    const Column& origin() const { return origin_; }
    const Column& inverse_length() const { return inverse_length_; }
    const Column& length() const { return length_; }
    const Column& left() const { return left_; }
    const Column& right() const { return right_; }

    void move(double lower, double upper); // stretches all knots linearly onto the new ends

  private:
    void refresh();

    std::vector<double> knots_;
    int degree_;
    Column origin_, length_, inverse_length_, left_, right_;
};

} // namespace gault::core
