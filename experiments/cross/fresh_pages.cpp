#include "experiments/cross/fresh_pages.h"

#include <malloc.h>

#include <algorithm>
#include <memory>
#include <new>
#include <vector>

#include "terrain/memory.h"

namespace terrabench::cross {
namespace {

// Bytes. Where the freed memory has no room for a larger block, glibc maps it from the system, and unmaps it
// when it is freed. It accepts no higher limit.
constexpr int kLargest = 32 << 20;

}  // namespace

KeepFreedMemory::KeepFreedMemory() {
  mallopt(M_MMAP_THRESHOLD, kLargest);
  mallopt(M_TRIM_THRESHOLD, -1);  // never
}

KeepFreedMemory::~KeepFreedMemory() {
  mallopt(M_TRIM_THRESHOLD, 2 * kLargest);
  give_back();
}

void KeepFreedMemory::provide(std::uint64_t bytes) const {
  constexpr std::uint64_t kBlock = kLargest / 2, kPage = 4096;
  const std::uint64_t all = std::min(bytes, available_memory() / 10 * 9);
  std::vector<std::unique_ptr<char[]>> blocks((all + kBlock - 1) / kBlock);
  for (auto& block : blocks) {
    block.reset(new (std::nothrow) char[kBlock]);
    if (!block) return;
    for (std::uint64_t at = 0; at < kBlock; at += kPage) static_cast<volatile char*>(block.get())[at] = 1;
  }
}

void KeepFreedMemory::give_back() const { malloc_trim(0); }

}  // namespace terrabench::cross
