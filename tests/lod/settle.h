// The frame of chunks on disk when all that it wants have come.
#pragma once

#include <gtest/gtest.h>

#include "lod/chunked/paged_chunked.h"

namespace terrabench::test {

inline const Frame& settle(PagedChunked& lod, const View& view) {
  for (int k = 0; k < 1000; ++k) {
    const Frame& frame = lod.update(view);
    if (lod.settled()) return frame;
    lod.finish();
  }
  ADD_FAILURE() << "chunks are missing after 1000 frames";
  return lod.update(view);
}

}  // namespace terrabench::test
