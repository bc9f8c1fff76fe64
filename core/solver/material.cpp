#include "core/solver/material.hpp"
#include "core/base/suggest.hpp"
#include "core/registry/answer.hpp"
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

namespace {

// State components of a batch, rotated where they are tensors or vectors: x' = c x + s y, y' = c y - s x.
void rotate_states(const Material& material, const Column* state, std::size_t first, std::size_t n,
                   const BatchView& view, double* const* out) {
    for (const StateInfo& info : material.states()) {
        const double* in[6];
        double* to[6];
        for (int k = 0; k < static_cast<int>(info.declared.shape); ++k) {
            in[k] = state[info.first + k].data() + first;
            to[k] = out[info.first + k];
        }
        if (info.declared.shape == GAULT_SCALAR || !material.rotates_states()) {
            for (int k = 0; k < static_cast<int>(info.declared.shape); ++k)
                std::memcpy(to[k], in[k], n * sizeof(double));
            continue;
        }
        for (std::size_t i = 0; i < n; ++i) {
            const double c = view.rotation[0][i], s = view.rotation[1][i];
            if (info.declared.shape == GAULT_VECTOR) {
                to[0][i] = c * in[0][i] + s * in[1][i];
                to[1][i] = c * in[1][i] - s * in[0][i];
                to[2][i] = in[2][i];
                continue;
            }
            const double xx = in[0][i], yy = in[1][i], xy = in[3][i], yz = in[4][i], zx = in[5][i];
            const double turn = s * s * (yy - xx) + 2.0 * c * s * xy;
            to[0][i] = xx + turn;
            to[1][i] = yy - turn;
            to[2][i] = in[2][i];
            to[3][i] = c * s * (yy - xx) + (c * c - s * s) * xy;
            to[4][i] = c * yz - s * zx;
            to[5][i] = c * zx + s * yz;
        }
    }
}

struct Call { // a gault_points over a batch, with what it points at
    gault_points p{};

    Call(const Material& material, Points& points, std::size_t first, std::size_t n, const BatchView& view,
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
        static constexpr int position[9] = {0,  1,  -1, 2, 3,
                                            -1, -1, -1, 4}; // of F in the kernels' five columns
        for (int k = 0; k < 9; ++k) {
            p.F_old[k] = position[k] < 0 ? workspace.zero() : view.gradient_old[position[k]];
            p.F_new[k] = position[k] < 0 ? workspace.zero() : view.gradient_new[position[k]];
        }
    }
};

gault_status call(const Material& material, gault_points& p, gault_error& error) {
    error.parameter = -1;
    error.point = -1;
    error.text[0] = '\0';
    return material.api().update(material.instance().self(), &p, &error);
}

// Repeats the update in `pieces` equal parts of the increment, each starting where the one before ended.
gault_status update_in_pieces(const Material& material, const Call& whole, std::size_t n, int pieces,
                              gault_error& error) {
    Call part = whole;
    std::vector<Column> copies;
    copies.reserve(6 + static_cast<std::size_t>(material.state_components()) + 6 + 18);
    const auto copy = [&](const double* from) {
        copies.emplace_back(n);
        std::copy(from, from + n, copies.back().begin());
        return copies.back().data();
    };
    double* stress[6];
    std::vector<double*> state;
    for (int k = 0; k < 6; ++k) {
        part.p.stress_old[k] = stress[k] = copy(whole.p.stress_old[k]);
        double* strain = copy(whole.p.strain[k]);
        for (std::size_t i = 0; i < n; ++i)
            strain[i] /= pieces;
        part.p.strain[k] = strain;
    }
    for (int k = 0; k < material.state_components(); ++k)
        state.push_back(copy(whole.p.state_old[k]));
    part.p.state_old = state.data();
    double *from[9] = {}, *to[9] = {};
    for (int k = 0; k < 9 && whole.p.F_old[0]; ++k) {
        part.p.F_old[k] = from[k] = copy(whole.p.F_old[k]);
        part.p.F_new[k] = to[k] = copy(whole.p.F_new[k]);
    }
    part.p.dt = whole.p.dt / pieces;
    for (int piece = 1; piece <= pieces; ++piece) {
        part.p.time = whole.p.time - whole.p.dt + piece * part.p.dt;
        for (int k = 0; k < 9 && from[0]; ++k)
            for (std::size_t i = 0; i < n; ++i) {
                const double step = (whole.p.F_new[k][i] - whole.p.F_old[k][i]) / pieces;
                from[k][i] = whole.p.F_old[k][i] + (piece - 1) * step;
                to[k][i] = whole.p.F_old[k][i] + piece * step;
            }
        if (const gault_status status = call(material, part.p, error); status != GAULT_OK) return status;
        for (int k = 0; k < 6; ++k)
            std::copy(part.p.stress[k], part.p.stress[k] + n, stress[k]);
        for (int k = 0; k < material.state_components(); ++k)
            std::copy(part.p.state[k], part.p.state[k] + n, state[k]);
    }
    return GAULT_OK;
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

} // namespace

namespace {

// d(stress)/d(strain) by differences: strains shifted one component at a time; where F is wanted, F_new
// shifted to exp(e) F_new, to first order.
gault_status differentiate(const Material& material, const Call& whole, std::size_t n, double* const* tangent,
                           gault_error& error) {
    constexpr double shift = 1e-8;
    static constexpr int pair[tangent_columns][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}};
    Call shifted = whole;
    std::vector<Column> stress(6, Column(n)), state(material.state_components(), Column(n)),
        moved(9, Column(n));
    Column moved_strain(n);
    std::vector<double*> states;
    for (int k = 0; k < 6; ++k)
        shifted.p.stress[k] = stress[k].data();
    for (Column& column : state)
        states.push_back(column.data());
    shifted.p.state = states.data();
    for (int column = 0; column < tangent_columns; ++column) {
        const double* strain = whole.p.strain[column];
        std::transform(strain, strain + n, moved_strain.begin(), [](double e) { return e + shift; });
        shifted.p.strain[column] = moved_strain.data();
        if (whole.p.F_new[0]) {
            const auto [i, j] = pair[column];
            for (int k = 0; k < 9; ++k)
                std::copy_n(whole.p.F_new[k], n, moved[k].data());
            for (int k = 0; k < 3; ++k)
                for (std::size_t q = 0; q < n; ++q) {
                    moved[3 * i + k][q] += shift * whole.p.F_new[3 * j + k][q];
                    if (i != j) moved[3 * j + k][q] += shift * whole.p.F_new[3 * i + k][q];
                }
            for (int k = 0; k < 9; ++k)
                shifted.p.F_new[k] = moved[k].data();
        }
        if (const gault_status status = call(material, shifted.p, error); status != GAULT_OK) return status;
        shifted.p.strain[column] = strain;
        for (int row = 0; row < 6; ++row)
            for (std::size_t q = 0; q < n; ++q)
                tangent[6 * row + column][q] = (stress[row][q] - whole.p.stress[row][q]) / shift;
    }
    return GAULT_OK;
}

} // namespace

namespace {

// Effective stress of undrained soil: tension positive, total + pore pressure.
void take_water_off(const Material& material, const double* excess, std::size_t n, double* const* stress) {
    for (int k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < n; ++i)
            stress[k][i] += material.water()->pressure + excess[i];
}

// The water resists the change of volume, and bears its share of the total stress.
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

} // namespace

namespace {

std::shared_ptr<const ElementReplay> call_of(const Material& material, const gault_points& p, std::size_t i) {
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
        call->states.erase(excess_pore_pressure.name); // the stress is the model's: effective
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

} // namespace

UpdateFailure update_batch(const Material& material, Points& points, const std::vector<Column>& state_old,
                           const Batch& batch, const BatchView& view, Workspace& workspace,
                           const Moment& moment, const GridView& grid, double* const* tangent,
                           const std::array<double*, 2>& moduli) {
    const std::size_t first = static_cast<std::size_t>(batch.first_page) * page_slots;
    const std::size_t n = static_cast<std::size_t>(batch.pages) * page_slots;
    if (n == 0) return {};
    Call whole(material, points, first, n, view, workspace, moment);
    rotate_states(material, state_old.data(), first, n, view, workspace.old_states.data());
    fill_inputs(material, whole.p, view, workspace, n, grid);
    if (material.water()) take_water_off(material, workspace.old_states.back(), n, view.stress_old);
    if (tangent && material.has_tangent()) std::copy_n(tangent, 36, whole.p.tangent);
    whole.p.modulus = moduli[0];
    whole.p.shear_modulus = moduli[1];

    gault_error error;
    gault_status status = call(material, whole.p, error);
    const double fraction = step_fraction(whole.p.suggest, 1.0 / 1024.0, 0.5);
    if (tangent) {
        if (status == GAULT_OK && !material.has_tangent())
            status = differentiate(material, whole, n, tangent, error);
    } else {
        for (int pieces = static_cast<int>(std::ceil(1.0 / fraction));
             status == GAULT_RETRY && pieces <= 1024; pieces *= 2)
            status = update_in_pieces(material, whole, n, pieces, error);
    }
    if (status == GAULT_OK) {
        if (material.water()) put_water_back(material, whole.p, tangent);
        return {};
    }
    UpdateFailure failure{status, std::nullopt,
                          status == GAULT_RETRY && !tangent
                              ? "the step had to be divided more than 1024 times"
                              : error_text(error),
                          fraction};
    if (error.point < 0) return failure;
    const std::size_t i = std::min(static_cast<std::size_t>(error.point), n - 1);
    failure.slot = first + i;
    if (status == GAULT_FAILED) failure.call = call_of(material, whole.p, i);
    return failure;
}

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

} // namespace

namespace {

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
        [&](gault_points& p, gault_error& error) {
            return material.api().update(material.instance().self(), &p, &error);
        });
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
