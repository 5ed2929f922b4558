// Touches memory before timed work, so that a virtual machine's host has provided it by then.
#pragma once

#include <cstdint>

namespace terrabench::cross {

// Writes to `bytes` of new memory, or to 90 % of the available memory if that is less, and frees it. Does
// nothing if the system refuses the memory. The host of a virtual machine provides a page when the machine
// first uses it. This takes several times as long as the page fault within the machine, and no counter shows
// it. Without this function the first case that uses much memory would seem slow, and no later one. Takes
// seldom more than 2 µs per page of 4 KiB, or 9 µs where the host must provide the page.
void use_memory_once(std::uint64_t bytes);

}  // namespace terrabench::cross
