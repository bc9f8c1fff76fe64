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
    std::vector<std::vector<double>> values; // by column
    std::span<const double> column(const std::string& name) const; // InputError with the nearest name
};

CsvTable read_csv(const std::filesystem::path& file); // InputError with file:line

struct CurveError {
    double largest;      // max |y - y_ref| / |y_ref| over the rows with from <= x <= to
    double largest_at;   // its x
    double root_mean_square;
    std::size_t rows;
};

// y against the reference at the run's own x, by a monotone cubic (PCHIP) through the reference points.
CurveError compare_curve(std::span<const double> x, std::span<const double> y, std::span<const double> x_reference,
                         std::span<const double> y_reference, double from, double to);

// RMS of y about its own least-squares cubic over from <= x <= to, relative to the mean of y there. Every row counts.
double noise_about_cubic(std::span<const double> x, std::span<const double> y, double from, double to);

// Relative L2 norm over points, weighted by volume: sqrt(sum V (s - s_ref(R))^2 / sum V s_ref(R)^2), with the reference
// interpolated at each point's coordinate (a cubic in log r; extrapolated at the ends).
double profile_error(std::span<const double> coordinate, std::span<const double> value, std::span<const double> volume,
                     std::span<const double> coordinate_reference, std::span<const double> value_reference);

} // namespace gault::core
