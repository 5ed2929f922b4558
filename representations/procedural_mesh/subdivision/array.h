// A vector whose elements are not set to zero when it is sized: tables are filled by several threads, and a
// pass over hundreds of megabytes only to clear them would cost as much as filling them.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace terrabench::subdivision {

template <class T>
struct UninitialisedAllocator : std::allocator<T> {
  static_assert(std::is_trivially_copyable_v<T>);
  template <class U>
  struct rebind {
    using other = UninitialisedAllocator<U>;
  };
  template <class U>
  void construct(U* at) noexcept {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Args>
  void construct(U* at, Args&&... args) {
    ::new (static_cast<void*>(at)) U(std::forward<Args>(args)...);
  }
};

template <class T>
using Array = std::vector<T, UninitialisedAllocator<T>>;

// Frees the block of a vector; assigning {} would keep it.
template <class Vector>
void release(Vector& v) {
  Vector().swap(v);
}

}  // namespace terrabench::subdivision
