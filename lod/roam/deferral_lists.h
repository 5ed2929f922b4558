// Deferral of priority computations (Duchaineau et al. 1997, §7.4): a node is ranked again only when the
// camera has moved so far that its priority may have changed.
//
// The paper counts frames and assumes a bound on the camera's velocity. Here clocks advance by the camera's
// motion itself, so no assumption about later frames is needed. Turning moves far points more than near ones,
// so there is one clock per doubling of the distance: clock k advances by moved + 2^(k+1) m · turned.
// advance() is O(clocks + expired nodes).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lod/roam/node.h"
#include "lod/roam/wedgie_view.h"

namespace terrabench::roam {

class DeferralLists {
 public:
  DeferralLists() : table_(kClocks * kSlots) {}

  // The node must not be in a list.
  void defer(std::vector<Node>& nodes, std::uint32_t id, Validity);
  void remove(std::vector<Node>& nodes, std::uint32_t id) { table_.remove(nodes, id); }
  // Moves to `expired` every node whose validity the motion may have used up. Conservative: may move some too
  // early.
  void advance(std::vector<Node>& nodes, const Motion&, std::vector<std::uint32_t>& expired);

  Memory memory() const { return table_.memory(); }

 private:
  static constexpr int kClocks = 24;  // up to 16,000 km; farther nodes expire whenever the camera moves
  static constexpr int kSlots = 128;
  // Width of a slot as a share of the clock's distance. A node is deferred by at most a quarter of the
  // distance, so it stays within that distance.
  static constexpr double kSlot = 1.0 / 512;

  struct Clock {
    double now = 0;  // in slots
    std::int64_t slot = 0;
  };
  void expire(std::vector<Node>& nodes, int list, std::vector<std::uint32_t>& expired);

  std::array<Clock, kClocks> clocks_;
  DeferralTable table_;
};

}  // namespace terrabench::roam
