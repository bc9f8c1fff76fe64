#include "core/scheduler/poisson_ratio.hpp"
#include "core/grid/grid.hpp"
#include "core/solver/material.hpp"
#include "core/solver/motion.hpp"

#include <algorithm>
#include <set>

namespace gault::core {
namespace {

// Vertical stress at half the height, as if all were of this soil; Pa, compression positive.
double vertical_at_middle(const Scene& scene, const MaterialUse& use) {
    const InitialStress& initial = scene.initial_stress;
    const double height = scene.geometry.upper[1] - scene.geometry.lower[1];
    const double depth = initial.gravity ? initial.depth + 0.5 * height : 0.0;
    return initial.vertical - use.density * scene.gravity[1] * depth;
}

double poisson_ratio(const Scene& scene, const MaterialUse& use) {
    const InitialStress& initial = scene.initial_stress;
    const auto& [low, high] = std::pair(scene.geometry.lower, scene.geometry.upper);
    const auto axis = [&](std::size_t k) { return Axis(Axis::graded(low[k], high[k], 1, 1.0), 1); };
    const Grid grid(axis(0), axis(1), scene.symmetry != Symmetry::plane_strain);
    const double vertical = -vertical_at_middle(scene, use);
    const Material material(use);
    PointColumns point;
    point.place = {Column(1, 0.5), Column(1, 0.5)};
    point.measure = Column(1, 1.0);
    for (std::size_t k = 0; k < 6; ++k)
        point.stress[k] = Column(1, k == 1 ? vertical : k < 3 ? initial.k0 * vertical : 0.0);
    point.state.assign(static_cast<std::size_t>(material.state_components()), Column(1));
    Points points(std::move(point), {0}, {0}, LayoutRequest{1, 1, 1, false});
    start_material(material, points, view_of(grid));
    Column p_wave, shear;
    evaluate_moduli(material, points, view_of(grid), undeformed, 0.0, p_wave, shear);
    return 0.5 * (p_wave[0] - 2.0 * shear[0]) / (p_wave[0] - shear[0]);
}

} // namespace

double largest_poisson_ratio(const Scene& scene) {
    std::set<int> used{scene.base_material};
    for (const Region& region : scene.regions)
        used.insert(region.material);
    double largest = -1.0;
    for (const int m : used)
        try {
            largest = std::max(largest, poisson_ratio(scene, scene.materials[static_cast<std::size_t>(m)]));
        } catch (const RunError&) {
        }
    return largest;
}

} // namespace gault::core
