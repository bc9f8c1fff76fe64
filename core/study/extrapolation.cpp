#include "core/study/extrapolation.hpp"
#include "core/output/interpolate.hpp"

#include <algorithm>
#include <cmath>

namespace gault::core {
namespace {

constexpr int samples = 200;
constexpr double start_share = 0.05; // of the range of x, where curves begin and a relative error says little

double norm(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum);
}

std::vector<double> sampled(const SampledCurve& curve, const std::vector<double>& at) {
    const MonotoneCubic f(curve.x, curve.y);
    std::vector<double> y;
    for (const double x : at)
        y.push_back(f(x));
    return y;
}

} // namespace

SampledCurve rising_part(std::vector<double> x, std::vector<double> y, double size) {
    SampledCurve curve{{}, {}, size};
    for (std::size_t i = 0; i < x.size(); ++i)
        if (curve.x.empty() || x[i] > curve.x.back()) {
            curve.x.push_back(x[i]);
            curve.y.push_back(y[i]);
        }
    return curve;
}

std::optional<Extrapolation> extrapolate(const std::vector<SampledCurve>& curves) {
    if (curves.size() < 3) return std::nullopt;
    const SampledCurve* last[3] = {&curves[curves.size() - 3], &curves[curves.size() - 2], &curves.back()};
    const double ratio = last[2]->size / last[1]->size;
    if (!(std::abs(ratio * last[0]->size / last[1]->size - 1.0) < 0.1)) return std::nullopt;
    double low = -HUGE_VAL, high = HUGE_VAL;
    for (const SampledCurve* curve : last) {
        if (curve->x.size() < 2) return std::nullopt;
        low = std::max(low, curve->x.front());
        high = std::min(high, curve->x.back());
    }
    Extrapolation result{};
    for (int k = 0; k <= samples; ++k)
        result.x.push_back(low + (high - low) * (start_share + (1.0 - start_share) * k / samples));
    const std::vector<double> coarse = sampled(*last[0], result.x), middle = sampled(*last[1], result.x),
                              fine = sampled(*last[2], result.x);
    const double before = norm(coarse, middle), now = norm(middle, fine);
    if (!(before > now) || now == 0.0) return std::nullopt;
    result.order = std::log(before / now) / std::abs(std::log(ratio));
    const double gain = before / now - 1.0; // ratio^order - 1
    for (std::size_t i = 0; i < fine.size(); ++i)
        result.y.push_back(fine[i] + (fine[i] - middle[i]) / gain);
    result.remaining = distance(*last[2], result);
    return result;
}

double distance(const SampledCurve& curve, const Extrapolation& from) {
    const MonotoneCubic f(curve.x, curve.y);
    double largest = 0.0;
    for (std::size_t i = 0; i < from.x.size(); ++i)
        if (from.x[i] >= curve.x.front() && from.x[i] <= curve.x.back() && from.y[i] != 0.0)
            largest = std::max(largest, std::abs(f(from.x[i]) / from.y[i] - 1.0));
    return largest;
}

} // namespace gault::core
