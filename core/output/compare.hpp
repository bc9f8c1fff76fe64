// Errors of a run against reference data in files: a curve, radial profiles.
#pragma once
#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace gault::core {

struct CsvTable {
    std::vector<std::string> columns;
    std::vector<std::vector<double>> values;                       // by column
    std::span<const double> column(const std::string& name) const; // InputError with the nearest name
};

// A header line, then finite numbers; blanks around a cell and empty lines are allowed. InputError with
// file:line:column.
CsvTable read_csv(const std::filesystem::path& file);

struct CurveError { // of e = |y - y_ref| / |y_ref| over the rows with from <= x <= to
    double largest;
    double largest_at;       // its x
    double root_mean_square; // sqrt(mean e^2)
    std::size_t rows;
};

// All functions below throw InputError: lengths that differ, a number that is not finite, no row in the
// range, a reference that does not increase in x, does not cover the rows, or is zero where it divides.

// y against the reference at the run's own x, by a monotone cubic through the reference points
// (PCHIP: F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5, 1984).
CurveError compare_curve(std::span<const double> x, std::span<const double> y,
                         std::span<const double> x_reference, std::span<const double> y_reference,
                         double from, double to);

// RMS of y about its own least-squares cubic over from <= x <= to, relative to the mean of y there. Every row
// counts; five are needed.
double noise_about_cubic(std::span<const double> x, std::span<const double> y, double from, double to);

// Relative L2 norm over points, weighted by volume: sqrt(sum V (s - s_ref(R))^2 / sum V s_ref(R)^2), with the
// reference interpolated at each point's coordinate (the cubic in log r through the nearest four;
// extrapolated at the ends, by one reference interval at most). Points in any order.
double profile_error(std::span<const double> coordinate, std::span<const double> value,
                     std::span<const double> volume, std::span<const double> coordinate_reference,
                     std::span<const double> value_reference);

} // namespace gault::core
