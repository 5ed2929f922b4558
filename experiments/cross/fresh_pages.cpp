#include "experiments/cross/fresh_pages.h"

#include <malloc.h>

#include <algorithm>
#include <memory>
#include <new>

#include "terrain/memory.h"

namespace terrabench::cross {

// By default, where freed memory has no room for a large block, glibc maps it from the system, and unmaps it
// when it is freed. M_MMAP_MAX 0 lets the heap grow instead.
KeepFreedMemory::KeepFreedMemory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);  // never
}

KeepFreedMemory::~KeepFreedMemory() {
  constexpr int kMost = 65536, kLargest = 32 << 20;  // glibc's default; its limit in bytes after large blocks
  mallopt(M_MMAP_MAX, kMost);
  mallopt(M_MMAP_THRESHOLD, kLargest);
  mallopt(M_TRIM_THRESHOLD, 2 * kLargest);
  give_back();
}

// One block, since glibc would place smaller ones in gaps that have no room for the largest block of the
// work.
void KeepFreedMemory::provide(std::uint64_t bytes) const {
  constexpr std::uint64_t kPage = 4096;
  bytes = std::min(bytes, available_memory() / 10 * 9);
  const std::unique_ptr<char[]> block(new (std::nothrow) char[bytes]);
  if (!block) return;
  for (std::uint64_t at = 0; at < bytes; at += kPage) static_cast<volatile char*>(block.get())[at] = 1;
}

void KeepFreedMemory::give_back() const { malloc_trim(0); }

}  // namespace terrabench::cross
