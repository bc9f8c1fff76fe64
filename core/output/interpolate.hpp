// Curves through reference points. InputError: lengths that differ, numbers that are not finite, x that does
// not increase, a place outside the reference.
#pragma once
#include <span>
#include <string>
#include <vector>

namespace gault::core {

void require_same_length(std::span<const double> a, std::span<const double> b, const std::string& what);
void require_finite(std::span<const double> values, const std::string& what);

// Piecewise cubic without overshoot (F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5, 1984); third
// order where the data are monotone.
class MonotoneCubic {
  public:
    MonotoneCubic(std::span<const double> x, std::span<const double> y); // two points at least
    double operator()(double x) const;

  private:
    std::vector<double> x_, y_, slope_;
};

// The cubic in log r through the nearest four points, two on either side where there are two; fourth order.
class LogarithmicCubic {
  public:
    LogarithmicCubic(std::span<const double> r, std::span<const double> y); // four points at least, r > 0
    double operator()(double r) const; // up to one interval beyond the ends

  private:
    std::vector<double> log_r_, y_;
};

} // namespace gault::core
