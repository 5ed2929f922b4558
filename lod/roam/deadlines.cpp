#include "lod/roam/deadlines.h"

#include <algorithm>
#include <cmath>

namespace terrabench::roam {
namespace {

double distance_of(int clock) { return std::ldexp(1.0, clock + 1); }

}  // namespace

void Deadlines::put_off(std::vector<Node>& nodes, std::uint32_t id, double slack, double reach) {
  int k = 0;
  std::frexp(reach * 4 / 3, &k);  // reach · 4/3 ≤ 2^k
  k = std::max(k - 1, 0);
  if (k >= kClocks) {
    k = kClocks - 1;
    slack = 0;
  }
  const Clock& clock = clocks_[k];
  const double wait = std::min(std::max(slack, 0.0) / (kSlot * distance_of(k)), kSlots - 2.0);
  const auto slot = static_cast<std::int64_t>(clock.now + wait);
  waiting_.push(nodes, id, static_cast<std::uint16_t>(k * kSlots + slot % kSlots));
}

void Deadlines::advance(std::vector<Node>& nodes, const Motion& motion, std::vector<std::uint32_t>& due) {
  if (motion.none()) return;
  for (int k = 0; k < kClocks; ++k) {
    Clock& clock = clocks_[k];
    const double step = (motion.moved + distance_of(k) * motion.turned) / (kSlot * distance_of(k));
    if (!(step < kSlots)) {
      for (int slot = 0; slot < kSlots; ++slot) empty(nodes, k * kSlots + slot, due);
      clock = {};
      continue;
    }
    clock.now += step;
    const auto now = static_cast<std::int64_t>(clock.now);
    for (std::int64_t slot = clock.slot; slot <= now; ++slot) {
      empty(nodes, k * kSlots + static_cast<int>(slot % kSlots), due);
    }
    clock.slot = now;
  }
}

void Deadlines::empty(std::vector<Node>& nodes, int list, std::vector<std::uint32_t>& due) {
  for (std::uint32_t id = waiting_.first(list); id != kNone; id = waiting_.first(list)) {
    due.push_back(id);
    waiting_.remove(nodes, id);
  }
}

}  // namespace terrabench::roam
