#include "core/solver/call.hpp"

#include <algorithm>
#include <cmath>

namespace gault::core {

Call::Call(const Material& material, Points& points, std::size_t first, std::size_t n, const BatchView& view,
           Workspace& workspace, const Moment& moment) {
    p.size = sizeof p;
    p.count = p.padded = static_cast<int64_t>(n);
    p.time = moment.time;
    p.dt = moment.dt;
    for (int k = 0; k < 6; ++k) {
        p.strain[k] = k < 4 ? view.strain[k] : workspace.zero();
        p.stress_old[k] = view.stress_old[k];
        p.stress[k] = points.columns().stress[k].data() + first;
    }
    workspace.old_states.clear();
    workspace.states.clear();
    for (int k = 0; k < material.state_components(); ++k) {
        workspace.old_states.push_back(workspace.column(Workspace::state_old + k));
        workspace.states.push_back(points.columns().state[k].data() + first);
    }
    p.state_old = workspace.old_states.data();
    p.state = workspace.states.data();
    p.suggest = 0.5;
    if (!view.gradient_old[0]) return;
    static constexpr int position[9] = {0, 1, -1, 2, 3, -1, -1, -1, 4}; // of F in the kernels' five columns
    for (int k = 0; k < 9; ++k) {
        p.F_old[k] = position[k] < 0 ? workspace.zero() : view.gradient_old[position[k]];
        p.F_new[k] = position[k] < 0 ? workspace.zero() : view.gradient_new[position[k]];
    }
}

gault_status update(const Material& material, gault_points& p, gault_error& error) {
    error.parameter = -1;
    error.point = -1;
    error.text[0] = '\0';
    return material.api().update(material.instance().self(), &p, &error);
}

void fill_inputs(const Material& material, gault_points& p, const BatchView& view, Workspace& workspace,
                 std::size_t n, const GridView& grid) {
    workspace.inputs.clear();
    for (std::size_t k = 0; k < material.inputs().size(); ++k) {
        double* column = workspace.column(Workspace::input + static_cast<int>(k));
        switch (material.inputs()[k]) {
        case HostField::density:
            for (std::size_t i = 0; i < n; ++i)
                column[i] = material.density() / view.volume_ratio[i];
            break;
        case HostField::volume_ratio:
            std::copy_n(view.volume_ratio, n, column);
            break;
        case HostField::characteristic_length:
            for (std::size_t page = 0; page < n / page_slots; ++page) { // all of a page are in one cell
                const double length = grid.x.length[view.column[page]];
                std::fill_n(column + page * page_slots, page_slots,
                            grid.radial ? length : std::sqrt(length * grid.y.length[view.cell_row]));
            }
            break;
        }
        workspace.inputs.push_back(column);
    }
    p.input = workspace.inputs.data();
}

void take_water_off(const Material& material, const double* excess, std::size_t n, double* const* stress) {
    for (int k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < n; ++i)
            stress[k][i] += material.water()->pressure + excess[i];
}

void put_water_back(const Material& material, const gault_points& p, double* const* tangent) {
    const PoreWater& water = *material.water();
    const double* before = p.state_old[material.state_components() - 1];
    double* excess = p.state[material.state_components() - 1];
    for (int64_t i = 0; i < p.count; ++i) {
        excess[i] = before[i] - water.stiffness * (p.strain[0][i] + p.strain[1][i] + p.strain[2][i]);
        for (int k = 0; k < 3; ++k)
            p.stress[k][i] -= water.pressure + excess[i];
    }
    for (int row = 0; row < 3 && tangent; ++row)
        for (int column = 0; column < 3; ++column)
            for (int64_t i = 0; i < p.count; ++i)
                tangent[6 * row + column][i] += water.stiffness;
}

std::shared_ptr<const ElementReplay> replay(const Material& material, const gault_points& p, std::size_t i) {
    auto call = std::make_shared<ElementReplay>();
    call->time = p.time;
    call->dt = p.dt;
    for (std::size_t k = 0; k < 6; ++k) {
        call->stress[k] = p.stress_old[k][i];
        call->strain[k] = p.strain[k][i];
    }
    for (const StateInfo& info : material.states())
        for (int k = 0; k < static_cast<int>(info.declared.shape); ++k)
            call->states[info.declared.name].push_back(p.state_old[info.first + k][i]);
    if (material.water())
        call->states.erase(material.states().back().declared.name); // the stress is the model's: effective
    for (std::size_t k = 0; k < material.inputs().size(); ++k)
        call->inputs[material.api().inputs[k]] = {p.input[k][i]};
    if (!p.F_old[0]) return call;
    call->F_old.emplace();
    call->F_new.emplace();
    for (std::size_t k = 0; k < 9; ++k) {
        (*call->F_old)[k] = p.F_old[k][i];
        (*call->F_new)[k] = p.F_new[k][i];
    }
    return call;
}

} // namespace gault::core
