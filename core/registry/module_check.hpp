// Whether a module's declarations are complete and agree with each other and with this host.
#pragma once
#include <gault/gault.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace gault::core {

// All throw std::runtime_error: what the module says and what the host expects, to follow "FILE: ".
void check_module(const gault_module& module, std::uint64_t symbol_bytes); // of the entry symbol
void check_parameters(const gault_parameter* const* parameters, const std::string& owner);
void check_states(const gault_state* states, std::uint32_t count, const std::string& owner);
void check_program_signals(const gault_program_signals* signals, const std::string& owner);

// What the checks share.
void check_that(bool right, const std::string& owner, std::string_view otherwise); // throws "OWNER OTHERWISE"
bool is_text(const char* text);                                                    // neither NULL nor empty
void check_name(const char* name, const std::string& owner);                       // [a-z][a-z0-9_]*

} // namespace gault::core
