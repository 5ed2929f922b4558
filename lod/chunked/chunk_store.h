// All chunks of chunked LOD: their indices in one array, and their errors.
//
// The squares are those of cdlod::NodeTree. At level 0 they share index patterns of all samples, without
// error. A chunk of a coarser level misses no sample by more than a share of its side (Options::error), so
// the bounds double from level to level. They do not depend on the heights, so without morphing an edit
// triangulates only the chunks that hold it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lod/cdlod/node_tree.h"
#include "lod/chunked/chunk_mesh.h"
#include "lod/lod.h"

namespace terrabench::chunked {

using cdlod::NodeTree;

struct Options {
  int side = 8;          // cells along a chunk's side at level 0, a power of two
  double error = 0.008;  // metres per metre of a chunk's side
  bool skirts = true;    // false leaves cracks open; for measurements
  bool morph = false;    // vertices have a way to the surface of the next coarser chunk, but those of level 0
};

class ChunkStore {
 public:
  // Both must outlive it.
  ChunkStore(const GroundGrid&, const NodeTree&, const Options&, Progress&);

  std::span<const std::uint32_t> indices() const { return indices_; }
  // One after another in the order of parts.
  IndexRange part(int level, int x, int z, Part) const;
  std::span<const ChunkVertex> vertices() const { return vertices_; }  // that morph
  // The sample over which a vertex of the surface lies, and the lower end of its way, metres.
  std::uint32_t sample(std::uint32_t vertex) const;
  float lowest(std::uint32_t vertex) const;
  // Appends the vertices of a side of the surface, from west to east or north to south. From level 1 on, with
  // skirts.
  void append_tops(int level, int x, int z, Side, std::vector<std::uint32_t>& to) const;
  // At any sample of the square, metres; at least that of every chunk below.
  float error(int level, int x, int z) const { return errors_[tree_.number(level, x, z)]; }

  // Once its vertices have arrived at the coarser surface: the largest error on the way is between the two.
  float morphed_error(int level, int x, int z) const { return slot(level, x, z).morphed_error; }

  // Triangulates the chunks again that hold these samples; where chunks morph, all that morph to one of
  // these.
  void update(const SampleRect&);
  // Appends the ranges of indices and vertices that update() has changed since the last call.
  void take_changes(std::vector<DirtyRange>& to);
  Memory memory() const;  // without the object itself

 private:
  struct Place {
    std::uint32_t first = 0, capacity = 0;
  };
  struct Slot {
    Place indices, vertices;
    std::array<std::uint32_t, kParts> counts{};
    float morphed_error = 0;
  };
  Slot& slot(int level, int x, int z) { return slots_[tree_.number(level, x, z) - tree_.grid(0).count()]; }
  const Slot& slot(int level, int x, int z) const { return const_cast<ChunkStore*>(this)->slot(level, x, z); }
  void add_patterns();
  void build(int level, const PatchGrid::PatchRect&, Progress&);
  ChunkMesh mesh_of(int level, int x, int z) const;
  void put(Slot&, ChunkMesh&);
  template <class T>
  void put(Place&, std::span<const T>, std::vector<T>& array, DirtyRange::Target);
  void pack();
  void raise_errors(int level, const PatchGrid::PatchRect&);

  const GroundGrid& grid_;
  const NodeTree& tree_;
  Options options_;
  std::vector<std::uint32_t> indices_;
  std::vector<ChunkVertex> vertices_;
  std::array<Slot, 4> patterns_;  // by PatchGrid::shape()
  std::vector<Slot> slots_;       // from level 1 on
  std::vector<float> errors_;     // by number
  std::vector<DirtyRange> changes_;
  std::size_t unused_ = 0;  // indices and vertices
};

}  // namespace terrabench::chunked
