// Deferred priorities (Duchaineau et al. 1997, §7.4): nodes are put off until the camera's motion could have
// made a difference. Where the paper counts frames under a bound on the camera's velocity, these clocks run
// by the motion itself, so nothing is assumed about the frames to come. A turn moves far points more than
// near ones, hence a clock for each doubling of distance: clock k runs by moved + 2^(k+1) m · turned.
// Advancing is O(clocks + nodes due).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lod/roam/camera.h"
#include "lod/roam/node.h"

namespace terrabench::roam {

class Deadlines {
 public:
  Deadlines() : waiting_(kClocks * kSlots) {}

  // The node must not be waiting.
  void put_off(std::vector<Node>& nodes, std::uint32_t id, Patience);
  void remove(std::vector<Node>& nodes, std::uint32_t id) { waiting_.remove(nodes, id); }
  // Takes out and appends to `due` the nodes whose slack the motion may have used up, too early if not
  // exactly.
  void advance(std::vector<Node>& nodes, const Motion&, std::vector<std::uint32_t>& due);

  Memory memory() const { return waiting_.memory(); }

 private:
  static constexpr int kClocks =
      24;  // to 16,000 km; what lies farther is looked at whenever the camera moves
  static constexpr int kSlots = 128;
  // A slot's width as a share of the clock's distance: a node waits for a quarter of it at most, so that it
  // stays within the distance.
  static constexpr double kSlot = 1.0 / 512;

  struct Clock {
    double now = 0;  // in slots
    std::int64_t slot = 0;
  };
  void empty(std::vector<Node>& nodes, int list, std::vector<std::uint32_t>& due);

  std::array<Clock, kClocks> clocks_;
  WaitingLists waiting_;
};

}  // namespace terrabench::roam
