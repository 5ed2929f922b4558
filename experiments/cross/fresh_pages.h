// Gives timed work the same state of memory, whichever case ran before it.
#pragma once

#include <cstdint>

namespace terrabench::cross {

// Writes to `bytes` of new memory, or to 90 % of the available memory if that is less, and frees it. Does
// nothing if the system refuses the memory. The host of a virtual machine provides a page when the machine
// first uses it. This takes several times as long as the page fault within the machine, and no counter shows
// it. Without this function the first case that uses much memory would seem slow, and no later one. Takes
// seldom more than 2 µs per page of 4 KiB, or 9 µs where the host must provide the page.
void use_memory_once(std::uint64_t bytes);

// While it lives, the process keeps up to 2 GiB of freed memory, so that work that is repeated finds the
// pages that it used before. Blocks of 32 MiB or more are the exception: the system always maps them anew. By
// default glibc keeps more memory the larger the blocks are that were freed before, and so page faults depend
// on the cases that ran before. The destructor gives the freed memory back to the system, and leaves glibc's
// limits as they are after large blocks were freed.
class KeepFreedMemory {
 public:
  KeepFreedMemory();
  ~KeepFreedMemory();
  KeepFreedMemory(const KeepFreedMemory&) = delete;
  KeepFreedMemory& operator=(const KeepFreedMemory&) = delete;
};

}  // namespace terrabench::cross
