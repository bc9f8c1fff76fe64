#include "core/registry/answer.hpp"
#include "core/solver/call.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gault::core {
namespace {

// Calls the model on every batch with a zero increment and the present stress; `prepare` sets where outputs go.
template <class Prepare, class Function>
void call_at_rest(const Material& material, Points& points, const GridView& grid,
                  const Deformation& deformation, double time, Prepare prepare, Function function) {
    std::size_t most = 0;
    for (const Batch& batch : points.layout().batches)
        most = std::max<std::size_t>(most, batch.pages * page_slots);
    Workspace workspace(most);
    BatchView view{};
    attach_workspace(material, workspace, view);
    std::vector<Column> spare(6 + static_cast<std::size_t>(material.state_components()), Column(most));
    for (const Batch& batch : points.layout().batches) {
        const std::size_t first = static_cast<std::size_t>(batch.first_page) * page_slots;
        const std::size_t n = static_cast<std::size_t>(batch.pages) * page_slots;
        if (n == 0) continue;
        PointColumns& columns = points.columns();
        for (int k = 0; k < 4; ++k)
            std::fill_n(view.strain[k], n, 0.0);
        for (int k = 0; k < 6; ++k)
            std::copy_n(columns.stress[k].data() + first, n, view.stress_old[k]);
        for (std::size_t i = 0; i < n && (view.volume_ratio || view.gradient_old[0]); ++i) {
            const std::array<double, 5> f = deformation(first + i);
            if (view.volume_ratio) view.volume_ratio[i] = (f[0] * f[3] - f[1] * f[2]) * f[4];
            for (int k = 0; k < 5 && view.gradient_old[0]; ++k)
                view.gradient_old[k][i] = view.gradient_new[k][i] = f[k];
        }
        view.column = points.layout().page_column.data() + batch.first_page;
        view.cell_row = batch.cell_row;
        Call whole(material, points, first, n, view, workspace, {time, 0.0});
        for (int k = 0; k < material.state_components(); ++k)
            std::copy_n(columns.state[k].data() + first, n, workspace.column(Workspace::state_old + k));
        fill_inputs(material, whole.p, view, workspace, n, grid);
        if (material.water()) {
            take_water_off(material, workspace.old_states.back(), n, view.stress_old);
            for (std::size_t k = 0; k < 6; ++k) { // the points keep the total stress
                std::copy_n(view.stress_old[k], n, spare[k].data());
                whole.p.stress[k] = spare[k].data();
            }
        }
        prepare(whole.p, first, spare);
        gault_error error{-1, 0, -1, ""};
        if (function(whole.p, error) != GAULT_OK)
            throw RunError(fmt::format("material '{}': {}", material.name(), error_text(error)));
    }
}

// A fluid has no shear modulus.
void check_moduli(const Material& material, const Points& points, const Column& modulus,
                  const Column& shear) {
    const auto refuse = [&](std::size_t slot, const char* which, double value, const char* wanted) {
        throw RunError(fmt::format("material '{}': point {} has the {} modulus {:g} Pa; it must be {}",
                                   material.name(), points.identity(slot), which, value, wanted));
    };
    points.each_point([&](std::size_t slot) {
        if (!(modulus[slot] > 0.0) || !std::isfinite(modulus[slot]))
            refuse(slot, "P-wave", modulus[slot], "positive and finite");
        if (!(shear[slot] >= 0.0) || !std::isfinite(shear[slot]))
            refuse(slot, "shear", shear[slot], "finite and not negative");
    });
}

} // namespace

void evaluate_moduli(const Material& material, Points& points, const GridView& grid,
                     const Deformation& deformation, double time, Column& modulus, Column& shear) {
    modulus.resize(points.slots());
    shear.resize(points.slots());
    std::vector<double*> states(static_cast<std::size_t>(material.state_components()));
    call_at_rest(
        material, points, grid, deformation, time,
        [&](gault_points& p, std::size_t first, std::vector<Column>& spare) {
            p.modulus = modulus.data() + first;
            p.shear_modulus = shear.data() + first;
            for (int k = 0; k < 6; ++k)
                p.stress[k] = spare[k].data();
            for (std::size_t k = 0; k < states.size(); ++k)
                states[k] = spare[6 + k].data();
            p.state = states.data();
        },
        [&](gault_points& p, gault_error& error) { return update(material, p, error); });
    if (material.water())
        for (double& m : modulus)
            m += material.water()->stiffness;
    check_moduli(material, points, modulus, shear);
}

void start_material(const Material& material, Points& points, const GridView& grid) {
    for (const StateInfo& info : material.states())
        for (int k = 0; k < static_cast<int>(info.declared.shape); ++k)
            std::fill(points.columns().state[info.first + k].begin(),
                      points.columns().state[info.first + k].end(), info.declared.initial);
    if (!material.api().start) return;
    call_at_rest(
        material, points, grid, undeformed, 0.0, [](gault_points&, std::size_t, std::vector<Column>&) {},
        [&](gault_points& p, gault_error& error) {
            return material.api().start(material.instance().self(), &p, &error);
        });
}

} // namespace gault::core
