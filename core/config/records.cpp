#include "core/config/records.hpp"

#include "core/registry/instance.hpp"

#include <algorithm>

namespace gault::core::config {

Records::Records(const ComponentUse& program) : names_{"time"}, units_{"s"} {
    const auto add = [&](const gault_program_signals* signals) {
        for (std::uint32_t i = 0; signals != nullptr && i < signals->record_count; ++i) {
            names_.emplace_back(signals->records[i].name);
            units_.emplace_back(signals->records[i].unit);
        }
    };
    const auto& api = *static_cast<const gault_program_api*>(program.component->declaration->api);
    if (api.instance_signals == nullptr) {
        add(api.signals);
        return;
    }
    const Instance instance(*program.component, program.parameters);
    add(api.instance_signals(instance.self()));
}

std::string Records::unit(const Key& key, const std::string& path) const {
    const auto found = std::find(names_.begin(), names_.end(), key.text);
    if (found == names_.end())
        throw InputError(key.place.location(), path + ": the program records no " + in_quotes(key.text) +
                                                   did_you_mean(key.text, names_));
    return units_[static_cast<std::size_t>(found - names_.begin())];
}

} // namespace gault::core::config
