// A reference for scenes that have none: the curve on a grid of no size, from the finest members of a family.
#pragma once
#include <array>
#include <optional>
#include <vector>

namespace gault::core {

struct SampledCurve {
    std::vector<double> x, y; // x rises strictly
    double size = 0.0;        // what was varied, NaN where that is no number
};

struct Extrapolation {
    std::vector<double> x, y;
    double order;     // observed, over the size
    double remaining; // of the finest curve: largest relative distance from the extrapolated one
};

// Of a function that rises, falls and repeats, the part that rises: rows whose x is above all before.
SampledCurve rising_part(std::vector<double> x, std::vector<double> y, double size);

// Richardson's extrapolation (L. F. Richardson, J. A. Gaunt, Phil. Trans. R. Soc. A 226, 1927) of the last three
// curves, whose sizes are in geometric progression (to 10 %). nullopt: fewer curves, other sizes, or differences
// that do not fall.
std::optional<Extrapolation> extrapolate(const std::vector<SampledCurve>& curves);

// Largest relative distance of a curve from the extrapolated one.
double distance(const SampledCurve& curve, const Extrapolation& from);

} // namespace gault::core
