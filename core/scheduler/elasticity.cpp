#include "core/scheduler/elasticity.hpp"
#include "core/solver/log_strain.hpp"

#include <algorithm>
#include <cmath>

namespace gault::core {
namespace {

void remove_mean(std::array<double, 4>& tensor) { // xx yy zz xy
    const double mean = (tensor[0] + tensor[1] + tensor[2]) / 3.0;
    for (std::size_t k = 0; k < 3; ++k)
        tensor[k] -= mean;
}

} // namespace

Elasticity::Elasticity(Model& model, const Motion& motion, VolumetricStrain volumetric_strain)
    : start_(model.materials.size()), shear_only_(volumetric_strain == VolumetricStrain::cell_mean) {
    for (std::size_t m = 0; m < start_.size(); ++m) {
        start_[m].stress = motion.points()[m].columns().stress;
        evaluate_moduli(model.materials[m], model.points[m], view_of(model.grid), undeformed, 0.0,
                        start_[m].p_wave, start_[m].shear);
    }
}

bool Elasticity::elastic(const Motion& motion, const Place& place) const {
    const std::size_t slot = place.slot;
    const Start& start = start_[static_cast<std::size_t>(place.material)];
    const auto& now = motion.points()[static_cast<std::size_t>(place.material)].columns().stress;
    const std::array<double, 5> f = motion.deformation(place.material)(slot);
    const LogStrain v(f[0], f[1], f[2], f[3]);
    const double strain[4] = {v.xx, v.yy, std::log(f[4]), v.xy};
    const double G = start.shear[slot], lame = start.p_wave[slot] - 2.0 * G;
    const double volume = lame * (strain[0] + strain[1] + strain[2]);
    std::array<double, 4> got{}, expected{};
    for (std::size_t k = 0; k < 4; ++k) {
        got[k] = now[k][slot] - start.stress[k][slot];
        expected[k] = 2.0 * G * strain[k] + (k < 3 ? volume : 0.0);
    }
    if (shear_only_) remove_mean(got), remove_mean(expected);
    double departure = 0.0, change = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        const double times = k < 3 ? 1.0 : 2.0; // of a shear component in the norm
        departure += times * std::pow(got[k] - expected[k], 2);
        change += times * expected[k] * expected[k];
    }
    const double noise = 1e-5 * std::abs(start.stress[0][slot]); // that equilibrium leaves open
    return std::sqrt(departure) <= 0.01 * std::sqrt(change) + noise;
}

double Elasticity::hoop_strain(const Motion& motion, const Place& place) {
    return std::log(motion.deformation(place.material)(place.slot)[4]);
}

double Elasticity::largest_inelastic_radius(const Motion& motion) const {
    double largest = 0.0;
    for (int m = 0; m < static_cast<int>(start_.size()); ++m)
        motion.points()[static_cast<std::size_t>(m)].each_point([&](std::size_t slot) {
            const Place place{m, slot, motion.record(m, slot).reference[0]};
            if (place.radius > largest && !elastic(motion, place)) largest = place.radius;
        });
    return largest;
}

double Elasticity::yielding_radius(const Motion& motion, double outer) const {
    Place last{0, 0, 0.0}, before = last; // the outermost point, and one at 0.8 of its radius
    const auto each = [&](auto f) {
        for (int m = 0; m < static_cast<int>(start_.size()); ++m)
            motion.points()[static_cast<std::size_t>(m)].each_point([&](std::size_t slot) {
                f(Place{m, slot, motion.record(m, slot).reference[0]});
            });
    };
    each([&](const Place& p) {
        if (p.radius > last.radius) last = p;
    });
    each([&](const Place& p) {
        if (p.radius <= 0.8 * last.radius && p.radius > before.radius) before = p;
    });
    const auto stress = [&](const Place& p, std::size_t k) { // compression positive
        return -motion.points()[static_cast<std::size_t>(p.material)].columns().stress[k][p.slot];
    };
    const Start& start = start_[static_cast<std::size_t>(last.material)];
    const double p0 = -start.stress[0][last.slot], G = start.shear[last.slot];
    const double slope = (stress(last, 2) - stress(before, 2)) / (stress(last, 0) - stress(before, 0));
    const double cohesion = stress(last, 2) - slope * stress(last, 0);
    const double yield = (p0 * (1.0 - slope) - cohesion) / (1.0 + slope) / (2.0 * G);
    const double now = hoop_strain(motion, last);
    const double fall = std::log(hoop_strain(motion, before) / now) / std::log(last.radius / before.radius);
    const double radius = outer * std::pow(now / yield, 1.0 / fall);
    return std::isfinite(radius) ? std::max(radius, outer) : outer;
}

} // namespace gault::core
