// The state of all points as results see it, in the order of their identity.
#pragma once
#include "core/output/results.hpp"
#include "core/solver/motion.hpp"

#include <vector>

namespace gault::core {

// InputError where a state has the name of another dataset, or another shape than its namesake.
void check_states(const Scene& scene, const Motion& motion);
std::vector<Dataset> frame_datasets(const Motion& motion);

// Plain arrays of the whole model, for observers and comparisons; tension positive, SI.
struct PointArrays {
    std::array<std::vector<double>, 3> position, reference;
    std::array<std::vector<double>, 6> stress;
    std::vector<double> volume;
    std::vector<int32_t> material;
};
PointArrays collect(const Motion& motion);
// A scalar state by name, NaN where a material has none of that name; empty if no material has it.
std::vector<double> collect_state(const Motion& motion, const std::string& name);

} // namespace gault::core
