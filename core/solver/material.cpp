#include "core/solver/material.hpp"
#include "core/base/suggest.hpp"
#include "core/registry/declared.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace gault::core {
namespace {

const std::vector<std::string> field_names = {"density", "volume_ratio",
                                              "characteristic_length"}; // as HostField
constexpr gault_state excess_pore_pressure = {
    "excess_pore_pressure",
    "Pa",
    "Of undrained soil, over that at the start, compression positive.",
    GAULT_SCALAR,
    0,
    0.0,
    -HUGE_VAL,
    HUGE_VAL};

} // namespace

Material::Material(const MaterialUse& use)
    : name_(use.name), instance_(*use.model.component, use.model.parameters), density_(use.density),
      water_(use.water) {
    const Location& where = use.model.parameters.where;
    const auto add = [this](const gault_state& state) {
        states_.push_back({state, components_});
        components_ += static_cast<int>(state.shape);
        rotates_states_ |= state.shape != GAULT_SCALAR && !finite_strain();
    };
    for (const gault_state& state : material_states(instance_)) {
        if (water_ && std::strcmp(state.name, excess_pore_pressure.name) == 0)
            throw InputError(where,
                             fmt::format("material '{}' has a state '{}' of its own: leave pore_water out",
                                         name_, state.name));
        add(state);
    }
    if (water_) add(excess_pore_pressure);
    for (const char* const* input = api().inputs; input && *input; ++input) {
        const auto found = std::find(field_names.begin(), field_names.end(), *input);
        if (found == field_names.end())
            throw InputError(
                where, fmt::format("material '{}' asks for the field '{}', which this host does not offer{}",
                                   name_, *input, suggestion(*input, field_names)));
        inputs_.push_back(static_cast<HostField>(found - field_names.begin()));
    }
}

bool Material::wants(HostField field) const {
    return std::find(inputs_.begin(), inputs_.end(), field) != inputs_.end();
}

Workspace::Workspace(std::size_t slots) : slots_(slots), columns_(state_old), zero_(slots) {}

double* Workspace::column(int k) {
    if (columns_.size() <= static_cast<std::size_t>(k)) columns_.resize(k + 1);
    if (columns_[k].empty()) columns_[k].resize(slots_);
    return columns_[k].data();
}

void attach_workspace(const Material& material, Workspace& workspace, BatchView& view) {
    for (int k = 0; k < 4; ++k)
        if (!view.strain[k]) view.strain[k] = workspace.column(Workspace::strain + k);
    for (int k = 0; k < 6; ++k)
        view.stress_old[k] = workspace.column(Workspace::stress_old + k);
    for (int k = 0; k < 5; ++k)
        view.flux[k] = workspace.column(Workspace::flux + k);
    for (int k = 0; k < 2; ++k)
        view.rotation[k] = material.rotates_states() ? workspace.column(Workspace::rotation + k) : nullptr;
    for (int k = 0; k < 5; ++k) {
        view.gradient_old[k] =
            material.finite_strain() ? workspace.column(Workspace::gradient_old + k) : nullptr;
        view.gradient_new[k] =
            material.finite_strain() ? workspace.column(Workspace::gradient_new + k) : nullptr;
    }
    const bool ratio = material.wants(HostField::density) || material.wants(HostField::volume_ratio);
    view.volume_ratio = ratio ? workspace.column(Workspace::volume_ratio) : nullptr;
}

} // namespace gault::core
