// Many material points in states that a soil reaches, and random increments to try on them. The same in every run.
#pragma once
#include "core/laboratory/soil_point.hpp"

#include <optional>
#include <random>

namespace gault::core {

using Random = std::mt19937_64;

double uniform(Random& random, double low, double high);
double log_uniform(Random& random, double low, double high);
Tensor random_tensor(Random& random, double norm); // of a random direction; shear counts twice in the norm
Tensor scaled(Tensor t, double factor);
double largest(const Tensor& t); // component, by size

// One step of every point of the batch, each divided into 64 parts at most where the model asks for less. A point that
// finds no result stays where it is. Returns how many did; `stress` and `state` hold what is new. `strain` as set.
std::size_t step_each(PointBatch& batch, double dt);

// `count` points that set out from the initial stress and were strained `steps` times at random, by 1e-6 to `largest`.
// RunError: the soil refuses the initial stress.
PointBatch scatter(const Material& material, const Tensor& stress, std::size_t count, int steps,
                   double largest, Random& random);

// One point of the cloud in a batch of its own, and the call that answers a random increment between these norms, halved
// where the model asks for less. Nothing: it answers none.
std::optional<PointBatch> answered_one(const PointBatch& cloud, std::size_t point, double low, double high,
                                       Random& random, double dt = 1.0);

constexpr double quick = 1e-6; // s: too short for soil to creep

// `count` points of scatter(), some of which yield, each with an increment that the model answers by itself, and the
// call of all of them made. RunError: it is not answered.
PointBatch answered(const Material& material, const Tensor& stress, std::size_t count);

// What a point came to: stress, states, and moduli where the model was asked.
std::vector<double> outcome(const PointBatch& batch, std::size_t point);
bool all_finite(const std::vector<double>& outcome);
// The first entries alone where one was not asked for moduli.
bool same_bits(const std::vector<double>& a, const std::vector<double>& b);

// Half as much again of the increment of the call of one point, and all of it taken back: is it where it was?
bool is_elastic(const PointBatch& one);

// For scatter(): the largest strain of a step that lets a tenth of the points yield, at least the usual one; the usual
// one where 6.4 % are not enough.
struct YieldStrain {
    double size = 2e-3;
    bool yields = false;
};
YieldStrain strain_to_yield(const Material& material, const Tensor& stress);

// d stress / d strain of the call in hand, of one point, by differences of strains shifted to both sides; columns as in
// gault.h. Of three shifts that at which the sides agree best: rounding spoils the shorter, curvature the longer. Nothing:
// a shifted strain is not answered.
struct Differences {
    Matrix6 central;
    double bend; // the largest difference of an entry between the one side and the other
};
std::optional<Differences> differences(const PointBatch& call, double dt);

} // namespace gault::core
