#include "core/grid/grid.hpp"

#include <algorithm>

namespace gault::core {

NodeLayout::NodeLayout(int nodes_x, int nodes_y)
    : nx(nodes_x), ny(nodes_y), row(static_cast<std::ptrdiff_t>(round_up(nodes_x + 2 * margin, 8))),
      size(static_cast<std::size_t>(row) * (nodes_y + 2 * margin) + 2 * lead) {}

void VectorField::clear() {
    for (Column& component : c)
        std::fill(component.begin(), component.end(), 0.0);
}

Grid::Grid(Axis x, Axis y, bool axisymmetric)
    : axes_{std::move(x), std::move(y)}, layout_(axes_[0].nodes(), axes_[1].nodes()),
      axisymmetric_(axisymmetric) {}

std::array<int, 2> Grid::side_node(int side, int k) const {
    switch (side) {
    case low_x:
        return {0, k};
    case high_x:
        return {layout_.nx - 1, k};
    case low_y:
        return {k, 0};
    default:
        return {k, layout_.ny - 1};
    }
}

} // namespace gault::core
