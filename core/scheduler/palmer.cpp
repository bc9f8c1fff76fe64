#include "core/scheduler/palmer.hpp"
#include "core/laboratory/soil_point.hpp"

#include <algorithm>
#include <cmath>

namespace gault::core {
namespace {

constexpr double first = 1e-7;   // strain of the first step, elastic
constexpr double ratio = 1.0005; // of neighbouring strains: the trapezoidal rule is then right to 1e-7

bool is_without_bound(const Scene& scene) {
    return std::any_of(scene.boundaries.begin(), scene.boundaries.end(), [](const BoundaryUse& use) {
        return static_cast<const gault_boundary_api*>(use.model.component->declaration->api)->flags &
               GAULT_BOUNDARY_ELASTIC_BEHIND;
    });
}

void check(const Scene& scene) {
    const Location& where = scene.palmer->where;
    if (scene.geometry.kind != "annulus" || scene.symmetry == Symmetry::plane_strain)
        throw InputError(
            where, "reference.palmer is for a cavity: geometry.annulus in radial or axisymmetric symmetry");
    if (scene.initial_stress.gravity || !scene.regions.empty() || scene.initial_stress.k0 != 1.0)
        throw InputError(
            where,
            "reference.palmer is for one soil under one isotropic stress: no gravity, no regions, k0 1");
}

} // namespace

PalmerSolution::PalmerSolution(const Scene& scene, double largest)
    : inner_(scene.geometry.lower[0]), outer_(is_without_bound(scene) ? HUGE_VAL : scene.geometry.upper[0]),
      external_(scene.initial_stress.vertical) {
    check(scene);
    const Material soil(scene.materials[static_cast<std::size_t>(scene.base_material)]);
    if (soil.rate_dependent())
        throw InputError(scene.palmer->where,
                         "reference.palmer is for a soil that does not depend on the rate; '" + soil.name() +
                             "' does");
    const double effective =
        external_ - (soil.water() ? soil.water()->pressure : 0.0); // the rest is the water's
    SoilPoint point(soil, {-effective, -effective, -effective, 0.0, 0.0, 0.0});
    const double end = std::log1p(largest) * ratio;
    double before = 0.0, slope_before = 0.0; // of the integral over ln e
    for (double e = first;; e *= ratio) {
        const double step = e - before;
        point.strain({-step, 0.0, step, 0.0, 0.0, 0.0}, step); // at a rate of 1/s
        const double q = point.stress()[2] - point.stress()[0], slope = q / std::expm1(2.0 * e) * e;
        integral_.push_back(
            before == 0.0 ? slope : integral_.back() + 0.5 * (slope + slope_before) * std::log(e / before));
        strain_.push_back(e);
        q_.push_back(q);
        before = e, slope_before = slope;
        if (e > end) break;
    }
}

double PalmerSolution::at(const std::vector<double>& values, double strain) const {
    if (strain <= first) return values[0] * strain / first;
    const auto after = std::min(std::upper_bound(strain_.begin(), strain_.end(), strain), strain_.end() - 1);
    const auto k = static_cast<std::size_t>(after - strain_.begin());
    const double share = (strain - strain_[k - 1]) / (strain_[k] - strain_[k - 1]);
    return values[k - 1] + share * (values[k] - values[k - 1]);
}

double PalmerSolution::outer_strain(double cavity_strain) const {
    const double a = inner_ * (1.0 + cavity_strain);
    return 0.5 * std::log1p((a * a - inner_ * inner_) / (outer_ * outer_));
}

double PalmerSolution::radial_stress(double strain, double outer) const {
    return external_ + at(integral_, strain) - at(integral_, outer);
}

double PalmerSolution::pressure(double cavity_strain) const {
    return radial_stress(std::log1p(cavity_strain), outer_strain(cavity_strain));
}

PalmerSolution::Profile PalmerSolution::profile(double cavity_strain, int rings) const {
    const double grown = inner_ * inner_ * (std::pow(1.0 + cavity_strain, 2) - 1.0); // r^2 - r0^2
    const double last = std::isfinite(outer_) ? outer_ : 1e4 * inner_, outer = outer_strain(cavity_strain);
    Profile profile;
    for (int k = 0; k <= rings; ++k) {
        const double r0 = inner_ * std::pow(last / inner_, static_cast<double>(k) / rings);
        const double e = 0.5 * std::log1p(grown / (r0 * r0));
        profile.radius.push_back(r0);
        profile.sigma_r.push_back(radial_stress(e, outer));
        profile.sigma_theta.push_back(profile.sigma_r.back() - at(q_, e));
    }
    return profile;
}

} // namespace gault::core
