#include "terrain/memory.h"

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <new>
#include <string>

#include "terrain/error.h"

namespace terrabench {
namespace {

constinit std::atomic<std::int64_t> g_live{0}, g_peak{0};

// How glibc's malloc sizes blocks. With the kFront bytes that it keeps in front of each, they are multiples
// of 16 bytes and at least 32: a free block that is 16 bytes too long cannot be split and is given whole;
// aligned blocks may be 32 bytes too long. Requests are rounded up to multiples of more than this excess, so
// that without_excess() can remove it: of 32 bytes; above kSmall, and for all aligned blocks, of 64. Blocks
// above kLarge come, as malloc chooses, from the heap or as pages of their own, with 16 bytes in front. Both
// can give whole pages less kPageRest; the excess is below a page for alignments up to half a page.
constexpr std::size_t kFront = 8, kSmall = 1024, kFine = 32, kCoarse = 64;
constexpr std::size_t kLarge = 124 << 10, kPage = 4096, kPageRest = 24;

std::size_t round_up(std::size_t size) {
  if (size > SIZE_MAX - 2 * kPage) throw std::bad_alloc();
  const auto to_multiple = [](std::size_t n, std::size_t of) { return (n + of - 1) / of * of; };
  if (size > kLarge) return to_multiple(size + kPageRest, kPage) - kPageRest;
  const std::size_t length = std::max<std::size_t>(size, 1) + kFront;
  return to_multiple(length, length <= kSmall ? kFine : kCoarse) - kFront;
}

// What round_up() asked for, from the size of the block that malloc gave.
std::size_t without_excess(std::size_t usable) {
  const std::size_t length = usable + kFront;
  if (length > kLarge + 2 * kCoarse) return (usable + kPageRest) / kPage * kPage - kPageRest;
  const std::size_t multiple = length < kSmall + kCoarse ? kFine : kCoarse;
  return length / multiple * multiple - kFront;
}

// Sanitizers give what is asked for and watch what lies behind: there the count alone is rounded.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

std::size_t to_ask(std::size_t size) {
  const std::size_t rounded = round_up(size);
  return kSanitized ? std::max<std::size_t>(size, 1) : rounded;
}

void* count_in(void* block) {
  const auto size = static_cast<std::int64_t>(heap_bytes(block));
  const std::int64_t live = g_live.fetch_add(size, std::memory_order_relaxed) + size;
  std::int64_t peak = g_peak.load(std::memory_order_relaxed);
  while (live > peak && !g_peak.compare_exchange_weak(peak, live, std::memory_order_relaxed)) {
  }
  return block;
}

void count_out(void* block) {
  if (block != nullptr) {
    g_live.fetch_sub(static_cast<std::int64_t>(heap_bytes(block)), std::memory_order_relaxed);
  }
}

void* allocate(std::size_t size) {
  void* const block = std::malloc(to_ask(size));
  if (block == nullptr) throw std::bad_alloc();
  return count_in(block);
}

void* allocate(std::size_t size, std::align_val_t align) {
  void* block = nullptr;
  const std::size_t alignment = std::max(static_cast<std::size_t>(align), sizeof(void*));
  // At least kSmall: in smaller blocks, rounded to 32, an excess of 32 bytes would go unnoticed.
  if (posix_memalign(&block, alignment, to_ask(kSanitized ? size : std::max(size, kSmall))) != 0)
    throw std::bad_alloc();
  return count_in(block);
}

}  // namespace

std::size_t heap_bytes(const void* block) {
  if (block == nullptr) return 0;
  const std::size_t usable = malloc_usable_size(const_cast<void*>(block));
  return kSanitized ? round_up(usable) : without_excess(usable);
}

Memory& Memory::operator+=(const Memory& other) {
  payload += other.payload;
  index += other.index;
  slack += other.slack;
  return *this;
}

std::int64_t HeapCounter::live() { return g_live.load(std::memory_order_relaxed); }
std::int64_t HeapCounter::peak() { return g_peak.load(std::memory_order_relaxed); }
void HeapCounter::reset_peak() { g_peak.store(live(), std::memory_order_relaxed); }

std::uint64_t physical_memory() {
  return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
}

std::uint64_t available_memory() {
  std::ifstream info("/proc/meminfo");
  std::uint64_t available = physical_memory();
  for (std::string key, unit; info >> key;) {
    std::uint64_t kib = 0;
    if (!(info >> kib)) break;
    std::getline(info, unit);
    if (key == "MemAvailable:") available = kib * 1024;
  }
  // "max" where the group has no limit, no file where there is no group: neither reads as a number.
  std::uint64_t limit = 0, used = 0;
  if (std::ifstream("/sys/fs/cgroup/memory.max") >> limit &&
      std::ifstream("/sys/fs/cgroup/memory.current") >> used) {
    // Pages of files count as used, but the kernel frees them when memory is needed.
    std::ifstream parts("/sys/fs/cgroup/memory.stat");
    std::uint64_t bytes = 0;
    for (std::string key; parts >> key >> bytes;) {
      if (key == "inactive_file" || key == "active_file") used -= std::min(used, bytes);
    }
    available = std::min(available, limit - std::min(limit, used));
  }
  return available;
}

void require_memory(std::uint64_t bytes, std::string_view what, std::string_view advice) {
  if (const std::uint64_t available = available_memory(); bytes > available) {
    constexpr double kGiB = 0x1p30;
    throw environment_error(
        fmt::format("needs {:.1f} GiB of memory, {:.1f} GiB are free", static_cast<double>(bytes) / kGiB,
                    static_cast<double>(available) / kGiB),
        what, advice);
  }
}

}  // namespace terrabench

// The global allocation functions, replaced in every program that links terrain.
void* operator new(std::size_t size) { return terrabench::allocate(size); }
void* operator new[](std::size_t size) { return terrabench::allocate(size); }
void* operator new(std::size_t size, std::align_val_t align) { return terrabench::allocate(size, align); }
void* operator new[](std::size_t size, std::align_val_t align) { return terrabench::allocate(size, align); }
// The forms that return null call those above by default, but not under sanitizers, which replace them.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept try {
  return terrabench::allocate(size);
} catch (const std::bad_alloc&) {
  return nullptr;
}
void* operator new[](std::size_t size, const std::nothrow_t& tag) noexcept { return operator new(size, tag); }
void* operator new(std::size_t size, std::align_val_t align, const std::nothrow_t&) noexcept try {
  return terrabench::allocate(size, align);
} catch (const std::bad_alloc&) {
  return nullptr;
}
void* operator new[](std::size_t size, std::align_val_t align, const std::nothrow_t& tag) noexcept {
  return operator new(size, align, tag);
}
void operator delete(void* block) noexcept {
  terrabench::count_out(block);
  std::free(block);
}
void operator delete[](void* block) noexcept { operator delete(block); }
void operator delete(void* block, std::size_t) noexcept { operator delete(block); }
void operator delete[](void* block, std::size_t) noexcept { operator delete(block); }
void operator delete(void* block, std::align_val_t) noexcept { operator delete(block); }
void operator delete[](void* block, std::align_val_t) noexcept { operator delete(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { operator delete(block); }
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept { operator delete(block); }
