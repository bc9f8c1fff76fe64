#include "core/output/interpolate.hpp"
#include "core/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace gault::core {

namespace {

void require_reference(std::span<const double> x, std::span<const double> y, std::size_t least) {
    require_same_length(x, y, "reference");
    require_finite(x, "reference: x");
    require_finite(y, "reference: y");
    if (x.size() < least)
        throw InputError(fmt::format("reference: {} points, {} are needed", x.size(), least));
    for (std::size_t i = 1; i < x.size(); ++i)
        if (!(x[i] > x[i - 1]))
            throw InputError(
                fmt::format("reference: x does not increase at row {}: {} after {}", i, x[i], x[i - 1]));
}

[[noreturn]] void throw_outside(double x, double low, double high) {
    throw InputError(fmt::format("{} lies outside the reference, {} to {}", x, low, high));
}

// Index of the interval that holds x, the first or the last one beyond the ends.
std::size_t interval(const std::vector<double>& knots, double x) {
    const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, x);
    return static_cast<std::size_t>(above - knots.begin()) - 1;
}

// Zero at a turning point, otherwise the harmonic mean of the neighbouring secants, weighted by the
// intervals.
double inner_slope(double h0, double h1, double secant0, double secant1) {
    if (secant0 * secant1 <= 0.0) return 0.0;
    const double w0 = 2.0 * h1 + h0, w1 = h1 + 2.0 * h0;
    return (w0 + w1) / (w0 / secant0 + w1 / secant1);
}

// The three-point formula, limited so that the curve keeps the sense of the data.
double end_slope(double h0, double h1, double secant0, double secant1) {
    const double slope = ((2.0 * h0 + h1) * secant0 - h0 * secant1) / (h0 + h1);
    if (slope * secant0 <= 0.0) return 0.0;
    if (secant0 * secant1 <= 0.0 && std::abs(slope) > 3.0 * std::abs(secant0)) return 3.0 * secant0;
    return slope;
}

} // namespace

void require_same_length(std::span<const double> a, std::span<const double> b, const std::string& what) {
    if (a.size() != b.size()) throw InputError(fmt::format("{}: {} and {} values", what, a.size(), b.size()));
}

void require_finite(std::span<const double> values, const std::string& what) {
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!std::isfinite(values[i]))
            throw InputError(fmt::format("{} is {} at row {}", what, values[i], i));
}

MonotoneCubic::MonotoneCubic(std::span<const double> x, std::span<const double> y)
    : x_(x.begin(), x.end()), y_(y.begin(), y.end()), slope_(x.size()) {
    require_reference(x, y, 2);
    const std::size_t last = x.size() - 1;
    const auto h = [&](std::size_t i) { return x[i + 1] - x[i]; };
    const auto secant = [&](std::size_t i) { return (y[i + 1] - y[i]) / h(i); };
    if (last == 1) {
        slope_.assign(2, secant(0));
        return;
    }
    for (std::size_t i = 1; i < last; ++i)
        slope_[i] = inner_slope(h(i - 1), h(i), secant(i - 1), secant(i));
    slope_[0] = end_slope(h(0), h(1), secant(0), secant(1));
    slope_[last] = end_slope(h(last - 1), h(last - 2), secant(last - 1), secant(last - 2));
}

double MonotoneCubic::operator()(double x) const {
    if (x < x_.front() || x > x_.back()) throw_outside(x, x_.front(), x_.back());
    const std::size_t i = interval(x_, x);
    const double h = x_[i + 1] - x_[i], t = (x - x_[i]) / h, u = 1.0 - t;
    return u * u * ((1.0 + 2.0 * t) * y_[i] + h * t * slope_[i]) +
           t * t * ((1.0 + 2.0 * u) * y_[i + 1] - h * u * slope_[i + 1]);
}

LogarithmicCubic::LogarithmicCubic(std::span<const double> r, std::span<const double> y)
    : log_r_(r.size()), y_(y.begin(), y.end()) {
    require_reference(r, y, 4);
    if (!(r.front() > 0.0))
        throw InputError(fmt::format("reference: {} is not a positive radius", r.front()));
    std::ranges::transform(r, log_r_.begin(), [](double radius) { return std::log(radius); });
}

double LogarithmicCubic::operator()(double r) const {
    const std::size_t last = log_r_.size() - 1;
    const double x = std::log(r);
    if (!(x >= 2.0 * log_r_[0] - log_r_[1] && x <= 2.0 * log_r_[last] - log_r_[last - 1]))
        throw_outside(r, std::exp(log_r_[0]), std::exp(log_r_[last]));
    const std::size_t i = interval(log_r_, x);
    const std::size_t first = std::min(i == 0 ? 0 : i - 1, last - 3);
    double sum = 0.0;
    for (std::size_t j = first; j < first + 4; ++j) {
        double weight = 1.0;
        for (std::size_t k = first; k < first + 4; ++k)
            if (k != j) weight *= (x - log_r_[k]) / (log_r_[j] - log_r_[k]);
        sum += weight * y_[j];
    }
    return sum;
}

} // namespace gault::core
