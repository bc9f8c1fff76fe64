// A component's parameters, read from a map of the scene after the component's own declarations.
#pragma once
#include "core/config/fields.hpp"
#include "core/config/scene.hpp"

namespace gault::core::config {

// `host_keys` belong to the host and are skipped. Throws InputError.
Parameters read_parameters(const Node& map, const std::string& path,
                           const std::vector<std::string>& host_keys, const Component& component);

// {type: NAME, ...}
ComponentUse read_component(const Node& map, const std::string& path,
                            const std::vector<std::string>& host_keys, gault_kind kind,
                            const Registry& registry);

// The names that a NULL-terminated list of parameters declares.
std::vector<std::string> parameter_names(const gault_parameter* const* parameters);

} // namespace gault::core::config
