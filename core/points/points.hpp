// The material points of one material: a struct of arrays in the order of their layout.
#pragma once
#include "core/base/aligned.hpp"
#include "core/points/layout.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace gault::core {

constexpr uint32_t no_point = UINT32_MAX;

// Columns that a frame or a material does not need stay empty. A slot without a point has measure 0 and
// repeats the values of a point beside it.
struct PointColumns {
    std::array<Column, 2> place;  // total frame: coordinates in the cell, [0, 1]; updated frame: position, m
    Column measure;               // see BatchView::measure
    std::array<Column, 6> stress; // Cauchy, tension positive, xx yy zz xy yz zx; Pa
    std::vector<Column> state;    // declared states, component by component
    std::array<Column, 2> reference;   // updated frame: initial position, m
    std::array<Column, 2> velocity;    // updated frame, m/s
    Column mass;                       // updated frame, kg
    std::array<Column, 4> strain;      // updated frame with viscosity: of the last step, xx yy zz xy
    std::array<Column, 5> deformation; // updated frame, where a material wants F: xx xy yx yy zz

    template <class F>
    void each(F f) { // every column, in use or not
        visit(*this, f);
    }
    template <class F>
    void each(F f) const {
        visit(*this, f);
    }

  private:
    template <class Self, class F>
    static void visit(Self& self, F f) {
        for (auto& c : self.place)
            f(c);
        f(self.measure);
        for (auto& c : self.stress)
            f(c);
        for (auto& c : self.state)
            f(c);
        for (auto& c : self.reference)
            f(c);
        for (auto& c : self.velocity)
            f(c);
        f(self.mass);
        for (auto& c : self.strain)
            f(c);
        for (auto& c : self.deformation)
            f(c);
    }
};

class Points {
  public:
    // `columns` hold one value a point, in any order; `cell` and `identity` likewise.
    Points(PointColumns columns, const std::vector<int32_t>& cell, std::vector<uint32_t> identity,
           const LayoutRequest& request);

    PointColumns& columns() { return columns_; }
    const PointColumns& columns() const { return columns_; }
    const Layout& layout() const { return layout_; }
    std::size_t slots() const { return layout_.slots; }
    std::size_t count() const { return count_; }
    uint32_t identity(std::size_t slot) const { return identity_[slot]; } // no_point: empty

    // Calls f(slot) for every point, in the order of the slots.
    template <class F>
    void each_point(F f) const {
        for (std::size_t slot = 0; slot < layout_.slots; ++slot)
            if (identity_[slot] != no_point) f(slot);
    }

    struct Move {
        std::size_t slot;
        int32_t cell; // where it goes
    };
    // Takes points out of their pages and puts them into pages of their new cells; lays everything out anew
    // when a batch has no page left. `moves` in increasing order of slots.
    void relocate(const std::vector<Move>& moves);
    int version() const { return version_; } // of the layout's batches

  private:
    void place_all(PointColumns points, const std::vector<int32_t>& cell,
                   const std::vector<uint32_t>& identity);
    void copy_slot(std::size_t from, std::size_t to);
    void take_out(std::size_t slot, int batch);
    bool put_in(const std::vector<double>& point, uint32_t identity, int32_t cell);
    void lay_out_anew(const std::vector<std::vector<double>>& extra,
                      const std::vector<uint32_t>& extra_identity, const std::vector<int32_t>& extra_cell);
    void empty_slot(std::size_t slot);

    LayoutRequest request_;
    Layout layout_;
    PointColumns columns_;
    std::vector<uint32_t> identity_;
    std::size_t count_ = 0;
    int version_ = 0;
};

} // namespace gault::core
