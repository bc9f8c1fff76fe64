#include "core/registry/answer.hpp"
#include "core/solver/call.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace gault::core {
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
        if (const gault_status status = update(material, part.p, error); status != GAULT_OK) return status;
        for (int k = 0; k < 6; ++k)
            std::copy(part.p.stress[k], part.p.stress[k] + n, stress[k]);
        for (int k = 0; k < material.state_components(); ++k)
            std::copy(part.p.state[k], part.p.state[k] + n, state[k]);
    }
    return GAULT_OK;
}

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
        if (const gault_status status = update(material, shifted.p, error); status != GAULT_OK) return status;
        shifted.p.strain[column] = strain;
        for (int row = 0; row < 6; ++row)
            for (std::size_t q = 0; q < n; ++q)
                tangent[6 * row + column][q] = (stress[row][q] - whole.p.stress[row][q]) / shift;
    }
    return GAULT_OK;
}

} // namespace

UpdateFailure update_batch(const Material& material, Points& points, const std::vector<Column>& state_old,
                           const Batch& batch, const BatchView& view, Workspace& workspace,
                           const Moment& moment, const GridView& grid, const Asked& asked) {
    const std::size_t first = static_cast<std::size_t>(batch.first_page) * page_slots;
    const std::size_t n = static_cast<std::size_t>(batch.pages) * page_slots;
    if (n == 0) return {};
    Call whole(material, points, first, n, view, workspace, moment);
    rotate_states(material, state_old.data(), first, n, view, workspace.old_states.data());
    fill_inputs(material, whole.p, view, workspace, n, grid);
    if (material.water()) take_water_off(material, workspace.old_states.back(), n, view.stress_old);
    if (asked.tangent && material.has_tangent()) std::copy_n(asked.tangent, 36, whole.p.tangent);
    whole.p.modulus = asked.modulus;
    whole.p.shear_modulus = asked.shear_modulus;

    gault_error error;
    gault_status status = update(material, whole.p, error);
    const double fraction = step_fraction(whole.p.suggest, 1.0 / 1024.0, 0.5);
    if (asked.tangent) {
        if (status == GAULT_OK && !material.has_tangent())
            status = differentiate(material, whole, n, asked.tangent, error);
    } else {
        for (int pieces = static_cast<int>(std::ceil(1.0 / fraction));
             status == GAULT_RETRY && pieces <= 1024; pieces *= 2)
            status = update_in_pieces(material, whole, n, pieces, error);
    }
    if (status == GAULT_OK) {
        if (material.water()) put_water_back(material, whole.p, asked.tangent);
        return {};
    }
    UpdateFailure failure{status, std::nullopt,
                          status == GAULT_RETRY && !asked.tangent
                              ? "the step had to be divided more than 1024 times"
                              : error_text(error),
                          fraction};
    if (error.point < 0) return failure;
    const std::size_t i = std::min(static_cast<std::size_t>(error.point), n - 1);
    failure.slot = first + i;
    if (status == GAULT_FAILED) failure.call = replay(material, whole.p, i);
    return failure;
}

} // namespace gault::core
