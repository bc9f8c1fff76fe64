#include "core/points/points.hpp"
#include "core/transfer/kernels.hpp"

#include <algorithm>

namespace gault::core {

Points::Points(PointColumns columns, const std::vector<int32_t>& cell, std::vector<uint32_t> identity,
               const LayoutRequest& request)
    : request_(request), count_(cell.size()) {
    place_all(std::move(columns), cell, identity);
}

void Points::place_all(PointColumns points, const std::vector<int32_t>& cell,
                       const std::vector<uint32_t>& identity) {
    layout_ = lay_out(cell, request_);
    ++version_;
    identity_.assign(layout_.slots, no_point);
    for (std::size_t p = 0; p < cell.size(); ++p)
        identity_[layout_.slot_of_point[p]] = identity[p];
    points.each([&](Column& column) {
        if (column.empty()) return;
        Column placed(layout_.slots);
        for (std::size_t p = 0; p < cell.size(); ++p)
            placed[layout_.slot_of_point[p]] = column[p];
        column = std::move(placed);
    });
    columns_ = std::move(points);
    std::vector<std::size_t>().swap(layout_.slot_of_point);
    for (std::size_t page = 0; page < layout_.page_live.size(); ++page)
        for (int lane = layout_.page_live[page]; lane > 0 && lane < page_slots; ++lane) {
            copy_slot(page * page_slots, page * page_slots + lane);
            empty_slot(page * page_slots + lane);
        }
}

void Points::copy_slot(std::size_t from, std::size_t to) {
    columns_.each([&](Column& column) {
        if (!column.empty()) column[to] = column[from];
    });
    identity_[to] = identity_[from];
}

void Points::empty_slot(std::size_t slot) {
    identity_[slot] = no_point;
    columns_.measure[slot] = 0.0;
    if (!columns_.mass.empty()) columns_.mass[slot] = 0.0;
}

void Points::take_out(std::size_t slot, int batch_index) {
    Batch& batch = layout_.batches[batch_index];
    const std::size_t page = slot / page_slots;
    const std::size_t last = page * page_slots + --layout_.page_live[page];
    if (last != slot) copy_slot(last, slot);
    empty_slot(last);
    if (layout_.page_live[page] > 0) return;
    // The last page takes its place.
    const std::size_t final = static_cast<std::size_t>(batch.first_page) + --batch.pages;
    if (final == page) return;
    for (int lane = 0; lane < page_slots; ++lane)
        copy_slot(final * page_slots + lane, page * page_slots + lane);
    for (int lane = 0; lane < page_slots; ++lane)
        empty_slot(final * page_slots + lane);
    layout_.page_column[page] = layout_.page_column[final];
    layout_.page_live[page] = layout_.page_live[final];
    layout_.page_live[final] = 0;
}

bool Points::put_in(const std::vector<double>& point, uint32_t identity, int32_t cell) {
    Batch& batch = layout_.batches[layout_.batch_of_cell[cell]];
    const int column = cell % request_.columns;
    int page = batch.first_page;
    const int end = batch.first_page + batch.pages;
    while (page < end && (layout_.page_column[page] != column || layout_.page_live[page] == page_slots))
        ++page;
    const bool fresh = page == end;
    if (fresh) {
        if (batch.pages == batch.capacity) return false;
        ++batch.pages;
        layout_.page_column[page] = column;
    }
    const std::size_t slot = static_cast<std::size_t>(page) * page_slots + layout_.page_live[page]++;
    std::size_t k = 0;
    columns_.each([&](Column& c) {
        if (!c.empty()) c[slot] = point[k++];
    });
    identity_[slot] = identity;
    for (std::size_t lane = slot + 1; fresh && lane < slot + page_slots; ++lane) {
        copy_slot(slot, lane);
        empty_slot(lane);
    }
    return true;
}

void Points::relocate(const std::vector<Move>& moves) {
    std::vector<std::vector<double>> taken(moves.size());
    std::vector<uint32_t> identity(moves.size());
    std::vector<int32_t> cell(moves.size());
    for (std::size_t m = 0; m < moves.size(); ++m) {
        columns_.each([&](Column& c) {
            if (!c.empty()) taken[m].push_back(c[moves[m].slot]);
        });
        identity[m] = identity_[moves[m].slot];
        cell[m] = moves[m].cell;
    }
    std::size_t batch = layout_.batches.size();
    for (std::size_t m = moves.size(); m-- > 0;) { // from the back, so that what fills a hole has stayed
        const int page = static_cast<int>(moves[m].slot / page_slots);
        while (batch == layout_.batches.size() || layout_.batches[batch].first_page > page)
            --batch;
        take_out(moves[m].slot, static_cast<int>(batch));
    }
    for (std::size_t m = 0; m < moves.size(); ++m) {
        if (put_in(taken[m], identity[m], cell[m])) continue;
        lay_out_anew({taken.begin() + m, taken.end()}, {identity.begin() + m, identity.end()},
                     {cell.begin() + m, cell.end()});
        return;
    }
}

void Points::lay_out_anew(const std::vector<std::vector<double>>& extra,
                          const std::vector<uint32_t>& extra_identity,
                          const std::vector<int32_t>& extra_cell) {
    std::vector<std::size_t> slots;
    std::vector<int32_t> cell;
    std::vector<uint32_t> identity;
    for (const Batch& batch : layout_.batches)
        for (int page = batch.first_page; page < batch.first_page + batch.pages; ++page)
            for (int lane = 0; lane < layout_.page_live[page]; ++lane) {
                slots.push_back(static_cast<std::size_t>(page) * page_slots + lane);
                cell.push_back(batch.cell_row * request_.columns + layout_.page_column[page]);
                identity.push_back(identity_[slots.back()]);
            }
    cell.insert(cell.end(), extra_cell.begin(), extra_cell.end());
    identity.insert(identity.end(), extra_identity.begin(), extra_identity.end());
    std::size_t k = 0;
    columns_.each([&](Column& c) {
        if (c.empty()) return;
        Column dense;
        dense.reserve(cell.size());
        for (const std::size_t slot : slots)
            dense.push_back(c[slot]);
        for (const auto& point : extra)
            dense.push_back(point[k]);
        c = std::move(dense);
        ++k;
    });
    place_all(std::move(columns_), cell, identity);
}

} // namespace gault::core
