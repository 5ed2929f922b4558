// The memory of several vectors at once.
#pragma once

#include "terrain/memory.h"

namespace terrabench {

template <class A, class B, class... Rest>
Memory index_memory(const std::vector<A>& a, const std::vector<B>& b, const std::vector<Rest>&... rest) {
  Memory sum = index_memory(a);
  return sum += index_memory(b, rest...);
}
template <class A, class B, class... Rest>
Memory payload_memory(const std::vector<A>& a, const std::vector<B>& b, const std::vector<Rest>&... rest) {
  Memory sum = payload_memory(a);
  return sum += payload_memory(b, rest...);
}

}  // namespace terrabench
