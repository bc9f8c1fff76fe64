#include "core/output/compare.hpp"
#include "core/base/error.hpp"
#include "core/output/interpolate.hpp"

#include <Eigen/QR>
#include <cmath>
#include <fmt/format.h>

namespace gault::core {

namespace {

std::vector<std::size_t> rows_within(std::span<const double> x, std::span<const double> y, double from,
                                     double to) {
    require_same_length(x, y, "curve");
    require_finite(x, "curve: x");
    require_finite(y, "curve: y");
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (from <= x[i] && x[i] <= to) rows.push_back(i);
    if (rows.empty()) throw InputError(fmt::format("no row lies between {} and {}", from, to));
    return rows;
}

} // namespace

CurveError compare_curve(std::span<const double> x, std::span<const double> y,
                         std::span<const double> x_reference, std::span<const double> y_reference,
                         double from, double to) {
    const MonotoneCubic reference(x_reference, y_reference);
    const std::vector<std::size_t> rows = rows_within(x, y, from, to);
    CurveError error{-1.0, 0.0, 0.0, rows.size()};
    for (const std::size_t row : rows) {
        const double expected = reference(x[row]);
        if (expected == 0.0) throw InputError(fmt::format("reference: zero at {}", x[row]));
        const double relative = std::abs((y[row] - expected) / expected);
        error.root_mean_square += relative * relative / static_cast<double>(rows.size());
        if (relative > error.largest) {
            error.largest = relative;
            error.largest_at = x[row];
        }
    }
    error.root_mean_square = std::sqrt(error.root_mean_square);
    return error;
}

double noise_about_cubic(std::span<const double> x, std::span<const double> y, double from, double to) {
    const std::vector<std::size_t> rows = rows_within(x, y, from, to);
    const auto count = static_cast<Eigen::Index>(rows.size());
    if (count < 5) throw InputError(fmt::format("{} rows between {} and {}: 5 are needed", count, from, to));
    Eigen::MatrixX4d powers(count, 4);
    Eigen::VectorXd values(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const std::size_t row = rows[static_cast<std::size_t>(i)];
        const double s = (2.0 * x[row] - from - to) / (to - from); // -1 ... 1, for conditioning
        powers.row(i) << 1.0, s, s * s, s * s * s;
        values[i] = y[row];
    }
    const double mean = values.mean();
    if (mean == 0.0) throw InputError(fmt::format("the mean between {} and {} is zero", from, to));
    const Eigen::VectorXd residual = values - powers * powers.colPivHouseholderQr().solve(values);
    return std::sqrt(residual.squaredNorm() / static_cast<double>(count)) / std::abs(mean);
}

double profile_error(std::span<const double> coordinate, std::span<const double> value,
                     std::span<const double> volume, std::span<const double> coordinate_reference,
                     std::span<const double> value_reference) {
    require_same_length(coordinate, value, "profile");
    require_same_length(coordinate, volume, "profile");
    require_finite(coordinate, "profile: coordinate");
    require_finite(value, "profile: value");
    require_finite(volume, "profile: volume");
    if (coordinate.empty()) throw InputError("profile: no points");
    const LogarithmicCubic reference(coordinate_reference, value_reference);
    double difference = 0.0, norm = 0.0;
    for (std::size_t i = 0; i < coordinate.size(); ++i) {
        const double expected = reference(coordinate[i]);
        difference += volume[i] * (value[i] - expected) * (value[i] - expected);
        norm += volume[i] * expected * expected;
    }
    if (!(norm > 0.0)) throw InputError("profile: the reference is zero everywhere");
    return std::sqrt(difference / norm);
}

} // namespace gault::core
