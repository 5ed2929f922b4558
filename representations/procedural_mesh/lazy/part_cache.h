// A cache of parts that are made when they are needed and dropped when they were not used for the longest
// time: the caching scheme that "meshgrow" (Tobler, Maierhofer and Wilkie) leaves to future work (§6, §8).
//
// The cache never holds more than its bound, parts in use included: to add a part, it drops the parts that
// were used least recently and are not in use, and waits for users where that is not enough. A part is
// counted from the moment it is complete; what its making takes besides is the maker's. Thread-safe: each
// part is made by one thread, and others that ask for it wait. O(1) per use.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>
#include <vector>

#include "terrain/error.h"

namespace terrabench::growing {

struct CacheCounts {
  std::uint64_t hits = 0, misses = 0, evictions = 0;
  std::size_t peak_bytes = 0;  // largest number of bytes held at once
};

// Value has bytes(), which does not change.
template <class Value>
class PartCache {
 public:
  using Key = std::uint64_t;

  explicit PartCache(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  // Calls make() unless the part is held, then use() with the part, which stays while use() runs. Neither may
  // use the cache. Throws what they throw; environment_error for a part that alone exceeds the bound.
  template <class Make, class Use>
  void with(Key key, const Make& make, const Use& use) {
    const auto release = [this](Entry* entry) {
      const std::lock_guard lock(mutex_);
      if (--entry->users == 0) changed_.notify_all();
    };
    const std::unique_ptr<Entry, decltype(release)> pin(&acquire(key, make), release);
    use(std::as_const(*pin->value));
  }

  std::size_t bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
  }
  CacheCounts counts() const {
    const std::lock_guard lock(mutex_);
    return counts_;
  }
  // From the part used last to the one that is dropped first.
  std::vector<Key> order() const {
    const std::lock_guard lock(mutex_);
    return {order_.begin(), order_.end()};
  }
  // Calls visit(part) for each part held. No part may be in use.
  template <class Visit>
  void each(const Visit& visit) const {
    const std::lock_guard lock(mutex_);
    for (const Key key : order_) visit(std::as_const(*entries_.at(key).value));
  }

 private:
  struct Entry {
    std::unique_ptr<Value> value;  // null while a thread makes it
    std::size_t bytes = 0;
    unsigned users = 0;
    std::list<Key>::iterator at;  // in order_, once there is a value
  };

  // References to entries stay valid when the map grows. One that has users, or no value yet, is not erased
  // by others.
  template <class Make>
  Entry& acquire(Key key, const Make& make) {
    std::unique_lock lock(mutex_);
    for (;;) {
      const auto found = entries_.find(key);
      if (found == entries_.end()) break;
      Entry& entry = found->second;
      if (entry.value != nullptr) {
        ++counts_.hits;
        ++entry.users;
        order_.splice(order_.begin(), order_, entry.at);
        return entry;
      }
      changed_.wait(lock);  // made by another thread; if that fails, this one tries
    }
    ++counts_.misses;
    Entry& entry = entries_[key];
    lock.unlock();
    std::unique_ptr<Value> value;
    std::size_t bytes = 0;
    try {
      value = make();
      bytes = value->bytes();
      if (bytes > most_bytes_) refuse(bytes);
    } catch (...) {
      lock.lock();
      entries_.erase(key);
      changed_.notify_all();
      throw;
    }
    lock.lock();
    make_room(lock, bytes);
    entry.value = std::move(value);
    entry.bytes = bytes;
    entry.users = 1;
    order_.push_front(key);
    entry.at = order_.begin();
    bytes_ += bytes;
    counts_.peak_bytes = std::max(counts_.peak_bytes, bytes_);
    changed_.notify_all();
    return entry;
  }

  // A thread that waits here holds no other part, so those that are in use are released at last.
  void make_room(std::unique_lock<std::mutex>& lock, std::size_t bytes) {
    while (bytes_ + bytes > most_bytes_) {
      auto oldest = order_.end();
      for (auto at = order_.end(); at != order_.begin() && oldest == order_.end();) {
        if (entries_.at(*--at).users == 0) oldest = at;
      }
      if (oldest == order_.end()) {
        changed_.wait(lock);
        continue;
      }
      const auto dropped = entries_.find(*oldest);
      bytes_ -= dropped->second.bytes;
      ++counts_.evictions;
      order_.erase(oldest);
      entries_.erase(dropped);
    }
  }

  [[noreturn]] void refuse(std::size_t bytes) const {
    throw environment_error(
        fmt::format("a part of {} bytes does not fit into a cache of {} bytes", bytes, most_bytes_),
        "lazy expansion", "give the cache more bytes, or accept coarser parts");
  }

  const std::size_t most_bytes_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::unordered_map<Key, Entry> entries_;
  std::list<Key> order_;  // of the entries with a value
  std::size_t bytes_ = 0;
  CacheCounts counts_;
};

}  // namespace terrabench::growing
