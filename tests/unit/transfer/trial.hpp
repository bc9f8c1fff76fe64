// A small graded grid with random fields and points, on which any variant of the kernels can be run.
#pragma once
#include "core/grid/grid.hpp"
#include "core/points/points.hpp"
#include "core/transfer/kernels.hpp"

#include <array>
#include <random>
#include <vector>

namespace gault::core {

constexpr int trial_columns = 5, trial_rows = 3;

struct SlotResults { // what the strain kernels write, one value a slot
    std::array<Column, 4> strain;
    std::array<Column, 6> stress_old;
    std::array<Column, 2> rotation;
    std::array<Column, 5> flux, gradient_old, gradient_new;
    Column volume_ratio;

    explicit SlotResults(std::size_t slots) : volume_ratio(slots) {
        each([&](Column& c) { c.resize(slots); });
    }
    template <class F>
    void each(F f) {
        for (auto& c : strain)
            f(c);
        for (auto& c : stress_old)
            f(c);
        for (auto& c : rotation)
            f(c);
        for (auto& c : flux)
            f(c);
        for (auto& c : gradient_old)
            f(c);
        for (auto& c : gradient_new)
            f(c);
        f(volume_ratio);
    }
};

class Trial {
    std::mt19937_64 random_{7}; // before what is made with it

  public:
    int degree;
    bool axisymmetric, updated;
    Axis x, y;
    NodeLayout layout;
    VectorField velocity, displacement, acceleration;
    Points points;

    Trial(int degree_, bool axisymmetric_, bool updated_)
        : degree(degree_), axisymmetric(axisymmetric_), updated(updated_),
          x(Axis::graded(axisymmetric_ ? 0.0 : -0.3, 1.7, trial_columns, 1.2), degree_),
          y(Axis::graded(-1.0, 0.5, trial_rows, 0.8), degree_), layout(x.nodes(), y.nodes()),
          velocity(layout), displacement(layout), acceleration(layout), points(make_points()) {
        for (VectorField* field : {&velocity, &displacement, &acceleration})
            for (Column& c : field->c)
                for (double& value : c)
                    value = uniform(-1.0, 1.0);
        for (Column& c : displacement.c) // far from rigid, but no cell turned inside out
            for (double& value : c)
                value *= 0.05;
        if (axisymmetric)
            for (int j = 0; j < y.nodes(); ++j)
                for (VectorField* field : {&velocity, &displacement, &acceleration})
                    field->c[0][layout.index(0, j)] = 0.0;
    }

    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    GridView grid() const {
        const auto view = [](const Axis& a) {
            return AxisView{a.origin().data(), a.length().data(), a.inverse_length().data(), a.left().data(),
                            a.right().data()};
        };
        return {view(x), view(y), layout.row};
    }
    StrainInput input(double dt, bool rotate = true, double limit = 10.0) const {
        return {{velocity.c[0].data(), velocity.c[1].data()},
                {displacement.c[0].data(), displacement.c[1].data()},
                dt,
                limit,
                rotate};
    }

    // Calls f(view) for every batch and sums the patches of `components` nodal fields.
    template <class F>
    std::vector<Column> sweep(SlotResults& results, int components, F f) {
        std::vector<Column> fields(static_cast<std::size_t>(components), Column(layout.size));
        for (const Batch& batch : points.layout().batches) {
            Column patch(static_cast<std::size_t>(components * batch.patch_row * (degree + 1)));
            BatchView v = view(batch, results);
            v.patch = patch.data();
            f(v);
            const double* from = patch.data();
            for (Column& field : fields)
                for (int b = 0; b <= degree; ++b)
                    for (int a = 0; a < batch.patch_row; ++a)
                        field[layout.index(batch.first_column + a, batch.cell_row + b)] += *from++;
        }
        return fields;
    }

    BatchView view(const Batch& batch, SlotResults& r) {
        const std::size_t first = static_cast<std::size_t>(batch.first_page) * page_slots;
        PointColumns& c = points.columns();
        const auto at = [first](Column& column) { return column.empty() ? nullptr : column.data() + first; };
        BatchView v{};
        v.pages = batch.pages;
        v.column = points.layout().page_column.data() + batch.first_page;
        v.cell_row = batch.cell_row;
        v.first_column = batch.first_column;
        v.node = static_cast<std::ptrdiff_t>(layout.index(0, batch.cell_row));
        v.patch_row = batch.patch_row;
        for (int k = 0; k < 2; ++k) {
            v.place[k] = at(c.place[k]);
            v.velocity[k] = at(c.velocity[k]);
            v.rotation[k] = at(r.rotation[k]);
        }
        for (int k = 0; k < 4; ++k)
            v.strain[k] = at(r.strain[k]);
        for (int k = 0; k < 6; ++k) {
            v.stress[k] = at(c.stress[k]);
            v.stress_old[k] = at(r.stress_old[k]);
        }
        for (int k = 0; k < 5; ++k) {
            v.deformation[k] = at(c.deformation[k]);
            v.flux[k] = at(r.flux[k]);
            v.gradient_old[k] = at(r.gradient_old[k]);
            v.gradient_new[k] = at(r.gradient_new[k]);
        }
        v.measure = at(c.measure);
        v.mass = at(c.mass);
        v.volume_ratio = at(r.volume_ratio);
        return v;
    }

    int cell_row(std::size_t slot) const { // of a point
        const int page = static_cast<int>(slot / page_slots);
        for (const Batch& batch : points.layout().batches)
            if (page >= batch.first_page && page < batch.first_page + batch.pages) return batch.cell_row;
        return -1;
    }
    int cell_column(std::size_t slot) const { return points.layout().page_column[slot / page_slots]; }

  private:
    Points make_points() {
        std::vector<int32_t> cell;
        std::vector<uint32_t> identity;
        for (int c = 0; c < trial_columns * trial_rows; ++c)
            for (int n = 0; n < 9 + c % 4; ++n) { // pages that are not full
                cell.push_back(c);
                identity.push_back(static_cast<uint32_t>(identity.size()));
            }
        PointColumns c;
        const auto fill = [&](Column& column, double low, double high) {
            for (std::size_t i = 0; i < cell.size(); ++i)
                column.push_back(uniform(low, high));
        };
        for (Column& s : c.stress)
            fill(s, -1.0, 1.0);
        fill(c.measure, 0.5, 1.5);
        for (Column& p : c.place)
            fill(p, 0.02, 0.98);
        if (updated) {
            for (std::size_t i = 0; i < cell.size(); ++i) {
                const int column = cell[i] % trial_columns, row = cell[i] / trial_columns;
                c.place[0][i] = x.origin()[column] + c.place[0][i] * x.length()[column];
                c.place[1][i] = y.origin()[row] + c.place[1][i] * y.length()[row];
            }
            for (Column& v : c.velocity)
                fill(v, -1.0, 1.0);
            fill(c.mass, 1.0, 2.0);
            for (int k = 0; k < 5; ++k)
                fill(c.deformation[k], k == 1 || k == 2 ? -0.2 : 0.8, k == 1 || k == 2 ? 0.2 : 1.2);
        }
        return Points(std::move(c), cell, identity, {trial_columns, trial_rows, degree, updated, 4});
    }
};

} // namespace gault::core
