// What timed work finds of the memory that it asks for, made the same whichever case ran before.
#pragma once

#include <cstdint>

namespace terrabench::cross {

// Writes to `bytes` of new memory, or to 90 % of the available memory if that is less, and frees it. Does
// nothing if the system refuses the memory. The host of a virtual machine provides a page when the machine
// first uses it. This takes several times as long as the page fault within the machine, and no counter shows
// it. Without this function the first case that uses much memory would seem slow, and no later one. Takes
// seldom more than 2 µs per page of 4 KiB, or 9 µs where the host must provide the page.
void use_memory_once(std::uint64_t bytes);

// While it lives, the process keeps what is freed of blocks below 32 MiB, and work that is done again finds
// the pages that it used before. By default glibc raises its limits with the blocks that were freed so far,
// so that a page fault or none depends on which cases ran before. Afterwards the freed memory goes back to
// the system, and the limits are those that glibc ends at after large blocks.
class KeepFreedMemory {
 public:
  KeepFreedMemory();
  ~KeepFreedMemory();
  KeepFreedMemory(const KeepFreedMemory&) = delete;
  KeepFreedMemory& operator=(const KeepFreedMemory&) = delete;
};

}  // namespace terrabench::cross
