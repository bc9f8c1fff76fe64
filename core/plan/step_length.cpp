#include "core/plan/step_length.hpp"
#include "core/laboratory/soil_point.hpp"

#include <algorithm>
#include <cmath>

namespace gault::core {
namespace {

constexpr double openings[] = {0.01, 0.05}, shortest = 1e-4, least_strain = 1e-4; // strains
constexpr int rings = 24;

// The pressure at the wall, from points that reached their strains in `steps` steps.
double cavity_pressure(const Material& material, double pressure, double opening, int steps) {
    const double ratio = std::pow(std::log1p(opening) / least_strain, 1.0 / rings);
    double integral = 0.0, before = 0.0, e = least_strain;
    for (int ring = 0; ring <= rings; ++ring, e *= ratio) {
        SoilPoint point(material, {-pressure, -pressure, -pressure, 0.0, 0.0, 0.0});
        for (int step = 0; step < steps; ++step)
            point.strain({-e / steps, 0.0, e / steps, 0.0, 0.0, 0.0}, 1.0 / steps);
        const double slope = (point.stress()[2] - point.stress()[0]) / std::expm1(2.0 * e) * e; // over ln e
        integral += ring == 0 ? slope : 0.5 * (slope + before) * std::log(ratio);
        before = slope;
    }
    return pressure + integral;
}

} // namespace

StepLength longest_step(const Material& material, double pressure, double accuracy) {
    const StepLength usual{SolverSettings().strain_step, 0.0};
    if (material.rate_dependent()) return usual;
    StepLength length = usual;
    try {
        while (true) {
            length.error = 0.0;
            for (const double opening : openings) {
                const int steps = static_cast<int>(std::ceil(opening / length.strain_step));
                const double coarse = cavity_pressure(material, pressure, opening, steps),
                             fine = cavity_pressure(material, pressure, opening, 4 * steps);
                length.error =
                    std::max(length.error, 4.0 / 3.0 * std::abs(coarse / fine - 1.0)); // of first order
            }
            if (!std::isfinite(length.error)) return usual;
            if (length.error <= accuracy || length.strain_step <= shortest) return length;
            length.strain_step = std::max(
                {shortest, 0.1 * length.strain_step, 0.8 * length.strain_step * accuracy / length.error});
        }
    } catch (const RunError&) { // the run will say so itself
        return usual;
    }
}

} // namespace gault::core
