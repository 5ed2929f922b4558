// An array whose first elements have a block of their own: appending and removing later elements never moves
// them. So the cost of an event does not depend on the size of the root. Access is O(1), growth amortised
// O(1) per appended element.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "terrain/memory.h"

namespace terrabench::ght {

// Reserves room for `size` elements, at least doubling the capacity when that is too small.
template <class T>
void grow(std::vector<T>& v, std::size_t size) {
  if (size > v.capacity()) v.reserve(std::max(size, 2 * v.capacity()));
}

template <class T>
class TwoPartArray {
 public:
  TwoPartArray() = default;
  explicit TwoPartArray(std::vector<T> first) : first_(std::move(first)) {}

  std::size_t size() const { return first_.size() + second_.size(); }
  const T& operator[](std::size_t i) const {
    return i < first_.size() ? first_[i] : second_[i - first_.size()];
  }
  T& operator[](std::size_t i) { return i < first_.size() ? first_[i] : second_[i - first_.size()]; }
  T& back() { return second_.empty() ? first_.back() : second_.back(); }

  // The first resize of an empty array makes its first part, which never becomes shorter.
  void resize(std::size_t size, const T& value = {}) {
    if (first_.empty()) return first_.assign(size, value);
    second_.resize(std::max(size, first_.size()) - first_.size(), value);
  }
  void grow(std::size_t size) {
    if (size > first_.size() && !first_.empty()) ght::grow(second_, size - first_.size());
  }

  const std::vector<T>& first() const { return first_; }
  const std::vector<T>& second() const { return second_; }
  Memory payload() const {
    Memory memory = payload_memory(first_, second_);
    return memory;
  }
  Memory index() const {
    const Memory memory = payload();
    return {0, memory.payload, memory.slack};
  }

 private:
  std::vector<T> first_, second_;
};

}  // namespace terrabench::ght
