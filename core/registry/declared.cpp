#include "core/registry/declared.hpp"
#include "core/registry/module_check.hpp"

#include <fmt/format.h>
#include <stdexcept>

namespace gault::core {
namespace {

template <class Check>
void check_answer(const Instance& instance, const char* function, Check check) try {
    const gault_component& c = instance.declaration();
    check(fmt::format("{} '{}': {}", kind_name(c.kind), c.name, function));
} catch (const std::runtime_error& error) {
    throw InputError({instance.component().file, 0, 0}, error.what());
}

} // namespace

std::span<const gault_state> material_states(const Instance& material) {
    const auto& api = material.api<gault_material_api>();
    if (!api.instance_states) return {api.states, api.state_count};
    uint32_t count = 0;
    const gault_state* states = api.instance_states(material.self(), &count);
    check_answer(material, "instance_states",
                 [&](const std::string& owner) { check_states(states, count, owner); });
    return {states, count};
}

const gault_program_signals& program_signals(const Instance& program) {
    const auto& api = program.api<gault_program_api>();
    if (!api.instance_signals) return *api.signals;
    const gault_program_signals* signals = api.instance_signals(program.self());
    check_answer(program, "instance_signals",
                 [&](const std::string& owner) { check_program_signals(signals, owner); });
    return *signals;
}

} // namespace gault::core
