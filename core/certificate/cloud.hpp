// Many material points in states that a soil reaches, and random increments to try on them. The same in every run.
#pragma once
#include "core/laboratory/point_batch.hpp"

#include <random>

namespace gault::core {

using Random = std::mt19937_64;

double uniform(Random& random, double low, double high);
double log_uniform(Random& random, double low, double high);
Tensor random_tensor(Random& random, double norm); // of a random direction; shear counts twice in the norm

// One step of every point of the batch, each divided into 64 parts at most where the model asks for less. A point that
// finds no result stays where it is. Returns how many did; `stress` and `state` hold what is new. `strain` as set.
std::size_t step_each(PointBatch& batch, double dt);

// `count` points that set out from the initial stress and were strained `steps` times at random, by 1e-6 to `largest`.
// RunError: the soil refuses the initial stress.
PointBatch scatter(const Material& material, const Tensor& stress, std::size_t count, int steps,
                   double largest, Random& random);

} // namespace gault::core
