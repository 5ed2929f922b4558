// How low the skirts of chunked LOD must hang, per side of a chunk.
//
// Any chunk, of any level, with a side on the same line may be drawn beside this one. A skirt that reaches
// the lowest of these sides along its own closes every crack. Chunks of finer levels and of level 0 are not
// lower than the lowest sample of the side; coarser ones may be, since they can skip it. A vertex that morphs
// counts with the lower end of its way.
//
// 8 bytes per chunk. O(samples on sides · levels), in parallel.
#pragma once

#include <span>
#include <vector>

#include "lod/chunked/chunk_store.h"

namespace terrabench::chunked {

class Floors {
 public:
  // All must outlive it.
  Floors(const GroundGrid&, const NodeTree&, const ChunkStore&);

  // Metres.
  float at(int level, int x, int z, Side) const;
  // Measures the sides again of chunks that hold these samples, and of all chunks below.
  void update(const SampleRect&);
  Memory memory() const { return index_memory(firsts_, floors_); }  // without the object itself

 private:
  // Lines of sides: axis 0 those to the west of chunks, numbered from west to east, and the ground's eastern
  // border; axis 1 those to the north, and the southern border. `along`: the chunk beside the line.
  struct Place {
    int axis, level, line, along;
  };
  int last_line(int axis, int level) const;
  int chunks_along(int axis, int level) const;
  std::size_t number(const Place&) const;
  void measure(const Place&, std::span<float> lowest);
  void lower_to(const Place&, int across, Side, std::span<float> lowest) const;
  void measure_from(const Place&);

  const GroundGrid& grid_;
  const NodeTree& tree_;
  const ChunkStore& chunks_;
  std::vector<std::size_t> firsts_;  // by axis and level
  std::vector<float> floors_;
};

}  // namespace terrabench::chunked
