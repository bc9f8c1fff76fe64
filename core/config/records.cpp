#include "core/config/records.hpp"

#include "core/registry/declared.hpp"

#include <algorithm>

namespace gault::core::config {

Records::Records(const ComponentUse& program) : names_{"time"}, units_{"s"} {
    const Instance instance(*program.component, program.parameters);
    const gault_program_signals& signals = program_signals(instance);
    for (std::uint32_t i = 0; i < signals.record_count; ++i) {
        names_.emplace_back(signals.records[i].name);
        units_.emplace_back(signals.records[i].unit);
    }
}

std::string Records::unit(const Key& key, const std::string& path) const {
    const auto found = std::find(names_.begin(), names_.end(), key.text);
    if (found == names_.end())
        throw InputError(key.place.location(), path + ": the program records no " + in_quotes(key.text) +
                                                   did_you_mean(key.text, names_));
    return units_[static_cast<std::size_t>(found - names_.begin())];
}

} // namespace gault::core::config
