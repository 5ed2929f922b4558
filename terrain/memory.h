// Memory, by part and by measurement. memory() of a structure says what each of its heap bytes is for;
// HeapCounter counts the same bytes in operator new. The two agree, and tests check it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <vector>

namespace terrabench {

struct Memory {
  std::size_t payload = 0;  // the data itself
  std::size_t index = 0;    // offsets, tables and nodes that lead to the payload
  std::size_t slack = 0;    // reserved and unused, rounding by operator new included
  std::size_t total() const { return payload + index + slack; }
  Memory& operator+=(const Memory& other);
};

// What a block from operator new counts for; 0 for null. It is the size that was asked for, rounded up as
// operator new does here (aligned blocks: to a KiB at least), and depends on nothing else: equal structures
// count equal bytes in every run. What the allocator adds, depending on what else lies on the heap, is not
// counted.
std::size_t heap_bytes(const void* block);

// The heap blocks of vectors as payload and slack, or as index and slack.
template <class T, class... Rest>
Memory payload_memory(const std::vector<T>& v, const Rest&... rest) {
  static_assert(std::is_trivially_copyable_v<T>,
                "elements with heap blocks of their own must be counted too");
  const std::size_t used = v.size() * sizeof(T);
  Memory memory{used, 0, heap_bytes(v.data()) - used};
  if constexpr (sizeof...(rest) > 0) memory += payload_memory(rest...);
  return memory;
}
template <class... Vectors>
Memory index_memory(const Vectors&... vectors) {
  const Memory m = payload_memory(vectors...);
  return {0, m.payload, m.slack};
}

// Counts every block that operator new hands out anywhere in the process, by heap_bytes(). Blocks that C
// libraries take from malloc directly (GDAL, Mesa) are not counted.
struct HeapCounter {
  static std::int64_t live();  // bytes held now, by all threads
  static std::int64_t peak();  // largest live() since the last reset_peak()
  static void reset_peak();
};

// The heap bytes that were allocated since construction and are still held.
class HeapScope {
 public:
  HeapScope() : before_(HeapCounter::live()) {}
  std::int64_t held() const { return HeapCounter::live() - before_; }

 private:
  std::int64_t before_;
};

// Physical memory in bytes, and how many of them are available: the lesser of the machine's and, in a
// container, its control group's.
std::uint64_t physical_memory();
std::uint64_t available_memory();
// Throws environment_error, with this advice, when so many bytes are not available. To be called before large
// allocations; costs some file reads.
void require_memory(std::uint64_t bytes, std::string_view what,
                    std::string_view advice = "choose a lower resolution, a larger step or less ground");

}  // namespace terrabench
