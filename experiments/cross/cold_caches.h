// Lets timed work find none of its data in the processor's caches.
#pragma once

#include <memory>

namespace terrabench::cross {

class ColdCaches {
 public:
  ColdCaches();
  // Writes to a block of 64 MiB, which most processors' caches cannot hold beside anything else. Takes some
  // 10 ms.
  void empty() const;

 private:
  std::unique_ptr<char[]> block_;
};

}  // namespace terrabench::cross
