// Chunks on disk, for ground larger than memory (Ulrich 2002): the quadtree of chunked.h, each chunk with
// vertices and indices of 16 bits of its own. Built root by root, so that memory holds one root's samples.
//
// Heights are rounded once for all chunks, to multiples of a power of two of metres that is as fine as 16
// bits for the ground's relief and a float allow: whole metres stay as they are. The largest rounding is part
// of every chunk's error. Level 0 is a grid of all samples; its mesh is made when it is loaded. Skirts hang
// down by the largest error of the chunks beside them and do not need the neighbours' vertices, as floors.h
// does.
//
// In the file: the chunks, level by level of each root; an entry of 32 bytes per chunk, kept in memory; and a
// tail with the ground's size. Building: as Chunked, in parallel; two builds give equal bytes.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lod/cdlod/node_tree.h"
#include "lod/clipmap/height_source.h"
#include "terrain/error.h"
#include "terrain/files.h"
#include "terrain/memory.h"
#include "terrain/progress.h"

namespace terrabench::chunked {

struct ChunkFileOptions {
  int side = 64;         // cells along a chunk's side at level 0, a power of two
  int largest = 2048;    // likewise at the coarsest level
  double error = 0.001;  // metres per metre of a chunk's side
};

struct ChunkPlace {
  int level = 0, x = 0, z = 0;
};

// The mesh of a chunk, metres, with its skirts.
struct LoadedChunk {
  std::vector<glm::vec3> positions, normals;
  std::vector<std::uint32_t> own;          // of level 0 empty: chunks of one shape share their indices
  std::span<const std::uint32_t> indices;  // in the ChunkFile, or `own`
  Memory memory() const;                   // itself included
};

class ChunkFile {
 public:
  // Reads the ground twice. The file is written whole or not at all. Throws usage_error for ground without
  // bounds, smaller than 2 × 2 samples or with no-data, for sides that are no powers of two from 2 to 2^15,
  // and where a chunk has more than 65,532 vertices.
  static void build(HeightSource&, const ChunkFileOptions&, const std::filesystem::path&, Progress&);

  // Throws bad_input for a file that is not a whole file of chunks.
  explicit ChunkFile(const std::filesystem::path&);
  ~ChunkFile();
  ChunkFile(const ChunkFile&) = delete;
  ChunkFile& operator=(const ChunkFile&) = delete;

  const cdlod::NodeTree& tree() const { return tree_; }
  glm::vec2 cell() const { return {tail_.cell_x, tail_.cell_z}; }
  std::size_t number(const ChunkPlace& at) const { return tree_.number(at.level, at.x, at.z); }
  // At any sample of the unrounded ground, metres; at least that of every chunk below.
  float error(const ChunkPlace& at) const { return entries_[number(at)].error; }
  std::size_t bytes(const ChunkPlace& at) const { return entries_[number(at)].bytes; }  // in the file
  std::size_t heap_bytes_at_most(const ChunkPlace&) const;  // of the loaded chunk and of loading it

  // From many threads at once. Throws bad_input where the file's bytes are not those that were written.
  std::unique_ptr<LoadedChunk> load(const ChunkPlace&) const;
  Memory memory() const;  // without the object itself

 private:
  friend class ChunkFileBuilder;
  struct Entry {
    std::uint64_t offset = 0, check = 0;    // XXH3 of the bytes
    float error = 0;                        // metres
    std::uint32_t bytes = 0, indices = 0;   // indices: 0 at level 0
    std::uint16_t lowest = 0, highest = 0;  // in steps
  };
  struct Tail {
    std::array<char, 8> magic;
    std::int32_t width, depth, side, levels;
    float cell_x, cell_z;
    float lowest, step;           // height = lowest + step · steps
    std::uint64_t chunks, check;  // check: check_of(), of the entries and of what is above
  };
  static constexpr std::array<char, 8> kMagic{'c', 'h', 'u', 'n', 'k', 's', '0', '1'};
  static constexpr int kLargestSide = 1 << 15;
  static constexpr std::uint32_t kCorners = 4;  // on the floor
  struct Vertex {
    std::uint16_t x, z, height;      // samples from the chunk's low corner; steps
    std::int8_t normal_x, normal_z;  // in 127ths
  };
  // The triangles of level 0: vertices by rows, and then one on the floor under each of `border`.
  struct Pattern {
    std::vector<std::uint32_t> indices, border;
  };

  static std::uint64_t check_of(std::span<const Entry>, const Tail&);
  static std::uint32_t vertices_of(const Entry&);  // from level 1 on
  static Pattern make_pattern(const PatchGrid::Patch&);
  const Pattern& pattern(const PatchGrid::Patch&) const;
  void read(std::uint64_t offset, std::span<std::byte> to) const;
  void read_entries(std::uint64_t size);
  void decode_grid(ByteSource, const PatchGrid::Patch&, float floor, LoadedChunk&) const;
  void decode_mesh(ByteSource, const Entry&, const PatchGrid::Patch&, float floor, LoadedChunk&) const;
  float floor(const ChunkPlace&) const;
  float height(int steps) const { return tail_.lowest + tail_.step * static_cast<float>(steps); }
  glm::vec3 position(const PatchGrid::Patch&, int x, int z, float y) const;
  Error damaged(std::string_view what) const;

  std::string path_;
  int descriptor_ = -1;
  Tail tail_{};
  cdlod::NodeTree tree_{2, 2, {1, 1}, 2, 1};
  std::vector<Entry> entries_;       // by number
  std::array<Pattern, 4> patterns_;  // by PatchGrid::shape()
};

}  // namespace terrabench::chunked
