// How little the soils of a scene change their volume, water included.
#pragma once
#include "core/config/scene.hpp"

namespace gault::core {

// Of the materials of the base and the regions, each under the initial stress at half the height; from their P-wave and shear moduli there. -1: none
// of them can bear that stress, which the run will say.
double largest_poisson_ratio(const Scene& scene);

} // namespace gault::core
