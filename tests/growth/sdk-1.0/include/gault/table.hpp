// A function of one variable given by points [x, y], x strictly increasing; constant before the first and
// after the last.
#pragma once
#include <gault/pack.hpp>

#include <algorithm>
#include <vector>

namespace gault {
inline namespace GAULT_ISA {

// Rises from 0 to 1 over 0 <= s <= 1 with zero first and second derivatives at both ends.
inline double smoothstep(double s) {
    s = std::min(std::max(s, 0.0), 1.0);
    return s * s * s * (10.0 + s * (6.0 * s - 15.0));
}

struct Table {
    std::vector<double> x, y; // same length

    bool empty() const { return x.empty(); }
    double last() const { return x.back(); }

    double linear(double at) const {
        return interpolate(at, [](double s) { return s; });
    }
    // At rest at every point: C2 whatever the table.
    double smooth(double at) const { return interpolate(at, smoothstep); }

    template <class Blend>
    double interpolate(double at, Blend blend) const {
        if (at <= x.front()) return y.front();
        if (at >= x.back()) return y.back();
        const auto i = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin());
        return y[i - 1] + (y[i] - y[i - 1]) * blend((at - x[i - 1]) / (x[i] - x[i - 1]));
    }
};

} // namespace GAULT_ISA
} // namespace gault
