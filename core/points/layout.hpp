// Where the points of one material lie in memory: pages of eight slots, each page in one grid cell, pages in
// batches, each batch in one row of cells.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gault::core {

struct Batch {
    int cell_row;
    int first_column, columns; // cells that its points may lie in
    int first_page, pages;     // pages in use
    int capacity;              // pages reserved
    int patch_row;             // nodes in a row of its patch
};

struct Layout {
    std::vector<Batch> batches;             // by cell row, then column
    std::vector<int32_t> page_column;       // of every reserved page
    std::vector<uint8_t> page_live;         // its points, in the first slots
    std::vector<int32_t> batch_of_cell;     // row * columns + column; -1 where the material has no batch
    std::vector<std::size_t> slot_of_point; // in the order of the cells given
    std::size_t slots = 0;
};

struct LayoutRequest {
    int columns, rows; // of cells
    int degree;        // of the basis along a row: the length of a patch's rows
    bool roaming;      // points may enter any cell: batches cover the whole grid and keep spare pages
    int pages_per_batch = 64;
};

// `cell` of every point, row * columns + column.
Layout lay_out(const std::vector<int32_t>& cell, const LayoutRequest& request);

} // namespace gault::core
