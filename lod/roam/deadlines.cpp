#include "lod/roam/deadlines.h"

#include <algorithm>
#include <bit>

namespace terrabench::roam {
namespace {

double distance_of(int clock) { return static_cast<double>(std::uint64_t{2} << clock); }

}  // namespace

void Deadlines::put_off(std::vector<Node>& nodes, std::uint32_t id, Patience patience) {
  double slack = patience.slack;
  // The first clock whose distance is over reach · 4/3: the exponent of a double, by its bits.
  const auto exponent = static_cast<int>(std::bit_cast<std::uint64_t>(patience.reach * 4.0 / 3) >> 52) - 1023;
  int k = std::max(exponent, 0);
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
  waiting_.clear(nodes, static_cast<std::uint16_t>(list), due);
}

}  // namespace terrabench::roam
