#include "lod/roam/deferral_lists.h"

#include <algorithm>
#include <bit>

namespace terrabench::roam {
namespace {

double distance_of(int clock) { return static_cast<double>(std::uint64_t{2} << clock); }

}  // namespace

void DeferralLists::defer(std::vector<Node>& nodes, std::uint32_t id, Validity validity) {
  double motion = validity.motion;
  // The first clock whose distance exceeds reach · 4/3, from the exponent bits of the double.
  const auto exponent = static_cast<int>(std::bit_cast<std::uint64_t>(validity.reach * 4.0 / 3) >> 52) - 1023;
  int k = std::max(exponent, 0);
  if (k >= kClocks) {
    k = kClocks - 1;
    motion = 0;
  }
  const Clock& clock = clocks_[k];
  const double slots = std::min(std::max(motion, 0.0) / (kSlot * distance_of(k)), kSlots - 2.0);
  const auto slot = static_cast<std::int64_t>(clock.now + slots);
  table_.push(nodes, id, static_cast<std::uint16_t>(k * kSlots + slot % kSlots));
}

void DeferralLists::advance(std::vector<Node>& nodes, const Motion& motion,
                            std::vector<std::uint32_t>& expired) {
  if (motion.none()) return;
  for (int k = 0; k < kClocks; ++k) {
    Clock& clock = clocks_[k];
    const double step = (motion.moved + distance_of(k) * motion.turned) / (kSlot * distance_of(k));
    if (!(step < kSlots)) {
      for (int slot = 0; slot < kSlots; ++slot) expire(nodes, k * kSlots + slot, expired);
      clock = {};
      continue;
    }
    clock.now += step;
    const auto now = static_cast<std::int64_t>(clock.now);
    for (std::int64_t slot = clock.slot; slot <= now; ++slot) {
      expire(nodes, k * kSlots + static_cast<int>(slot % kSlots), expired);
    }
    clock.slot = now;
  }
}

void DeferralLists::expire(std::vector<Node>& nodes, int list, std::vector<std::uint32_t>& expired) {
  table_.drain(nodes, static_cast<std::uint16_t>(list), expired);
}

}  // namespace terrabench::roam
