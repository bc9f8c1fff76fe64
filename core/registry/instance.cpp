#include "core/registry/instance.hpp"
#include "core/base/log.hpp"
#include "core/registry/answer.hpp"
#include "core/registry/floating_point.hpp"

#include <fmt/format.h>
#include <stdexcept>
#include <utility>

namespace gault::core {
namespace {

void host_log(void*, gault_level level, const char* text) noexcept try {
    if (!text) return;
    const std::string line = plain_text(text, 4096);
    switch (level) {
    case GAULT_DEBUG:
        return log::debug("{}", line);
    case GAULT_INFO:
        return log::info("{}", line);
    case GAULT_WARN:
        return log::warn("{}", line);
    default:
        return log::error("{}", line);
    }
} catch (...) { // rule 4 of the contract holds for the host, too
}

const void* host_extension(void*, const char*) noexcept {
    return nullptr;
}

constexpr gault_host this_host{sizeof(gault_host), GAULT_ABI_MINOR, nullptr,       "gault",
                               GAULT_VERSION,      host_log,        host_extension};

[[noreturn]] void fail(const Component& component, const Parameters& parameters, gault_status status,
                       const gault_error& error) {
    const gault_component& c = *component.declaration;
    const std::string owner = fmt::format("{} '{}'", kind_name(c.kind), c.name);
    std::string text = error_text(error);
    if (text.empty()) text = fmt::format("refused by {} without a reason", component.file.string());
    const auto index = static_cast<std::size_t>(error.parameter);
    if (status == GAULT_INVALID && error.parameter >= 0 && index < parameters.locations.size())
        throw InputError(parameters.locations[index],
                         fmt::format("{}: {}: {}", owner, c.parameters[index]->name, text));
    if (status > GAULT_FAILED)
        text =
            fmt::format("{} answered with the unknown status {} ({})", component.file.string(), status, text);
    throw InputError(parameters.where, fmt::format("{}: {}", owner, text));
}

} // namespace

const gault_host& plugin_host() {
    return this_host;
}

Instance::Instance(const Component& component, const Parameters& parameters) : component_(&component) {
    std::size_t declared = 0;
    while (declaration().parameters[declared])
        ++declared;
    if (parameters.values.size() != declared || parameters.locations.size() != declared)
        throw std::logic_error("Instance: one value and one location a declared parameter");
    gault_error error{};
    error.parameter = -1;
    error.point = -1;
    const FloatingPointMode mode;
    const gault_status status =
        declaration().create(&plugin_host(), parameters.values.data(), &self_, &error);
    const std::string changed = mode.restore();
    if (status != GAULT_OK) fail(component, parameters, status, error);
    if (changed.empty()) return;
    declaration().destroy(std::exchange(self_, nullptr));
    throw InputError(
        {component.file, 0, 0},
        fmt::format(
            "{} '{}' changes the floating-point mode ({}) when it is created; the host expects it unchanged",
            kind_name(declaration().kind), declaration().name, changed));
}

Instance::~Instance() {
    if (self_) declaration().destroy(self_);
}

Instance::Instance(Instance&& other) noexcept
    : component_(other.component_), self_(std::exchange(other.self_, nullptr)) {}

} // namespace gault::core
