// The largest time step that is stable on this grid, with these points, basis and moduli.
#pragma once
#include "core/solver/motion.hpp"

namespace gault::core {

// Where a node's component is prescribed: 1, else 0.
using FixedField = VectorField;

// 2 / omega_max, s, of the linearised system that the explicit scheme integrates: w' = -M^-1 K v, v = M^-1 C
// w with lumped mass M and consistent mass C (the map of point velocities onto the grid damps short waves, so
// the limit lies above h/c). omega_max^2 is the largest eigenvalue, by Lanczos iteration in the inner product
// of C, to about 0.1 %. `moduli`: P-wave and shear modulus of every slot of every material, Pa.
// `mass_scaling` multiplies the mass.
double stable_step(Motion& motion, const std::vector<std::array<Column, 2>>& moduli, const FixedField& fixed,
                   double mass_scaling);

} // namespace gault::core
