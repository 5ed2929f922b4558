// Lets timed work find none of its data in the processor's caches.
#pragma once

#include <cstddef>
#include <memory>

namespace terrabench::cross {

class ColdCaches {
 public:
  ColdCaches();
  // Writes to a block twice as large as the largest cache that Linux reports, but at least of 64 MiB, and at
  // most of 256 MiB, so that the caches hold nothing else. 64 MiB take some 10 ms.
  void evict() const;

 private:
  std::size_t bytes_;
  std::unique_ptr<char[]> block_;
};

}  // namespace terrabench::cross
