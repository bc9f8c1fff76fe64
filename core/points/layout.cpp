#include "core/points/layout.hpp"
#include "core/transfer/kernels.hpp"

#include <algorithm>
#include <numeric>

namespace gault::core {
namespace {

int pages_for(int points) {
    return (points + page_slots - 1) / page_slots;
}

// Cuts a row of cells into batches of about the wanted number of pages.
void cut_row(int row, const std::vector<int>& count, const LayoutRequest& request,
             std::vector<Batch>& batches) {
    int column = 0;
    const auto empty = [&](int c) { return count[static_cast<std::size_t>(row) * request.columns + c] == 0; };
    while (column < request.columns) {
        if (!request.roaming && empty(column)) {
            ++column;
            continue;
        }
        Batch batch{row, column, 0, 0, 0, 0, 0};
        for (; column < request.columns && batch.pages < request.pages_per_batch; ++column) {
            if (!request.roaming && empty(column)) break;
            batch.pages += pages_for(count[static_cast<std::size_t>(row) * request.columns + column]);
            ++batch.columns;
        }
        batch.capacity = request.roaming ? batch.pages + batch.pages / 4 + 4 : batch.pages;
        batches.push_back(batch);
    }
}

} // namespace

Layout lay_out(const std::vector<int32_t>& cell, const LayoutRequest& request) {
    Layout layout;
    const std::size_t cells = static_cast<std::size_t>(request.columns) * request.rows;
    std::vector<int> count(cells, 0);
    for (const int32_t c : cell)
        ++count[c];
    for (int row = 0; row < request.rows; ++row)
        cut_row(row, count, request, layout.batches);

    layout.batch_of_cell.assign(cells, -1);
    std::vector<std::size_t> next(cells); // slot of the cell's next point
    int page = 0;
    for (std::size_t b = 0; b < layout.batches.size(); ++b) {
        Batch& batch = layout.batches[b];
        batch.first_page = page;
        batch.patch_row = batch.columns + request.degree;
        layout.page_column.resize(page + batch.capacity, batch.first_column);
        layout.page_live.resize(page + batch.capacity, 0);
        int at = page;
        for (int column = batch.first_column; column < batch.first_column + batch.columns; ++column) {
            const std::size_t c = static_cast<std::size_t>(batch.cell_row) * request.columns + column;
            layout.batch_of_cell[c] = static_cast<int32_t>(b);
            next[c] = static_cast<std::size_t>(at) * page_slots;
            for (int left = count[c]; left > 0; left -= page_slots, ++at) {
                layout.page_column[at] = column;
                layout.page_live[at] = static_cast<uint8_t>(std::min(left, page_slots));
            }
        }
        page += batch.capacity;
    }
    layout.slots = static_cast<std::size_t>(page) * page_slots;
    layout.slot_of_point.resize(cell.size());
    for (std::size_t p = 0; p < cell.size(); ++p)
        layout.slot_of_point[p] = next[cell[p]]++;
    return layout;
}

} // namespace gault::core
