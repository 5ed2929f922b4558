#include "experiments/cross/scale/cold_caches.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

namespace terrabench::cross {
namespace {

constexpr std::size_t kMiB = 1 << 20, kLine = 64;  // bytes

// Of the first core, in bytes; 0 if Linux does not say. sysconf may give the sum of the third-level caches of
// the whole processor, of which a virtual machine has only some.
std::size_t largest_cache() {
  std::size_t largest = 0;
  for (int k = 0;; ++k) {
    std::ifstream file(fmt::format("/sys/devices/system/cpu/cpu0/cache/index{}/size", k));
    std::size_t kilobytes = 0;  // such as 32768K
    if (!(file >> kilobytes)) return largest;
    largest = std::max(largest, kilobytes * 1024);
  }
}

}  // namespace

ColdCaches::ColdCaches()
    : bytes_(std::clamp(2 * largest_cache(), 64 * kMiB, 256 * kMiB)),
      block_(std::make_unique<char[]>(bytes_)) {}

// Writes rather than reads, so that the caches are full of modified lines, as after work on large ground. The
// timed work then also waits until these lines are written to memory.
void ColdCaches::evict() const {
  for (std::size_t at = 0; at < bytes_; at += kLine) ++block_[at];
}

}  // namespace terrabench::cross
