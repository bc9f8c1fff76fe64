#include "core/solver/model.hpp"

#include <Eigen/LU>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace gault::core {
namespace {

struct Rule { // of integration on [0, 1]
    std::vector<double> at, weight;
};

// Gauss-Legendre by Newton's method on the Legendre polynomial, n <= 6.
Rule gauss_rule(int n) {
    Rule rule;
    for (int i = 0; i < n; ++i) {
        double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1.0;
        for (int iteration = 0; iteration < 50; ++iteration) {
            double p = 1.0, before = 0.0;
            for (int k = 0; k < n; ++k) {
                const double next = ((2.0 * k + 1.0) * x * p - k * before) / (k + 1.0);
                before = p;
                p = next;
            }
            slope = n * (x * p - before) / (x * x - 1.0);
            x -= p / slope;
        }
        rule.at.push_back(0.5 * (1.0 + x));
        rule.weight.push_back(1.0 / ((1.0 - x * x) * slope * slope));
    }
    return rule;
}

// Equally spaced points. Their weights are not quite equal: they integrate polynomials up to degree n - 1
// exactly, so that mass and internal force agree with the surface loads from the first step.
Rule uniform_rule(int n) {
    Rule rule;
    for (int i = 0; i < n; ++i)
        rule.at.push_back((i + 0.5) / n);
    Eigen::MatrixXd powers(n, n);
    Eigen::VectorXd moments(n);
    for (int k = 0; k < n; ++k) {
        moments[k] = 1.0 / (k + 1.0);
        for (int i = 0; i < n; ++i)
            powers(k, i) = std::pow(rule.at[i], k);
    }
    const Eigen::VectorXd weights = powers.partialPivLu().solve(moments);
    rule.weight.assign(weights.begin(), weights.end());
    return rule;
}

std::vector<int> assign_materials(const Scene& scene, std::vector<std::string>& description) {
    const int columns = scene.axes[0].cells, rows = scene.axes[1].cells;
    std::vector<int> material(static_cast<std::size_t>(columns) * rows, scene.base_material);
    for (const Region& region : scene.regions) {
        const auto& [first, last] = region.cells;
        for (int j = first[1]; j < last[1]; ++j)
            for (int i = first[0]; i < last[0]; ++i)
                material[static_cast<std::size_t>(j) * columns + i] = region.material;
        description.push_back(fmt::format("region {}: {} cells of '{}'", region.name,
                                          (last[0] - first[0]) * (last[1] - first[1]),
                                          scene.materials[region.material].name));
    }
    return material;
}

struct Seeds { // points of one material before they are laid out
    PointColumns columns;
    std::vector<int32_t> cell;
    std::vector<uint32_t> identity;
};

} // namespace

double Model::vertical_stress(const Scene& scene, int column, double y) const {
    const InitialStress& initial = scene.initial_stress;
    if (!initial.gravity) return initial.vertical;
    const double g = -scene.gravity[1];
    const Axis& axis = grid.axis(1);
    const auto density = [&](int row) {
        return materials[material_of_cell[static_cast<std::size_t>(row) * grid.axis(0).cells() + column]]
            .density();
    };
    double stress = initial.vertical + density(axis.cells() - 1) * g * initial.depth;
    for (int row = axis.cells() - 1; row >= 0; --row) {
        const double low = axis.knots()[row], high = axis.knots()[row + 1];
        if (y >= high) break;
        stress += density(row) * g * (high - std::max(low, y));
    }
    return stress;
}

std::function<SoilBehind(const std::array<double, 2>&)> Model::behind(const Scene& scene) {
    std::vector<std::array<Column, 2>> moduli(materials.size());
    for (std::size_t m = 0; m < moduli.size(); ++m)
        evaluate_moduli(materials[m], points[m], view_of(grid), undeformed, 0.0, moduli[m][0], moduli[m][1]);
    return [this, &scene, moduli = std::move(moduli)](const std::array<double, 2>& at) -> SoilBehind {
        const int column = grid.axis(0).cell_of(at[0]), row = grid.axis(1).cell_of(at[1]);
        const std::size_t cell = static_cast<std::size_t>(row) * grid.axis(0).cells() + column;
        const int m = material_of_cell[cell];
        const Layout& layout = points[m].layout();
        int page = layout.batches[layout.batch_of_cell[cell]].first_page; // the cell's first
        while (layout.page_column[page] != column)
            ++page;
        const std::size_t slot = static_cast<std::size_t>(page) * page_slots;
        const double vertical = -vertical_stress(scene, column, at[1]), rho = materials[m].density();
        const double p_wave = moduli[m][0][slot], shear = moduli[m][1][slot];
        return {std::sqrt(rho * p_wave),
                std::sqrt(rho * shear),
                shear,
                {scene.initial_stress.k0 * vertical, vertical, 0.0}};
    };
}

Model build_model(const Scene& scene) {
    const int degree = scene.basis == Basis::quadratic ? 2 : 1;
    const bool radial = scene.symmetry == Symmetry::radial;
    const auto axis = [&](int k) {
        return Axis(Axis::graded(scene.geometry.lower[k], scene.geometry.upper[k], scene.axes[k].cells,
                                 scene.axes[k].ratio),
                    k == 1 && radial ? 0 : degree);
    };
    Model model{Grid(axis(0), axis(1), scene.symmetry != Symmetry::plane_strain), {}, {}, {}, {}};
    const Grid& grid = model.grid;
    model.material_of_cell = assign_materials(scene, model.description);
    for (const MaterialUse& use : scene.materials)
        model.materials.emplace_back(use);

    const auto rule = [&](int n) {
        return scene.placement == Placement::gauss ? gauss_rule(n) : uniform_rule(n);
    };
    const int side = static_cast<int>(std::lround(std::sqrt(scene.points_per_cell)));
    const Rule along_x = rule(radial ? scene.points_per_cell : side), along_y = rule(radial ? 1 : side);
    const bool updated = scene.frame == Frame::updated;
    std::vector<Seeds> seeds(scene.materials.size());
    uint32_t identity = 0;
    const int columns = grid.axis(0).cells();
    for (int row = 0; row < grid.axis(1).cells(); ++row)
        for (int column = 0; column < columns; ++column) {
            const int cell = row * columns + column, m = model.material_of_cell[cell];
            const double hx = grid.axis(0).length()[column], hy = grid.axis(1).length()[row];
            Seeds& s = seeds[m];
            for (std::size_t b = 0; b < along_y.at.size(); ++b)
                for (std::size_t a = 0; a < along_x.at.size(); ++a) {
                    const double x = grid.axis(0).origin()[column] + along_x.at[a] * hx;
                    const double y = grid.axis(1).origin()[row] + along_y.at[b] * hy;
                    const double area = hx * hy * along_x.weight[a] * along_y.weight[b];
                    const double per_radius = grid.axisymmetric() ? 2.0 * std::numbers::pi * area : area;
                    const double volume = grid.axisymmetric() ? per_radius * x : area;
                    const double vertical = -model.vertical_stress(scene, column, y);
                    s.columns.place[0].push_back(updated ? x : along_x.at[a]);
                    s.columns.place[1].push_back(updated ? y : along_y.at[b]);
                    s.columns.measure.push_back(updated ? volume : per_radius);
                    for (int k = 0; k < 6; ++k)
                        s.columns.stress[k].push_back(k == 1  ? vertical
                                                      : k < 3 ? scene.initial_stress.k0 * vertical
                                                              : 0.0);
                    if (updated) {
                        s.columns.reference[0].push_back(x);
                        s.columns.reference[1].push_back(y);
                        s.columns.mass.push_back(model.materials[m].density() * volume);
                    }
                    s.cell.push_back(cell);
                    s.identity.push_back(identity++);
                }
        }
    for (std::size_t m = 0; m < seeds.size(); ++m) {
        Seeds& s = seeds[m];
        const std::size_t n = s.cell.size();
        s.columns.state.assign(model.materials[m].state_components(), Column(n));
        if (updated)
            for (Column& c : s.columns.velocity)
                c.resize(n);
        if (updated && scene.solver.viscosity > 0.0)
            for (Column& c : s.columns.strain)
                c.resize(n);
        if (updated && model.materials[m].finite_strain())
            for (int k = 0; k < 5; ++k)
                s.columns.deformation[k].assign(n, k == 0 || k > 2 ? 1.0 : 0.0);
        model.points.emplace_back(std::move(s.columns), s.cell, std::move(s.identity),
                                  LayoutRequest{columns, grid.axis(1).cells(), grid.degree(0), updated});
        try {
            start_material(model.materials[m], model.points[m], view_of(grid));
        } catch (const RunError& error) {
            throw InputError(scene.initial_stress.where, error.what());
        }
    }
    return model;
}

} // namespace gault::core
