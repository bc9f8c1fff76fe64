// Random numbers, tensors and soils for properties.
#pragma once
#include "plugins/mohr_coulomb/driver_test.hpp"

#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace properties {

inline int whole(int low, int high) { // both included; not fewer in the first cases
    return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high + 1));
}
inline double uniform(double low, double high) {
    return low + (high - low) * whole(0, 1 << 20) / (1 << 20);
}
inline double magnitude(double low, double high) {
    return std::pow(10.0, uniform(low, high));
} // 10^low to 10^high
inline bool coin() {
    return whole(0, 1) == 1;
}

// A seed drawn by rapidcheck, and what is cheap from it: a property judges thousands of points at once.
inline mohr_coulomb_test::Random many() {
    mohr_coulomb_test::Random random;
    random.engine.seed(static_cast<std::uint64_t>(whole(0, 1 << 30)));
    return random;
}

inline std::vector<std::size_t> shuffled(std::size_t n, mohr_coulomb_test::Random& random) {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), random.engine);
    return order;
}

} // namespace properties
