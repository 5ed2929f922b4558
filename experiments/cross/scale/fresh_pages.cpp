#include "experiments/cross/scale/fresh_pages.h"

#include <malloc.h>

#include <algorithm>
#include <memory>
#include <new>

#include "terrain/memory.h"

namespace terrabench::cross {

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
