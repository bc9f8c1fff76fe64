#include "core/registry/module_check.hpp"
#include "core/registry/registry.hpp"

#include <fmt/format.h>
#include <set>
#include <stdexcept>

namespace gault::core {
namespace {

constexpr std::uint32_t most_components = 4096; // more is taken for a count that was never set

void check_state(const gault_state& s, const std::string& owner) {
    check_that(is_text(s.unit), owner, "has no unit; a pure number has the unit \"1\"");
    check_that(is_text(s.doc), owner, "has no doc");
    check_reserved(s.reserved, owner);
    check_that(s.shape == GAULT_SCALAR || s.shape == GAULT_VECTOR || s.shape == GAULT_SYMMETRIC, owner,
               fmt::format("has the shape {}; the host knows {}, {} and {}", s.shape, +GAULT_SCALAR,
                           +GAULT_VECTOR, +GAULT_SYMMETRIC));
    check_that(s.min <= s.initial && s.initial <= s.max, owner,
               fmt::format("begins at {}, outside its bounds {} and {}", s.initial, s.min, s.max));
}

void check_signals(const gault_signal* signals, std::uint32_t count, const char* what,
                   const std::string& owner, std::uint32_t known_flags = 0) {
    check_that(signals || count == 0, owner, fmt::format("has NULL as its {} {}s", count, what));
    std::set<std::string> seen;
    for (std::uint32_t i = 0; i < count; ++i) {
        check_name(signals[i].name, fmt::format("{}: a {}", owner, what));
        const std::string name = fmt::format("{}: {} '{}'", owner, what, signals[i].name);
        check_that(seen.insert(signals[i].name).second, name, "is declared twice");
        check_that(is_text(signals[i].unit), name, "has no unit; a pure number has the unit \"1\"");
        check_that(is_text(signals[i].doc), name, "has no doc");
        check_flags(signals[i].flags, known_flags, name);
        check_reserved(signals[i].reserved, name);
    }
}

void check_fields(const char* const* names, const char* what, const std::string& owner) {
    std::set<std::string> seen;
    for (; names && *names; ++names) {
        check_that(is_text(*names), owner, fmt::format("asks for a {} without a name", what));
        check_that(seen.insert(*names).second, owner,
                   fmt::format("asks for the {} '{}' twice", what, *names));
    }
}

void check_api(const gault_material_api& api, const std::string& owner) {
    check_flags(api.flags,
                GAULT_HAS_TANGENT | GAULT_ONE_AT_A_TIME | GAULT_RATE_DEPENDENT | GAULT_FINITE_STRAIN, owner);
    check_reserved(api.reserved, owner);
    check_that(api.update, owner, "has NULL as its update function");
    check_states(api.states, api.state_count, owner);
    check_fields(api.inputs, "input", owner);
}

void check_api(const gault_boundary_api& api, const std::string& owner) {
    check_flags(api.flags,
                GAULT_BOUNDARY_UNIFORM | GAULT_BOUNDARY_HOLDS_NORMAL | GAULT_BOUNDARY_ELASTIC_BEHIND, owner);
    check_reserved(api.reserved, owner);
    check_that(api.constrain || api.load, owner, "has neither a constrain nor a load function");
    check_signals(api.controls, api.control_count, "control", owner);
}

void check_api(const gault_program_api& api, const std::string& owner) {
    check_flags(api.flags, 0, owner);
    check_that(api.advance, owner, "has NULL as its advance function");
    check_that(api.signals || api.instance_signals, owner, "has neither signals nor instance_signals");
    if (api.signals) check_program_signals(api.signals, owner);
}

void check_api(const gault_observer_api& api, const std::string& owner) {
    check_flags(api.flags, 0, owner);
    check_that(api.evaluate, owner, "has NULL as its evaluate function");
    check_signals(api.measures, api.measure_count, "measure", owner);
    check_signals(api.results, api.result_count, "result", owner);
    check_fields(api.fields, "field", owner);
}

template <class Api>
void check_api_of(const gault_component& component, std::size_t least, const std::string& owner) {
    const Api& api = *static_cast<const Api*>(component.api);
    check_size(api.size, least, owner, "an api of ");
    check_api(api, owner);
}

void check_component(const gault_component& c, std::set<std::string>& seen) {
    check_size(c.size, GAULT_BYTES_1_0(gault_component, extension), "a component");
    check_that(c.kind >= GAULT_MATERIAL && c.kind <= GAULT_OBSERVER, "a component",
               fmt::format("is of the unknown kind {}; the host knows {} to {}", c.kind, +GAULT_MATERIAL,
                           +GAULT_OBSERVER));
    check_name(c.name, fmt::format("a {}", kind_name(c.kind)));
    const std::string name = fmt::format("{} '{}'", kind_name(c.kind), c.name);
    check_that(seen.insert(name).second, name, "is declared twice");
    check_that(is_text(c.version), name, "has no version");
    check_that(is_text(c.doc), name, "has no doc");
    check_that(c.reference, name, "has NULL as its reference; the host expects a text, which may be empty");
    check_that(c.create, name, "has NULL as its create function");
    check_that(c.destroy, name, "has NULL as its destroy function");
    check_that(c.api, name, "has NULL as its api");
    check_parameters(c.parameters, name);
    switch (c.kind) {
    case GAULT_MATERIAL:
        return check_api_of<gault_material_api>(c, GAULT_BYTES_1_0(gault_material_api, instance_states),
                                                name);
    case GAULT_BOUNDARY:
        return check_api_of<gault_boundary_api>(c, GAULT_BYTES_1_0(gault_boundary_api, load), name);
    case GAULT_PROGRAM:
        return check_api_of<gault_program_api>(c, GAULT_BYTES_1_0(gault_program_api, evaluate), name);
    default:
        return check_api_of<gault_observer_api>(c, GAULT_BYTES_1_0(gault_observer_api, evaluate), name);
    }
}

// The first 24 bytes, which every version of the contract shares.
void check_version(const gault_module& m) {
    const std::string owner = GAULT_ENTRY_SYMBOL;
    check_that(m.magic == GAULT_MAGIC, owner,
               fmt::format("begins with {:#010x}; the host expects {:#010x}", m.magic, GAULT_MAGIC));
    check_that(m.abi_major == GAULT_ABI_MAJOR, owner,
               fmt::format("says ABI major {}; this host offers {}", m.abi_major, GAULT_ABI_MAJOR));
    if (m.needs_minor > GAULT_ABI_MINOR)
        throw std::runtime_error(fmt::format("needs ABI {}.{}; this host offers {}.{}", m.abi_major,
                                             m.needs_minor, GAULT_ABI_MAJOR, GAULT_ABI_MINOR));
    check_that(
        m.pointer_bytes == sizeof(void*), owner,
        fmt::format("says {}-byte pointers; the host has {}-byte ones", m.pointer_bytes, sizeof(void*)));
    check_that(m.real_bytes == sizeof(double), owner,
               fmt::format("says {}-byte reals; the host has {}-byte ones", m.real_bytes, sizeof(double)));
}

} // namespace

void check_that(bool right, const std::string& owner, std::string_view otherwise) {
    if (!right) throw std::runtime_error(fmt::format("{} {}", owner, otherwise));
}

bool is_text(const char* text) {
    return text && *text;
}

void check_name(const char* name, const std::string& owner) {
    check_that(is_text(name), owner, "has no name");
    bool right = *name >= 'a' && *name <= 'z';
    for (const char* c = name; *c; ++c)
        right = right && ((*c >= 'a' && *c <= 'z') || (*c >= '0' && *c <= '9') || *c == '_');
    check_that(right, owner, fmt::format("has the name '{}'; allowed: a-z, then a-z, 0-9 and _", name));
}

void check_size(std::uint32_t bytes, std::size_t least, const std::string& owner, std::string_view what) {
    check_that(bytes >= least, owner,
               fmt::format("has {}{} bytes; the host expects at least {}", what, bytes, least));
}

void check_flags(std::uint32_t flags, std::uint32_t known, const std::string& owner) {
    check_that((flags & ~known) == 0, owner,
               fmt::format("has the flags {:#x}; the host knows {:#x} here", flags, known));
}

void check_reserved(std::uint64_t reserved, const std::string& owner) {
    check_that(reserved == 0, owner,
               fmt::format("has {:#x} in a field that is reserved; the host expects 0", reserved));
}

void check_states(const gault_state* states, std::uint32_t count, const std::string& owner) {
    check_that(states || count == 0, owner, fmt::format("has NULL as its {} states", count));
    std::set<std::string> seen;
    std::uint32_t components = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        check_name(states[i].name, owner + ": a state");
        const std::string name = fmt::format("{}: state '{}'", owner, states[i].name);
        check_that(seen.insert(states[i].name).second, name, "is declared twice");
        check_state(states[i], name);
        components += states[i].shape;
        check_that(components <= most_components, owner,
                   fmt::format("has more than {} state components", most_components));
    }
}

void check_program_signals(const gault_program_signals* signals, const std::string& owner) {
    check_that(signals, owner, "answers NULL; the host expects signals");
    const gault_program_signals& s = *signals;
    check_size(s.size, GAULT_BYTES_1_0(gault_program_signals, record_count), owner, "signals of ");
    check_reserved(s.reserved, owner);
    check_signals(s.measures, s.measure_count, "measure", owner);
    check_signals(s.controls, s.control_count, "control", owner, GAULT_SIGNAL_OPTIONAL);
    check_signals(s.memories, s.memory_count, "memory", owner);
    check_signals(s.records, s.record_count, "record", owner);
}

void check_module(const gault_module& m, std::uint64_t symbol_bytes) {
    const std::string owner = GAULT_ENTRY_SYMBOL;
    constexpr std::size_t frozen = 24;
    check_that(
        symbol_bytes >= frozen, owner,
        fmt::format("has {} bytes; the host expects a gault_module of at least {}", symbol_bytes, frozen));
    check_version(m);
    constexpr std::size_t least = GAULT_BYTES_1_0(gault_module, components);
    check_that(
        m.size >= least && m.size <= symbol_bytes, owner,
        fmt::format("says {} bytes and has {}; the host expects at least {}", m.size, symbol_bytes, least));
    check_reserved(m.reserved, owner);
    check_that(is_text(m.name), "the module", "has no name");
    check_that(is_text(m.version), "the module", "has no version");
    check_that(m.author && m.license && m.built_with, "the module",
               "has NULL as its author, license or built_with; the host expects texts, which may be empty");
    check_that(m.components && m.components[0], "the module", "has no components");
    std::set<std::string> seen;
    for (const gault_component* const* c = m.components; *c; ++c)
        check_component(**c, seen);
}

} // namespace gault::core
