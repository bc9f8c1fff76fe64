#include "core/points/layout.hpp"
#include "core/transfer/kernels.hpp"

#include <gtest/gtest.h>

#include <set>

namespace gault::core {
namespace {

constexpr int columns = 7, rows = 3;

// `count(column, row)` points a cell, cell by cell
template <class Count>
std::vector<int32_t> points_in_cells(Count count) {
    std::vector<int32_t> cell;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            cell.insert(cell.end(), count(column, row), row * columns + column);
    return cell;
}

void expect_consistent(const Layout& layout, const std::vector<int32_t>& cell, int degree) {
    std::set<std::size_t> slots;
    for (std::size_t p = 0; p < cell.size(); ++p) {
        const std::size_t slot = layout.slot_of_point[p], page = slot / page_slots;
        EXPECT_TRUE(slots.insert(slot).second);
        ASSERT_LT(slot, layout.slots);
        EXPECT_LT(slot % page_slots, layout.page_live[page]);
        EXPECT_EQ(layout.page_column[page], cell[p] % columns);
        const Batch& batch = layout.batches[layout.batch_of_cell[cell[p]]];
        EXPECT_EQ(batch.cell_row, cell[p] / columns);
        EXPECT_GE(static_cast<int>(page), batch.first_page);
        EXPECT_LT(static_cast<int>(page), batch.first_page + batch.pages);
    }
    int page = 0;
    for (const Batch& batch : layout.batches) {
        EXPECT_EQ(batch.first_page, page);
        EXPECT_GE(batch.capacity, batch.pages);
        EXPECT_EQ(batch.patch_row, batch.columns + degree);
        page += batch.capacity;
    }
    EXPECT_EQ(layout.slots, static_cast<std::size_t>(page) * page_slots);
}

TEST(Layout, PutsEveryPointIntoAPageOfItsCell) {
    const auto cell = points_in_cells([](int column, int row) { return 1 + (3 * column + 5 * row) % 20; });
    for (const bool roaming : {false, true})
        expect_consistent(lay_out(cell, {columns, rows, 2, roaming}), cell, 2);
}

TEST(Layout, TakesPointsInAnyOrder) {
    auto cell = points_in_cells([](int, int) { return 9; });
    for (std::size_t i = 0; i < cell.size(); ++i)
        std::swap(cell[i], cell[(i * 7919) % cell.size()]);
    expect_consistent(lay_out(cell, {columns, rows, 1, false}), cell, 1);
}

TEST(Layout, SkipsCellsThatPointsNeverEnter) {
    const auto cell = points_in_cells([](int column, int row) { return row == 1 && column != 3 ? 4 : 0; });
    const Layout layout = lay_out(cell, {columns, rows, 1, false});
    ASSERT_EQ(layout.batches.size(), 2u);
    EXPECT_EQ(layout.batches[0].first_column, 0);
    EXPECT_EQ(layout.batches[0].columns, 3);
    EXPECT_EQ(layout.batches[1].first_column, 4);
    EXPECT_EQ(layout.batches[1].columns, 3);
    EXPECT_EQ(layout.batch_of_cell[columns + 3], -1);
    EXPECT_EQ(layout.batch_of_cell[0], -1);
}

TEST(Layout, CoversTheWholeGridAndKeepsSparePagesWherePointsRoam) {
    const auto cell = points_in_cells([](int column, int row) { return row == 1 && column < 2 ? 4 : 0; });
    const Layout layout = lay_out(cell, {columns, rows, 1, true});
    expect_consistent(layout, cell, 1);
    for (const int32_t batch : layout.batch_of_cell)
        ASSERT_GE(batch, 0);
    for (const Batch& batch : layout.batches)
        EXPECT_GE(batch.capacity, batch.pages + 4);
}

TEST(Layout, CutsRowsIntoBatchesOfTheWantedSize) {
    const auto cell = points_in_cells([](int, int) { return 16; }); // two pages a cell
    const Layout layout = lay_out(cell, {columns, rows, 1, false, 6});
    expect_consistent(layout, cell, 1);
    for (const Batch& batch : layout.batches) {
        EXPECT_LE(batch.pages, 6);
        EXPECT_EQ(batch.pages, 2 * batch.columns);
    }
    EXPECT_EQ(layout.batches.size(), static_cast<std::size_t>(rows) * 3);
}

} // namespace
} // namespace gault::core
