// Whether a module's declarations are complete and agree with each other and with this host.
#pragma once
#include <gault/gault.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace gault::core {

// All throw std::runtime_error: what the module says and what the host expects, to follow "FILE: ".
void check_module(const gault_module& module, std::uint64_t symbol_bytes); // of the entry symbol
void check_parameters(const gault_parameter* const* parameters, const std::string& owner);
void check_states(const gault_state* states, std::uint32_t count, const std::string& owner);
void check_program_signals(const gault_program_signals* signals, const std::string& owner);

// Bytes of a growing struct up to `last`, its last field in ABI 1.0: what later minors append, a plugin may lack.
#define GAULT_BYTES_1_0(type, last) (offsetof(type, last) + sizeof(type::last))

// What the checks share.
void check_that(bool right, const std::string& owner, std::string_view otherwise); // throws "OWNER OTHERWISE"
bool is_text(const char* text);                                                    // neither NULL nor empty
void check_name(const char* name, const std::string& owner);                       // [a-z][a-z0-9_]*
void check_size(std::uint32_t bytes, std::size_t least, const std::string& owner, std::string_view what = "");
void check_flags(std::uint32_t flags, std::uint32_t known, const std::string& owner);
void check_reserved(std::uint64_t reserved, const std::string& owner);

} // namespace gault::core
