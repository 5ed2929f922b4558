// What timed work finds in memory: caches that hold nothing of it, and pages that are there already.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace terrabench::cross {

// Evicts what the processor's caches hold, so that timed work starts with cold caches.
class ColdCaches {
 public:
  ColdCaches();
  // Writes to a block of twice the size of the largest cache that Linux reports, but of 64 to 256 MiB. A
  // cache of more than 256 MiB would keep a part of its data. Writing 64 MiB takes about 10 ms.
  void evict() const;

 private:
  std::size_t bytes_;
  std::unique_ptr<char[]> block_;
};

// While it lives, the process keeps the memory that is freed, and uses it again without page faults. By
// default glibc keeps more of it the larger the blocks are that were freed before, so the number of faults
// depends on the sizes measured before. The destructor gives the freed memory back to the system, and leaves
// glibc's limits as they are after large blocks were freed, for tests that go on in the same process.
class KeepFreedMemory {
 public:
  KeepFreedMemory();
  ~KeepFreedMemory();
  KeepFreedMemory(const KeepFreedMemory&) = delete;
  KeepFreedMemory& operator=(const KeepFreedMemory&) = delete;

  // Allocates `bytes`, or 90 % of the available memory if that is less, writes to every page and frees the
  // block. Later allocations up to this size cause almost no page faults, even for large blocks. In a virtual
  // machine, the host also provides a page at its first use. That takes several times as long as the guest's
  // page fault, and the guest does not count it; later work does not wait for it. The first use of a page of
  // 4 KiB took 2 to 25 µs on the machines measured. Does nothing if the system refuses the memory.
  void provide(std::uint64_t bytes) const;
  // Gives freed memory back to the system.
  void give_back() const;
};

}  // namespace terrabench::cross
