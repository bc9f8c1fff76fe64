#include "core/solver/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

namespace gault::core {

Motion::Motion(Grid& grid, std::vector<Material>& materials, std::vector<Points>& points, int threads)
    : grid_(grid), materials_(materials), points_(points),
      kernels_(select_kernels({grid.degree(0), grid.degree(1), grid.axisymmetric()})), team_(threads),
      largest_modulus_(materials.size()) {
    plan();
}

void Motion::plan() {
    tasks_.clear();
    tasks_of_row_.assign(grid_.axis(1).cells(), {});
    versions_.clear();
    std::size_t patch = 0, most = 0;
    for (int m = 0; m < static_cast<int>(points_.size()); ++m) {
        const auto& batches = points_[m].layout().batches;
        versions_.push_back(points_[m].version());
        for (int b = 0; b < static_cast<int>(batches.size()); ++b) {
            tasks_of_row_[batches[b].cell_row].push_back(static_cast<int>(tasks_.size()));
            tasks_.push_back({m, b, patch});
            patch += round_up(3 * static_cast<std::size_t>(batches[b].patch_row) * (grid_.degree(1) + 1), 8);
            most = std::max<std::size_t>(most, static_cast<std::size_t>(batches[b].capacity) * page_slots);
        }
    }
    patches_.assign(patch, 0.0);
    outcomes_.assign(tasks_.size(), {});
    workspaces_.clear();
    for (int t = 0; t < team_.threads(); ++t)
        workspaces_.emplace_back(most);
}

bool Motion::plan_is_stale() const {
    for (std::size_t m = 0; m < points_.size(); ++m)
        if (points_[m].version() != versions_[m]) return true;
    return false;
}

GridView view_of(const Grid& grid) {
    const auto axis = [](const Axis& a) {
        return AxisView{a.origin().data(), a.length().data(), a.inverse_length().data(), a.left().data(),
                        a.right().data()};
    };
    return {axis(grid.axis(0)), axis(grid.axis(1)), grid.layout().row, grid.radial()};
}

BatchView Motion::view(const Task& task) {
    Points& points = points_[task.material];
    const Batch& batch = points.layout().batches[task.batch];
    PointColumns& columns = points.columns();
    const std::size_t first = static_cast<std::size_t>(batch.first_page) * page_slots;
    const auto at = [first](Column& column) { return column.empty() ? nullptr : column.data() + first; };
    BatchView v{};
    v.pages = batch.pages;
    v.column = points.layout().page_column.data() + batch.first_page;
    v.cell_row = batch.cell_row;
    v.first_column = batch.first_column;
    v.node = static_cast<std::ptrdiff_t>(grid_.layout().index(0, batch.cell_row));
    v.patch_row = batch.patch_row;
    v.patch = patches_.data() + task.patch;
    for (int k = 0; k < 2; ++k) {
        v.place[k] = at(columns.place[k]);
        v.velocity[k] = at(columns.velocity[k]);
    }
    v.measure = at(columns.measure);
    v.mass = at(columns.mass);
    for (int k = 0; k < 6; ++k)
        v.stress[k] = at(columns.stress[k]);
    for (int k = 0; k < 4; ++k)
        v.strain[k] = at(columns.strain[k]);
    for (int k = 0; k < 5; ++k)
        v.deformation[k] = at(columns.deformation[k]);
    if (!viscosity_.empty()) {
        v.viscous_lame = viscosity_[task.material][0];
        v.viscous_shear = viscosity_[task.material][1];
    }
    return v;
}

void Motion::update_stress(const Task& task, const BatchView& view, Workspace& workspace,
                           const Moment& moment, Outcome& outcome) {
    const Material& material = materials_[task.material];
    const Batch& batch = points_[task.material].layout().batches[task.batch];
    double* modulus = asks_ ? workspace.column(Workspace::modulus) : nullptr;
    double* shear = asks_ ? workspace.column(Workspace::modulus + 1) : nullptr;
    static std::mutex legacy; // models with global state are called one at a time
    std::unique_lock<std::mutex> alone(legacy, std::defer_lock);
    if (material.one_at_a_time()) alone.lock();
    outcome.failure =
        update_batch(material, points_[task.material], points_[task.material].columns().state, batch, view,
                     workspace, moment, grid_view(), {.modulus = modulus, .shear_modulus = shear});
    if (!asks_) return;
    const double water = material.water() ? material.water()->stiffness : 0.0;
    std::array<double, page_slots> most{}; // slot by slot of a page: several at once
    for (int page = 0; page < batch.pages; ++page, modulus += page_slots)
        for (std::size_t k = 0; k < page_slots; ++k)
            most[k] = most[k] < modulus[k] ? modulus[k] : most[k];
    outcome.modulus = water + *std::max_element(most.begin(), most.end());
}

void Motion::clear_patch(const Task& task, int components) {
    const Batch& batch = points_[task.material].layout().batches[task.batch];
    std::fill_n(patches_.data() + task.patch,
                static_cast<std::size_t>(components) * batch.patch_row * (grid_.degree(1) + 1), 0.0);
}

void Motion::reduce(const std::vector<Column*>& fields) {
    const NodeLayout& layout = grid_.layout();
    const int degree = grid_.degree(1), cell_rows = grid_.axis(1).cells();
    each_row([&](int j, std::size_t begin, std::size_t) {
        for (Column* field : fields)
            std::fill_n(field->data() + begin, layout.row, 0.0);
        for (int row = std::max(0, j - degree); row <= std::min(j, cell_rows - 1); ++row)
            for (const int t : tasks_of_row_[row]) {
                const Batch& batch = points_[tasks_[t].material].layout().batches[tasks_[t].batch];
                const double* patch = patches_.data() + tasks_[t].patch +
                                      static_cast<std::ptrdiff_t>(j - row) * batch.patch_row;
                for (Column* field : fields) {
                    double* to = field->data() + layout.index(batch.first_column, j);
                    for (int i = 0; i < batch.patch_row; ++i)
                        to[i] += patch[i];
                    patch += static_cast<std::ptrdiff_t>(batch.patch_row) * (degree + 1);
                }
            }
    });
}

double Motion::probe_step(const VectorField& v) const {
    double fastest = 0.0, shortest = grid_.axis(0).length()[0];
    for (int k = 0; k < 2; ++k) {
        for (const double x : v.c[k])
            fastest = std::max(fastest, std::abs(x));
        for (const double h : grid_.axis(k).length())
            shortest = std::min(shortest, h);
    }
    return 1e-7 * shortest / fastest;
}

void Motion::elastic_stress(const std::array<Column, 2>& moduli, const Task& task, double dt, BatchView& view,
                            Workspace& workspace) {
    const std::size_t first =
        static_cast<std::size_t>(points_[task.material].layout().batches[task.batch].first_page) * page_slots;
    view.viscous_lame = view.viscous_shear = 0.0;
    double* stress[4];
    for (int k = 0; k < 4; ++k)
        view.stress[k] = stress[k] = workspace.column(Workspace::probe + k);
    for (int i = 0; i < view.pages * page_slots; ++i) {
        const double shear = moduli[1][first + i], lame = moduli[0][first + i] - 2.0 * shear;
        const double volumetric = lame * (view.strain[0][i] + view.strain[1][i] + view.strain[2][i]);
        for (int k = 0; k < 4; ++k)
            stress[k][i] = ((k < 3 ? volumetric : 0.0) + 2.0 * shear * view.strain[k][i]) / dt;
    }
}

void Motion::settle(const std::vector<Outcome>& outcomes) {
    largest_strain_ = 0.0;
    if (asks_) largest_modulus_.assign(materials_.size(), 0.0);
    updates_ += static_cast<int64_t>(point_count());
    for (std::size_t t = 0; t < outcomes.size(); ++t) {
        const auto& [strain, failure, modulus] = outcomes[t];
        const Task& task = tasks_[t];
        const Batch& batch = points_[task.material].layout().batches[task.batch];
        if (strain.bad >= 0) {
            const std::size_t slot = static_cast<std::size_t>(batch.first_page) * page_slots +
                                     static_cast<std::size_t>(strain.bad);
            throw InstabilityError(fmt::format(
                "the run became unstable: {} would be strained by more than {} in one step, or turned "
                "inside out",
                where(task.material, slot), strain_limit));
        }
        if (failure.status != GAULT_OK)
            throw PointError(sentence(task.material, failure), task.material, failure.call);
        largest_strain_ = std::max(largest_strain_, strain.largest);
        if (asks_) largest_modulus_[task.material] = std::max(largest_modulus_[task.material], modulus);
    }
}

std::size_t Motion::point_count() const {
    std::size_t n = 0;
    for (const Points& p : points_)
        n += p.count();
    return n;
}

std::string Motion::where(int material, std::size_t slot) const {
    const PointRecord at = record(material, slot);
    return fmt::format("point {} of '{}' at ({:.6g}, {:.6g}) m", points_[material].identity(slot),
                       materials_[material].name(), at.position[0], at.position[1]);
}

std::string Motion::sentence(int material, const UpdateFailure& failure) const {
    const std::string who = failure.slot ? where(material, *failure.slot)
                                         : fmt::format("material '{}'", materials_[material].name());
    const char* silence = failure.status == GAULT_RETRY ? "the step was too long, and no reason was given"
                                                        : "the model gave no result and no reason";
    return fmt::format("{}: {}", who, failure.text.empty() ? silence : failure.text);
}

} // namespace gault::core
