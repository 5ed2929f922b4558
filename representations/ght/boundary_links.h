// The boundary links of a grounded heightmap tree (Alonso, Joan-Arinyo & Solano, §3.2: "each cell in the
// boundary of a new heightmap is linked to the neighbor cell in another heightmap"; figure 11: one link per
// cell). A cell of any heightmap but the root has a link exactly while a triangle of the surface joins it to
// a cell of another heightmap; of several such cells it leads to the nearest one, of equally near ones to the
// first. The root's own links are null, as in the paper. Edit::commit() keeps the links current, also those
// of earlier heightmaps around a later event.
//
// Links are kept in one hash table, 8 bytes per slot, at most three quarters full: boundary cells are few
// among the cells, and a link in every cell would double the tree. Files do not hold them: they follow from
// the surface, so link_all() makes them again on loading, and a damaged file cannot hold wrong ones.
//
// of(), set() and erase() are O(1) on average, prepare() amortised O(1) per link, relink() O(squares and
// faces at the changed rim), link_all() O(samples + faces).
#pragma once

#include <span>
#include <vector>

#include "representations/ght/composed_surface.h"

namespace terrabench::ght {

class BoundaryLinks {
 public:
  // The linked cell; kNone if c has no link.
  CellId of(CellId c) const;
  std::size_t size() const { return size_; }
  // Makes room for `more` links; may throw. set() must not exceed that room.
  void prepare(std::size_t more);
  void set(CellId c, CellId target) noexcept;
  void erase(CellId c) noexcept;
  // Calls visit(cell, target) for every link, in no particular order.
  template <class Visit>
  void each(const Visit& visit) const {
    for (const Slot& slot : slots_) {
      if (slot.cell != kNone) visit(slot.cell, slot.target);
    }
  }
  Memory memory() const { return index_memory(slots_); }

 private:
  struct Slot {
    CellId cell = kNone, target = kNone;
  };
  static constexpr std::size_t kLeastSlots = 16;

  std::size_t home(CellId c) const {
    constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15U;  // spreads consecutive cells
    return static_cast<std::size_t>(((c * kGolden) >> 32U) * slots_.size() >> 32U);
  }
  std::size_t next(std::size_t slot) const { return slot + 1 == slots_.size() ? 0 : slot + 1; }
  // How far on from one slot to another.
  std::size_t steps(std::size_t from, std::size_t to) const {
    return to >= from ? to - from : to + slots_.size() - from;
  }
  std::size_t slot_of(CellId c) const;  // of the cell, or the empty one where it belongs

  std::vector<Slot> slots_;  // collisions move on to the next one
  std::size_t size_ = 0;
};

struct Model;

// What an event changed, for relink().
struct RimChange {
  std::vector<CellId> rim;  // cells that stay, at faces and squares that went
  std::size_t most = 0;     // links that relink() may add
};
// Call it before the event changes the surface. `superseded` must be ascending.
RimChange rim_change(const Model& model, std::span<const Square> covered, std::span<const FaceId> removed,
                     std::span<const CellId> superseded, std::span<const Face> added, NodeId first_new);
// Call it afterwards, with room for change.most links.
void relink(Model& model, const RimChange& change, std::span<const CellId> superseded,
            std::span<const Face> added, NodeId first_new) noexcept;

// Makes all links of a model that has none; may throw.
void link_all(Model& model);

}  // namespace terrabench::ght
