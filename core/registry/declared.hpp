// What an instance declares: of the component, or of the instance where that depends on parameters.
#pragma once
#include "core/registry/instance.hpp"

#include <span>

namespace gault::core {

// Both live as long as the instance. InputError where what it answers is not what the contract allows.
std::span<const gault_state> material_states(const Instance& material);
const gault_program_signals& program_signals(const Instance& program);

} // namespace gault::core
