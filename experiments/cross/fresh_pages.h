// Touches memory before timed work, so that a virtual machine's host has provided it by then.
#pragma once

#include <cstdint>

namespace terrabench::cross {

// Uses so many bytes of new memory and gives them back. The host of a virtual machine provides a page when
// the machine first uses it, which takes several times as long as the page fault within the machine and is
// counted nowhere: without this, work on much memory would seem slow in the first case that uses so much, and
// only there. Seldom more than 2 µs per page of 4 KiB, 9 µs where the host must provide it. At most what is
// available; nothing if the system has no pages to give.
void use_memory_once(std::uint64_t bytes);

}  // namespace terrabench::cross
