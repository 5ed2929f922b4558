// Gives timed work the same state of memory, whichever case ran before it.
#pragma once

#include <cstdint>

namespace terrabench::cross {

// While it lives, the process keeps the memory that is freed, and finds its pages again without page faults.
// By default glibc keeps more of it the larger the blocks are that were freed before, and the faults depend
// on the cases that ran before. The destructor gives the freed memory back to the system, and leaves glibc's
// limits as they are after large blocks were freed.
class KeepFreedMemory {
 public:
  KeepFreedMemory();
  ~KeepFreedMemory();
  KeepFreedMemory(const KeepFreedMemory&) = delete;
  KeepFreedMemory& operator=(const KeepFreedMemory&) = delete;

  // Uses `bytes` of memory once, or 90 % of what is available if that is less, and frees it. Work that needs
  // no more comes without page faults then, large blocks included. Nor does it wait for the host of a virtual
  // machine, which provides a page when the machine first uses it: that takes several times as long as the
  // page fault within the machine, and no counter shows it. Takes seldom more than 2 µs per page of 4 KiB, or
  // 9 µs where the host must provide the page; less than 0.1 µs where the process has the page already. Does
  // less if the system refuses the memory.
  void provide(std::uint64_t bytes) const;
  // Gives freed memory back to the system.
  void give_back() const;
};

}  // namespace terrabench::cross
