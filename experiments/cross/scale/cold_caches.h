// Evicts what the processor's caches hold, so that timed work starts with cold caches.
#pragma once

#include <cstddef>
#include <memory>

namespace terrabench::cross {

class ColdCaches {
 public:
  ColdCaches();
  // Writes to a block of twice the size of the largest cache that Linux reports, but of 64 to 256 MiB. A
  // cache of more than 256 MiB would keep a part of its data. Writing 64 MiB takes about 10 ms.
  void evict() const;

 private:
  std::size_t bytes_;
  std::unique_ptr<char[]> block_;
};

}  // namespace terrabench::cross
