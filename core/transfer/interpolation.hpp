// From nodes to the points of a page and back, for the kernels. Everything stays in the namespace of the
// instruction set that the including file is compiled for.
#pragma once
#include "core/transfer/kernels.hpp"
#include <gault/pack.hpp>

#define GAULT_INLINE_LAMBDA __attribute__((always_inline))

namespace gault::core::GAULT_ISA {

using gault::Pack;
static_assert(page_slots % pack_lanes == 0);

template <int Degree>
struct Weights { // along one axis, for a pack of points in one cell
    Pack value[Degree + 1], slope[Degree + 1];
};

template <int Degree>
GAULT_INLINE Weights<Degree> weights(const AxisView& axis, int cell, Pack xi) {
    const Pack a = Pack(1.0) - xi, per_length = axis.inverse_length[cell];
    Weights<Degree> w;
    if constexpr (Degree == 0) {
        w.value[0] = 1.0;
        w.slope[0] = 0.0;
    } else if constexpr (Degree == 1) {
        w.value[0] = a;
        w.value[1] = xi;
        w.slope[0] = -per_length;
        w.slope[1] = per_length;
    } else {
        const Pack la = a * axis.left[cell], rx = xi * axis.right[cell], twice = per_length + per_length;
        w.value[0] = la * a;
        w.value[2] = rx * xi;
        w.value[1] = Pack(1.0) - w.value[0] - w.value[2];
        w.slope[0] = -(la * twice);
        w.slope[2] = rx * twice;
        w.slope[1] = -(w.slope[0] + w.slope[2]);
    }
    return w;
}

struct Gathered {
    Pack value, dx, dy;
};

// sum_ab N_a(x) N_b(y) f_ab and its gradient, one axis after the other.
template <int DX, int DY>
GAULT_INLINE Gathered gather(const double* f, std::ptrdiff_t row, const Weights<DX>& x,
                             const Weights<DY>& y) {
    Gathered g{0.0, 0.0, 0.0};
    for (int b = 0; b <= DY; ++b, f += row) {
        Pack s = x.value[0] * Pack(f[0]), d = x.slope[0] * Pack(f[0]);
        for (int a = 1; a <= DX; ++a) {
            s += x.value[a] * Pack(f[a]);
            d += x.slope[a] * Pack(f[a]);
        }
        g.value += y.value[b] * s;
        g.dx += y.value[b] * d;
        g.dy += y.slope[b] * s;
    }
    return g;
}

template <int DX, int DY>
GAULT_INLINE Pack gather_value(const double* f, std::ptrdiff_t row, const Weights<DX>& x,
                               const Weights<DY>& y) {
    Pack g = 0.0;
    for (int b = 0; b <= DY; ++b, f += row) {
        Pack s = x.value[0] * Pack(f[0]);
        for (int a = 1; a <= DX; ++a)
            s += x.value[a] * Pack(f[a]);
        g += y.value[b] * s;
    }
    return g;
}

// Sums of a cell's nodes over the points of the pages that follow one another in that cell.
template <int DX, int DY, int Components>
struct Accumulator {
    Pack sums[Components][DY + 1][DX + 1];

    GAULT_INLINE void clear() {
        for (auto& component : sums)
            for (auto& row : component)
                for (Pack& p : row)
                    p = 0.0;
    }
    GAULT_INLINE void flush(const BatchView& batch, int column) {
        double* at = batch.patch + (column - batch.first_column);
        for (auto& component : sums)
            for (auto& row : component) {
                for (int a = 0; a <= DX; ++a)
                    at[a] += sum(row[a]);
                at += batch.patch_row;
            }
        clear();
    }
};

template <int DX, int DY, int Components, class Page>
GAULT_INLINE void scatter_pages(const BatchView& batch, Page page) {
    Accumulator<DX, DY, Components> nodes;
    nodes.clear();
    for (int p = 0; p < batch.pages; ++p) {
        for (int slot = p * page_slots; slot < (p + 1) * page_slots; slot += pack_lanes)
            page(nodes, slot, batch.column[p]);
        if (p + 1 == batch.pages || batch.column[p + 1] != batch.column[p])
            nodes.flush(batch, batch.column[p]);
    }
}

} // namespace gault::core::GAULT_ISA
