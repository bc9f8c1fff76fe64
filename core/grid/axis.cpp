#include "core/grid/axis.hpp"

#include <algorithm>
#include <cmath>

namespace gault::core {

Axis::Axis(std::vector<double> knots, int degree) : knots_(std::move(knots)), degree_(degree) {
    refresh();
}

std::vector<double> Axis::graded(double lower, double upper, int cells, double ratio) {
    // ratio^i - 1, which loses nothing where the ratio is near 1
    const auto excess = [growth = std::log(ratio)](int i) { return std::expm1(i * growth); };
    std::vector<double> knots(cells + 1);
    for (int i = 0; i <= cells; ++i) {
        const double fraction = ratio == 1.0 ? double(i) / cells : excess(i) / excess(cells);
        knots[i] = lower + (upper - lower) * fraction;
    }
    knots.back() = upper;
    return knots;
}

double Axis::node(int i) const {
    if (degree_ == 0) return 0.5 * (knots_[0] + knots_[1]);
    if (degree_ == 1) return knots_[i];
    // Mean of the two inner knots of the function's support; the end knots are repeated.
    const int last = cells();
    return 0.5 * (knots_[std::clamp(i - 1, 0, last)] + knots_[std::clamp(i, 0, last)]);
}

int Axis::cell_of(double x) const {
    const auto after = std::upper_bound(knots_.begin(), knots_.end(), x);
    return std::clamp(static_cast<int>(after - knots_.begin()) - 1, 0, cells() - 1);
}

Axis::Weights Axis::weights(int cell, double xi) const {
    const double a = 1.0 - xi, per_length = inverse_length_[cell];
    if (degree_ == 0) return {{1.0, 0.0, 0.0}, {}};
    if (degree_ == 1) return {{a, xi, 0.0}, {-per_length, per_length, 0.0}};
    const double l = left_[cell], r = right_[cell];
    Weights w;
    w.value = {l * a * a, 1.0 - l * a * a - r * xi * xi, r * xi * xi};
    w.slope = {-2.0 * l * a * per_length, 2.0 * (l * a - r * xi) * per_length, 2.0 * r * xi * per_length};
    return w;
}

void Axis::move(double lower, double upper) {
    const double scale = (upper - lower) / (knots_.back() - knots_.front()), start = knots_.front();
    for (double& knot : knots_)
        knot = lower + (knot - start) * scale;
    knots_.back() = upper;
    refresh();
}

void Axis::refresh() {
    const int n = cells();
    for (Column* column : {&origin_, &length_, &inverse_length_, &left_, &right_})
        column->resize(n);
    for (int e = 0; e < n; ++e) {
        const double h = knots_[e + 1] - knots_[e];
        const double before = e > 0 ? knots_[e] - knots_[e - 1] : 0.0;
        const double after = e + 1 < n ? knots_[e + 2] - knots_[e + 1] : 0.0;
        origin_[e] = knots_[e];
        length_[e] = h;
        inverse_length_[e] = 1.0 / h;
        left_[e] = h / (h + before);
        right_[e] = h / (h + after);
    }
}

} // namespace gault::core
