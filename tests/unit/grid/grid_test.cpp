#include "core/grid/grid.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>

namespace gault::core {
namespace {

Grid grid(int degree) {
    return Grid(Axis(Axis::graded(0.0, 1.0, 5, 1.0), degree), Axis(Axis::graded(0.0, 1.0, 3, 1.0), degree),
                true);
}

TEST(NodeLayout, GivesEveryNodeAndItsMarginAPlaceOfItsOwn) {
    const NodeLayout layout(13, 4);
    std::set<std::size_t> seen;
    for (int j = -NodeLayout::margin; j < layout.ny + NodeLayout::margin; ++j)
        for (int i = -NodeLayout::margin; i < layout.nx + NodeLayout::margin; ++i) {
            EXPECT_LT(layout.index(i, j), layout.size);
            EXPECT_TRUE(seen.insert(layout.index(i, j)).second);
        }
}

TEST(NodeLayout, RowsBeginAligned) {
    const NodeLayout layout(13, 4);
    const Column field(layout.size);
    for (int j = -NodeLayout::margin; j < layout.ny + NodeLayout::margin; ++j)
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(field.data() + layout.row_begin(j)) % 64, 0u);
    EXPECT_EQ(layout.index(3, 2) - layout.index(3, 1), static_cast<std::size_t>(layout.row));
}

TEST(NodeLayout, AStencilOfTheLastRowStaysInsideTheArray) {
    const NodeLayout layout(16, 1);
    const std::size_t end = layout.row_begin(layout.ny - 1) + static_cast<std::size_t>(layout.row);
    EXPECT_LE(end + 2 * static_cast<std::size_t>(layout.row) + 2, layout.size);
    EXPECT_GE(layout.row_begin(0), 2 * static_cast<std::size_t>(layout.row) + 2);
}

TEST(Grid, HasOneNodeMoreThanCellsInALinearBasisAndTwoInAQuadratic) {
    EXPECT_EQ(grid(1).layout().nx, 6);
    EXPECT_EQ(grid(1).layout().ny, 4);
    EXPECT_EQ(grid(2).layout().nx, 7);
    EXPECT_EQ(grid(2).layout().ny, 5);
}

TEST(Grid, WalksItsSidesInIncreasingOrder) {
    const Grid g = grid(1);
    EXPECT_EQ(g.side_nodes(low_x), 4);
    EXPECT_EQ(g.side_nodes(high_y), 6);
    EXPECT_EQ(g.side_node(low_x, 2), (std::array{0, 2}));
    EXPECT_EQ(g.side_node(high_x, 2), (std::array{5, 2}));
    EXPECT_EQ(g.side_node(low_y, 4), (std::array{4, 0}));
    EXPECT_EQ(g.side_node(high_y, 4), (std::array{4, 3}));
}

TEST(Grid, SidesHaveOutwardNormalsAlongTheAxes) {
    EXPECT_EQ(normal_axis(low_x), 0);
    EXPECT_EQ(normal_axis(high_y), 1);
    EXPECT_EQ(outward(low_x), -1.0);
    EXPECT_EQ(outward(high_x), 1.0);
    EXPECT_EQ(outward(low_y), -1.0);
    EXPECT_EQ(outward(high_y), 1.0);
}

TEST(VectorField, ClearsBothComponents) {
    VectorField field(grid(1).layout());
    field.c[0][11] = field.c[1][12] = 1.0;
    field.clear();
    for (const Column& component : field.c)
        for (const double x : component)
            EXPECT_EQ(x, 0.0);
}

} // namespace
} // namespace gault::core
