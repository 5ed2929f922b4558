#include "experiments/cross/fresh_pages.h"

#include <malloc.h>
#include <sys/mman.h>

#include <algorithm>
#include <limits>

#include "terrain/memory.h"

namespace terrabench::cross {

void use_memory_once(std::uint64_t bytes) {
  constexpr std::uint64_t kPage = 4096;
  bytes = std::min(bytes, available_memory() / 10 * 9);
  if (bytes < kPage) return;
  void* const block = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (block == MAP_FAILED) return;
  for (std::uint64_t at = 0; at < bytes; at += kPage) static_cast<volatile char*>(block)[at] = 1;
  munmap(block, bytes);
}

namespace {

constexpr int kLargest = 32 << 20;  // bytes; glibc maps larger blocks anew, and accepts no higher limit

}  // namespace

KeepFreedMemory::KeepFreedMemory() {
  mallopt(M_MMAP_THRESHOLD, kLargest);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
}

KeepFreedMemory::~KeepFreedMemory() {
  mallopt(M_TRIM_THRESHOLD, 2 * kLargest);
  malloc_trim(0);
}

}  // namespace terrabench::cross
