#include "core/solver/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace gault::core {
namespace {

std::size_t largest_batch(const Points& points) {
    std::size_t most = 0;
    for (const Batch& batch : points.layout().batches)
        most = std::max<std::size_t>(most, static_cast<std::size_t>(batch.capacity) * page_slots);
    return most;
}

// The first of `n` slots that holds a point whose stress is not finite.
std::optional<std::size_t> not_finite(const Points& points, std::size_t first, std::size_t n) {
    for (std::size_t slot = first; slot < first + n; ++slot)
        for (const Column& stress : points.columns().stress)
            if (points.identity(slot) != no_point && !std::isfinite(stress[slot])) return slot;
    return std::nullopt;
}

} // namespace

// Of the points of one material in one cell.
struct Equilibrium::CellWork {
    double volume = 0.0, start_volume = 0.0, initial_volume = 0.0; // m^3
    double slope[9][2] = {}; // of ln(volume) with the displacement of a node, 1/m
};

// Of one point: the basis on the deformed configuration and the strain of the step.
struct Equilibrium::PointWork {
    bool live = false;
    Motion::Site site;
    int functions = 0;
    double value[9], slope[9][2]; // N, and its gradient on the deformed configuration, 1/m
    double per_radius = 0.0;      // 1 / r now; 0 in plane strain
    double volume = 0.0;          // now, m^3
    double start_volume = 0.0;    // at the start of the step
    double hoop = 0.0;            // ln(r / r at the start)
    LogStrain strain{1.0, 0.0, 0.0, 1.0};
    std::array<double, 5> gradient_new; // F: xx xy yx yy zz
    const CellWork* cell = nullptr;     // where the volume is its cell's
    double swelling = 0.0;              // ln of stretch, in every direction, that makes it so
};

Equilibrium::Equilibrium(Model& model, Motion& motion, VolumetricStrain volumetric_strain)
    : model_(model), motion_(motion), volumetric_strain_(volumetric_strain) {
    tangent_.resize(36);
    for (std::size_t m = 0; m < model.points.size(); ++m)
        workspace_.emplace_back(0);
    make_room();
}

// Batches grow where points are laid out anew.
void Equilibrium::make_room() {
    for (std::size_t m = 0; m < workspace_.size(); ++m) {
        const std::size_t most = largest_batch(model_.points[m]);
        if (workspace_[m].slots() < most) workspace_[m] = Workspace(most);
        if (tangent_[0].size() >= most) continue;
        for (Column& column : tangent_)
            column.resize(most);
    }
}

bool Equilibrium::strain(const Motion::State& start, const VectorField& du, int material, std::size_t slot,
                         PointWork& w) const {
    const Grid& grid = motion_.grid();
    const NodeLayout& layout = grid.layout();
    w.site = motion_.site(start, material, slot);
    double h[4] = {}, move = 0.0; // d(du)/dX, and the radial part of du
    w.functions = 0;
    for (int b = 0; b <= grid.degree(1); ++b)
        for (int a = 0; a <= grid.degree(0); ++a, ++w.functions) {
            const std::size_t n = layout.index(w.site.i + a, w.site.j + b);
            const double nx = w.site.x.slope[a] * w.site.y.value[b],
                         ny = w.site.x.value[a] * w.site.y.slope[b];
            w.value[w.functions] = w.site.x.value[a] * w.site.y.value[b];
            w.slope[w.functions][0] = nx;
            w.slope[w.functions][1] = ny;
            for (int k = 0; k < 2; ++k) {
                h[2 * k] += nx * du.c[k][n];
                h[2 * k + 1] += ny * du.c[k][n];
            }
            move += w.value[w.functions] * du.c[0][n];
        }
    const auto& f = w.site.gradient; // at the start
    const double g[4] = {f[0] + h[0], f[1] + h[1], f[2] + h[2], f[3] + h[3]};
    const double det = g[0] * g[3] - g[1] * g[2], det_old = f[0] * f[3] - f[1] * f[2];
    const double radius = w.site.start_radius + move;
    if (!(det > 0.0) || (grid.axisymmetric() && !(radius > 0.0))) return false;
    const double step[4] = {(g[0] * f[3] - g[1] * f[2]) / det_old, (g[1] * f[0] - g[0] * f[1]) / det_old,
                            (g[2] * f[3] - g[3] * f[2]) / det_old, (g[3] * f[0] - g[2] * f[1]) / det_old};
    w.strain = LogStrain(step[0], step[1], step[2], step[3]);
    for (int n = 0; n < w.functions; ++n) {
        const double nx = w.slope[n][0], ny = w.slope[n][1];
        w.slope[n][0] = (nx * g[3] - ny * g[2]) / det;
        w.slope[n][1] = (ny * g[0] - nx * g[1]) / det;
    }
    w.volume = w.site.volume * det;
    w.start_volume = w.site.volume * det_old;
    w.hoop = w.per_radius = 0.0;
    if (grid.axisymmetric()) {
        w.volume *= radius / w.site.radius;
        w.start_volume *= w.site.start_radius / w.site.radius;
        w.per_radius = 1.0 / radius;
        w.hoop = std::log(radius / w.site.start_radius);
    }
    const auto& F = w.site.deformation;
    w.gradient_new = {step[0] * F[0] + step[1] * F[2], step[0] * F[1] + step[1] * F[3],
                      step[2] * F[0] + step[3] * F[2], step[2] * F[1] + step[3] * F[3],
                      grid.axisymmetric() ? F[4] * radius / w.site.start_radius : F[4]};
    return true;
}

// Volumes of points are stretched to that of their cell: J of every point becomes V / V0 of the cell, which no
// length of steps alters.
void Equilibrium::share_volume(std::vector<PointWork>& work, std::vector<CellWork>& cells,
                               const Batch& batch) const {
    const auto jacobian = [](const std::array<double, 5>& f) { return (f[0] * f[3] - f[1] * f[2]) * f[4]; };
    cells.assign(static_cast<std::size_t>(batch.columns), {});
    for (PointWork& w : work) {
        CellWork& cell = cells[static_cast<std::size_t>(w.site.i - batch.first_column)];
        w.cell = &cell;
        if (!w.live) continue;
        cell.volume += w.volume;
        cell.start_volume += w.start_volume;
        cell.initial_volume += w.start_volume / jacobian(w.site.deformation);
        for (int n = 0; n < w.functions; ++n) {
            cell.slope[n][0] += w.volume * (w.slope[n][0] + w.value[n] * w.per_radius);
            cell.slope[n][1] += w.volume * w.slope[n][1];
        }
    }
    for (CellWork& cell : cells)
        for (auto& slope : cell.slope)
            for (double& s : slope)
                s = cell.volume > 0.0 ? s / cell.volume : 0.0;
    for (PointWork& w : work) {
        const CellWork& cell = *w.cell;
        w.swelling = std::log(cell.volume / cell.start_volume * (w.start_volume / w.volume)) / 3.0;
        const double old = std::cbrt(cell.start_volume / cell.initial_volume / jacobian(w.site.deformation));
        const double now = std::cbrt(cell.volume / cell.initial_volume / jacobian(w.gradient_new));
        for (int k = 0; k < 5; ++k) {
            w.site.deformation[k] *= old;
            w.gradient_new[k] *= now;
        }
    }
}

Equilibrium::Answer Equilibrium::evaluate(const Motion::State& start, const VectorField& du,
                                          const Moment& moment, double limit, VectorField& internal,
                                          Stiffness& stiffness) {
    internal.clear();
    stiffness.clear();
    make_room();
    Answer all;
    for (int m = 0; m < static_cast<int>(model_.points.size()); ++m)
        for (const Batch& batch : model_.points[m].layout().batches) {
            if (batch.pages == 0) continue;
            const Answer one = evaluate(start, du, moment, limit, m, batch, internal, stiffness);
            all.largest_strain = std::max(all.largest_strain, one.largest_strain);
            if (!one.found) {
                const double strain = all.largest_strain;
                all = one;
                all.largest_strain = strain;
                return all;
            }
        }
    all.found = true;
    return all;
}

Equilibrium::Answer Equilibrium::evaluate(const Motion::State& start, const VectorField& du,
                                          const Moment& moment, double limit, int m, const Batch& batch,
                                          VectorField& internal, Stiffness& stiffness) {
    Material& material = model_.materials[m];
    Points& points = model_.points[m];
    const PointColumns& old = start.points[m].columns();
    Workspace& workspace = workspace_[m];
    const std::size_t first = static_cast<std::size_t>(batch.first_page) * page_slots;
    const std::size_t n = static_cast<std::size_t>(batch.pages) * page_slots;
    BatchView view{};
    view.pages = batch.pages;
    view.column = points.layout().page_column.data() + batch.first_page;
    view.cell_row = batch.cell_row;
    attach_workspace(material, workspace, view);

    Answer answer;
    const int updates_a_point = material.has_tangent() ? 1 : 1 + tangent_columns;
    std::vector<PointWork> work(n);
    for (std::size_t i = 0; i < n; ++i) {
        PointWork& w = work[i];
        w.live = points.identity(first + i) != no_point;
        // An empty slot repeats the point beside it.
        if (!w.live && i > 0)
            w = work[i - 1], w.live = false;
        else if (!strain(start, du, m, first + i, w))
            return answer;
    }
    std::vector<CellWork> cells;
    if (volumetric_strain_ == VolumetricStrain::cell_mean) share_volume(work, cells, batch);
    for (std::size_t i = 0; i < n; ++i) {
        const PointWork& w = work[i];
        const LogStrain& e = w.strain;
        view.strain[0][i] = e.xx + w.swelling;
        view.strain[1][i] = e.yy + w.swelling;
        view.strain[2][i] = w.hoop + w.swelling;
        view.strain[3][i] = e.xy;
        for (int k = 0; k < 4; ++k)
            answer.largest_strain = std::max(answer.largest_strain, std::abs(view.strain[k][i]));
        const bool rotate = !material.finite_strain();
        const double c = rotate ? e.cosine : 1.0, s = rotate ? e.sine : 0.0;
        const std::size_t slot = first + i;
        const double xx = old.stress[0][slot], yy = old.stress[1][slot], xy = old.stress[3][slot];
        const double yz = old.stress[4][slot], zx = old.stress[5][slot];
        view.stress_old[0][i] = c * c * xx - 2.0 * c * s * xy + s * s * yy;
        view.stress_old[1][i] = s * s * xx + 2.0 * c * s * xy + c * c * yy;
        view.stress_old[2][i] = old.stress[2][slot];
        view.stress_old[3][i] = c * s * (xx - yy) + (c * c - s * s) * xy;
        view.stress_old[4][i] = c * yz + s * zx;
        view.stress_old[5][i] = c * zx - s * yz;
        if (view.rotation[0]) {
            view.rotation[0][i] = c;
            view.rotation[1][i] = -s; // the kernels turn the other way round
        }
        for (int k = 0; k < 5 && view.gradient_old[0]; ++k) {
            view.gradient_old[k][i] = w.site.deformation[k];
            view.gradient_new[k][i] = w.gradient_new[k];
        }
        if (view.volume_ratio) {
            const auto& f = w.gradient_new;
            view.volume_ratio[i] = (f[0] * f[3] - f[1] * f[2]) * f[4];
        }
        updates_ += w.live ? updates_a_point : 0;
    }
    if (answer.largest_strain > limit) return answer;

    double* tangent[36];
    for (int k = 0; k < 36; ++k)
        tangent[k] = tangent_[k].data();
    const UpdateFailure failure = update_batch(material, points, old.state, batch, view, workspace, moment,
                                               view_of(motion_.grid()), {.tangent = tangent});
    if (failure.status != GAULT_OK) {
        answer.fraction = failure.fraction;
        answer.reason = motion_.sentence(m, failure);
        if (failure.status != GAULT_RETRY)
            answer.failed = std::make_shared<PointError>(answer.reason, m, failure.call);
        return answer;
    }
    if (const auto slot = not_finite(points, first, n)) {
        answer.reason = motion_.where(m, *slot) + ": the stress is not finite";
        return answer;
    }
    assemble(work, batch, m, tangent, internal, stiffness);
    answer.found = true;
    return answer;
}

// Internal force -v (sigma g + hoop) and its derivative. With l = du (x) g, l_h = du_r / r, d(sigma) the spin
// of the stress and the tangent times the strain rate:
//   d[v (sigma g_a)] = v [(tr l + l_h) sigma g_a + d(sigma) g_a - sigma l^T g_a], likewise for the hoop
//   stress.
// Where the volume is the cell's, the strain has a third of d ln(V_cell) - tr l - l_h more in each direction.
void Equilibrium::assemble(const std::vector<PointWork>& work, const Batch& batch, int material,
                           const double* const* tangent, VectorField& internal, Stiffness& stiffness) const {
    const Points& points = model_.points[material];
    const Grid& grid = motion_.grid();
    const std::size_t first = static_cast<std::size_t>(batch.first_page) * page_slots;
    static constexpr int component[4] = {0, 1, 2, 3}; // xx yy zz xy of the six
    for (std::size_t i = 0; i < work.size(); ++i) {
        const PointWork& w = work[i];
        if (!w.live) continue;
        double s[4], d[4][4];
        for (int k = 0; k < 4; ++k) {
            s[k] = points.columns().stress[component[k]][first + i];
            for (int m = 0; m < 4; ++m)
                d[k][m] = tangent[component[k] * 6 + component[m]][i];
        }
        // d(P)/d(l): P = force per gradient, xx xy yx yy and hoop; l = xx xy yx yy and hoop.
        double a[5][5];
        for (int q = 0; q < 5; ++q) {
            double l[5] = {};
            l[q] = 1.0;
            const LogStrain::Rate e = w.strain.rate(l[0], l[1], l[2], l[3]);
            const double trace = l[0] + l[3] + l[4], own = w.cell ? trace / 3.0 : 0.0;
            double ds[4];
            for (int k = 0; k < 4; ++k)
                ds[k] =
                    d[k][0] * (e.xx - own) + d[k][1] * (e.yy - own) + d[k][2] * (l[4] - own) + d[k][3] * e.xy;
            ds[0] -= 2.0 * e.spin * s[3];
            ds[1] += 2.0 * e.spin * s[3];
            ds[3] += e.spin * (s[0] - s[1]);
            a[0][q] = trace * s[0] + ds[0] - s[0] * l[0] - s[3] * l[1];
            a[1][q] = trace * s[3] + ds[3] - s[0] * l[2] - s[3] * l[3];
            a[2][q] = trace * s[3] + ds[3] - s[3] * l[0] - s[1] * l[1];
            a[3][q] = trace * s[1] + ds[1] - s[3] * l[2] - s[1] * l[3];
            a[4][q] = trace * s[2] + ds[2] - s[2] * l[4];
        }
        double bulk[4]; // d(sigma) / d ln(V_cell)
        for (int k = 0; k < 4; ++k)
            bulk[k] = w.volume * (d[k][0] + d[k][1] + d[k][2]) / 3.0;
        const double of_cell[5] = {bulk[0], bulk[3], bulk[3], bulk[1], bulk[2]};
        const int width = grid.degree(0) + 1;
        const auto node = [&](int n) {
            return std::array<int, 2>{w.site.i + n % width, w.site.j + n / width};
        };
        for (int n = 0; n < w.functions; ++n) {
            const double gx = w.slope[n][0], gy = w.slope[n][1], hoop = w.value[n] * w.per_radius;
            const std::size_t at = grid.layout().index(node(n)[0], node(n)[1]);
            internal.c[0][at] -= w.volume * (s[0] * gx + s[3] * gy + s[2] * hoop);
            internal.c[1][at] -= w.volume * (s[3] * gx + s[1] * gy);
        }
        for (int m = 0; m < w.functions; ++m) { // columns: displacement of node m
            const double gx = w.slope[m][0], gy = w.slope[m][1], hoop = w.value[m] * w.per_radius;
            double px[5], py[5];
            for (int k = 0; k < 5; ++k) {
                px[k] = w.volume * (a[k][0] * gx + a[k][1] * gy + a[k][4] * hoop);
                py[k] = w.volume * (a[k][2] * gx + a[k][3] * gy);
                if (!w.cell) continue;
                px[k] += of_cell[k] * w.cell->slope[m][0];
                py[k] += of_cell[k] * w.cell->slope[m][1];
            }
            for (int n = 0; n < w.functions; ++n) {
                const double x = w.slope[n][0], y = w.slope[n][1], h = w.value[n] * w.per_radius;
                stiffness.add(node(n), node(m),
                              {{px[0] * x + px[1] * y + px[4] * h, py[0] * x + py[1] * y + py[4] * h},
                               {px[2] * x + px[3] * y, py[2] * x + py[3] * y}});
            }
        }
    }
}

} // namespace gault::core
