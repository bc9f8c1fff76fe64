// The background grid: two axes, nodes in rows along the first, fields over the nodes.
#pragma once
#include "core/grid/axis.hpp"

#include <array>
#include <cstddef>

namespace gault::core {

enum Side { low_x = 0, high_x = 1, low_y = 2, high_y = 3 }; // the first of Scene::surfaces
constexpr int normal_axis(int side) {
    return side / 2;
}
constexpr double outward(int side) { // component of the outward normal
    return side % 2 ? 1.0 : -1.0;
}

// Nodes are stored with a margin of two on every side, so that a stencil needs no special case at the rim.
// Row j of a field begins, margin included, at the aligned index row_begin(j).
struct NodeLayout {
    int nx = 0, ny = 0;     // nodes
    std::ptrdiff_t row = 0; // distance between node (i, j) and (i, j + 1)
    std::size_t size = 0;   // of a field's array

    static constexpr int margin = 2, lead = 8;
    NodeLayout() = default;
    NodeLayout(int nodes_x, int nodes_y);
    std::size_t index(int i, int j) const { return row_begin(j) + static_cast<std::size_t>(i + margin); }
    std::size_t row_begin(int j) const { return lead + static_cast<std::size_t>((j + margin) * row); }
};

struct VectorField { // a nodal vector, component by component
    std::array<Column, 2> c;
    explicit VectorField(const NodeLayout& layout) : c{Column(layout.size), Column(layout.size)} {}
    void clear();
};

class Grid {
  public:
    Grid(Axis x, Axis y, bool axisymmetric);

    const Axis& axis(int k) const { return axes_[k]; }
    Axis& axis(int k) { return axes_[k]; }
    const NodeLayout& layout() const { return layout_; }
    bool axisymmetric() const { return axisymmetric_; }
    int degree(int k) const { return axes_[k].degree(); }
    bool radial() const { return degree(1) == 0; } // plane strain along y, and nothing varies

    // Node indices (i, j) along a side, in increasing order of the tangential coordinate.
    int side_nodes(int side) const { return side < 2 ? layout_.ny : layout_.nx; }
    std::array<int, 2> side_node(int side, int k) const;

  private:
    std::array<Axis, 2> axes_;
    NodeLayout layout_;
    bool axisymmetric_;
};

} // namespace gault::core
