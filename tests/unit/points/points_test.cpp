#include "core/points/points.hpp"
#include "core/transfer/kernels.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <stdexcept>

namespace gault::core {
namespace {

constexpr int columns = 9, rows = 4;

// Every column in use holds a number of its own for every point: 1000 identity + the column's number.
PointColumns numbered(const std::vector<uint32_t>& identity) {
    PointColumns c;
    c.state.resize(3);
    int number = 0;
    c.each([&](Column& column) {
        ++number;
        if (number == 5) return; // one that nobody needs
        for (const uint32_t id : identity)
            column.push_back(1000.0 * id + number);
    });
    return c;
}

struct Population {
    std::vector<int32_t> cell;
    std::vector<uint32_t> identity;
    Points points;

    explicit Population(int per_cell)
        : cell(crowd(per_cell)), identity(shuffled(cell.size())),
          points(numbered(identity), cell, identity, {columns, rows, 2, true, 8}) {}

    static std::vector<int32_t> crowd(int per_cell) {
        std::vector<int32_t> cell;
        for (int c = 0; c < columns * rows; ++c)
            cell.insert(cell.end(), per_cell + c % 3, c);
        return cell;
    }
    static std::vector<uint32_t> shuffled(std::size_t n) {
        std::vector<uint32_t> identity(n);
        for (std::size_t i = 0; i < n; ++i)
            identity[i] = static_cast<uint32_t>((i * 7) % n);
        return identity;
    }
    std::map<uint32_t, int32_t> cells() const { // by identity
        std::map<uint32_t, int32_t> found;
        for (std::size_t p = 0; p < cell.size(); ++p)
            found[identity[p]] = cell[p];
        return found;
    }
};

// Every point of `expected` is there once, in a page of its cell, with its own numbers; nothing else is.
void expect_all_there(Points& points, const std::map<uint32_t, int32_t>& expected) {
    std::map<uint32_t, int32_t> found;
    const Layout& layout = points.layout();
    for (const Batch& batch : layout.batches)
        for (int page = batch.first_page; page < batch.first_page + batch.pages; ++page) {
            ASSERT_GT(layout.page_live[page], 0);
            for (int lane = 0; lane < page_slots; ++lane) {
                const std::size_t slot = static_cast<std::size_t>(page) * page_slots + lane;
                const uint32_t id = points.identity(slot);
                if (lane >= layout.page_live[page]) {
                    ASSERT_EQ(id, no_point);
                    ASSERT_EQ(points.columns().measure[slot], 0.0);
                    ASSERT_EQ(points.columns().mass[slot], 0.0);
                    ASSERT_NE(points.columns().stress[0][slot], 0.0) << "repeats a point beside it";
                    continue;
                }
                ASSERT_TRUE(found.emplace(id, batch.cell_row * columns + layout.page_column[page]).second);
                int number = 0;
                points.columns().each([&](Column& column) {
                    ++number;
                    if (column.empty()) return;
                    ASSERT_EQ(column[slot], 1000.0 * id + number);
                });
            }
        }
    ASSERT_EQ(found, expected);
    std::size_t visited = 0;
    points.each_point([&](std::size_t) { ++visited; });
    ASSERT_EQ(visited, expected.size());
    ASSERT_EQ(points.count(), expected.size());
}

std::size_t slot_of(const Points& points, uint32_t id) {
    for (std::size_t slot = 0; slot < points.slots(); ++slot)
        if (points.identity(slot) == id) return slot;
    throw std::logic_error("no such point");
}

TEST(Points, KeepTheirDataWhenTheyAreLaidOut) {
    Population p(10);
    expect_all_there(p.points, p.cells());
}

TEST(Points, KeepTheirDataThroughThousandsOfRandomMoves) {
    Population p(10);
    auto expected = p.cells();
    std::mt19937 random(1);
    for (int round = 0; round < 300; ++round) {
        std::vector<Points::Move> moves;
        p.points.each_point([&](std::size_t slot) {
            if (random() % 20) return;
            const auto to = static_cast<int32_t>(random() % (columns * rows));
            moves.push_back({slot, to});
            expected[p.points.identity(slot)] = to;
        });
        p.points.relocate(moves);
        expect_all_there(p.points, expected);
        if (HasFatalFailure()) return;
    }
}

TEST(Points, AreLaidOutAnewWhenABatchHasNoPageLeft) {
    Population p(10);
    auto expected = p.cells();
    const int version = p.points.version();
    std::vector<Points::Move> moves; // everybody into one cell
    p.points.each_point([&](std::size_t slot) { moves.push_back({slot, 5}); });
    for (auto& [id, cell] : expected)
        cell = 5;
    p.points.relocate(moves);
    EXPECT_GT(p.points.version(), version);
    expect_all_there(p.points, expected);
}

TEST(Points, StayWhereTheyAreInMemoryWhileABatchHasRoom) {
    Population p(10);
    const int version = p.points.version();
    const std::size_t before = slot_of(p.points, 3);
    p.points.relocate({{slot_of(p.points, 40), 0}});
    EXPECT_EQ(p.points.version(), version);
    EXPECT_EQ(slot_of(p.points, 3), before);
}

TEST(Points, LeaveAWholeRowOfCellsAndComeBack) {
    Population p(4);
    auto expected = p.cells();
    for (const int32_t to : {2 * columns, 1}) {
        std::vector<Points::Move> moves;
        p.points.each_point([&](std::size_t slot) {
            if (expected[p.points.identity(slot)] / columns == to / columns) return;
            moves.push_back({slot, to});
            expected[p.points.identity(slot)] = to;
        });
        p.points.relocate(moves);
        expect_all_there(p.points, expected);
    }
}

} // namespace
} // namespace gault::core
