#include "experiments/cross/scale/memory_state.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <fstream>
#include <new>

#include "terrain/memory.h"

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

// By default, if no free block is large enough, glibc allocates a block above M_MMAP_THRESHOLD with mmap, and
// calls munmap when it is freed. With M_MMAP_MAX 0 it extends the heap instead, and the process keeps the
// pages.
KeepFreedMemory::KeepFreedMemory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);  // never
}

KeepFreedMemory::~KeepFreedMemory() {
  constexpr int kMost = 65536;        // default of M_MMAP_MAX
  constexpr int kLargest = 32 << 20;  // bytes, the highest M_MMAP_THRESHOLD that glibc accepts
  mallopt(M_MMAP_MAX, kMost);
  mallopt(M_MMAP_THRESHOLD, kLargest);
  mallopt(M_TRIM_THRESHOLD, 2 * kLargest);
  give_back();
}

// Allocates one block: glibc could place several small ones in fragments of free memory, of which none might
// fit the largest block that the timed work allocates.
void KeepFreedMemory::provide(std::uint64_t bytes) const {
  constexpr std::uint64_t kPage = 4096;
  bytes = std::min(bytes, available_memory() / 10 * 9);
  const std::unique_ptr<char[]> block(new (std::nothrow) char[bytes]);
  if (!block) return;
  for (std::uint64_t at = 0; at < bytes; at += kPage) static_cast<volatile char*>(block.get())[at] = 1;
}

void KeepFreedMemory::give_back() const { malloc_trim(0); }

}  // namespace terrabench::cross
