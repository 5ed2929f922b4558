#include "experiments/cross/cold_caches.h"

#include <cstddef>

namespace terrabench::cross {
namespace {

constexpr std::size_t kBlock = std::size_t{64} << 20, kLine = 64;  // bytes

}  // namespace

ColdCaches::ColdCaches() : block_(std::make_unique<char[]>(kBlock)) {}

// Writes, and does not only read: as after work on large ground, each line that the timed work brings in must
// wait until a changed one is written back.
void ColdCaches::empty() const {
  for (std::size_t at = 0; at < kBlock; at += kLine) ++block_[at];
}

}  // namespace terrabench::cross
