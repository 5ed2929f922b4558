// The surface composed of a tree's heightmaps: its triangles, and where they are in plan. In the paper they
// follow from the boundary links of neighbouring cells (§3.2). Here a square between four samples of the root
// is either `plain`, two triangles between the cells at its samples, or covered by `faces`, triangles between
// any cells. Tunnel walls and overhanging scarps consist of faces too. An index, present only in tiles with
// faces, finds them by square; each entry holds the face's box within the square, so that a line reads the
// corners of few faces besides those that it crosses.
//
// A vertical line costs O(faces over its square), and O(1) on a plain square.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "representations/ght/tree.h"

namespace terrabench::ght {

using FaceId = std::uint32_t;
using Face = std::array<CellId, 3>;  // heights, counter-clockwise seen from the air

struct Square {
  int i, j;
  auto operator<=>(const Square&) const = default;
};

// Squares [i0, i1] × [j0, j1].
struct SquareRange {
  int i0, j0, i1, j1;
  std::size_t count() const {
    return static_cast<std::size_t>(i1 - i0 + 1) * static_cast<std::size_t>(j1 - j0 + 1);
  }
  // The tiles of side × side squares that hold them.
  SquareRange tiles(int side) const { return {i0 / side, j0 / side, i1 / side, j1 / side}; }
  template <class Visit>  // visit(Square), row by row
  void each(const Visit& visit) const {
    for (int j = j0; j <= j1; ++j) {
      for (int i = i0; i <= i1; ++i) visit(Square{i, j});
    }
  }
};

// The box around points in plan.
struct PlanBounds {
  glm::dvec2 low{HUGE_VAL}, high{-HUGE_VAL};
  void add(glm::dvec2 p) { low = glm::min(low, p), high = glm::max(high, p); }
};

template <class T>
void sort_unique(std::vector<T>& v) {
  std::sort(v.begin(), v.end());
  v.erase(std::unique(v.begin(), v.end()), v.end());
}

// Where a vertical line, followed from above, meets the surface: weight +1 into the ground, -1 out of it.
struct Crossing {
  float y;
  int weight;
};

// A point in plan as on a map, x east and y north, for the orientation of triangles.
inline glm::dvec2 map_point(glm::vec3 p) { return {p.x, -static_cast<double>(p.z)}; }

class ComposedSurface {
 public:
  // The most squares that a face may lie over, so that a small saved tree cannot demand much memory.
  static constexpr std::size_t kMostSquares = 256;

  ComposedSurface() = default;
  explicit ComposedSurface(const SampleGrid& grid);

  // The square that holds a point of the terrain; false outside.
  bool find(float x, float z, Square& at) const;
  bool covered(Square s) const {  // by faces; otherwise plain or a hole
    const std::uint32_t tile = tile_of_[tile_index(s)];
    return tile != kNone && (tiles_[tile].covered[slot(s) / 64] >> slot(s) % 64 & 1U) != 0;
  }
  // Whether no face lies over a square.
  bool simple(Square s) const {
    const std::uint32_t tile = tile_of_[tile_index(s)];
    return tile == kNone || tiles_[tile].first[slot(s)] == kNone;
  }
  bool plain(const Tree& tree, Square s) const { return !covered(s) && !hole(tree, s); }
  static bool hole(const Tree& tree, Square s);
  // The cells at the corners of a plain square: north-west, south-west, south-east, north-east.
  static std::array<CellId, 4> corners(const Tree& tree, Square s);
  // The two triangles of a plain square.
  static std::array<Face, 2> plain_faces(const std::array<CellId, 4>& corners) {
    return {Face{corners[0], corners[1], corners[3]}, Face{corners[3], corners[1], corners[2]}};
  }

  const Face& face(FaceId f) const { return faces_[f]; }
  std::size_t faces() const { return face_count_; }
  // Calls visit(FaceId) for the faces over or touching a square.
  template <class Visit>
  void over(Square s, const Visit& visit) const {
    const std::uint32_t tile = tile_of_[tile_index(s)];
    if (tile == kNone) return;
    for (std::uint32_t e = tiles_[tile].first[slot(s)]; e != kNone; e = entries_[e].next)
      visit(entries_[e].face);
  }
  // The same for those whose box in the square meets that of the line from `from` to `to` in plan (x, z).
  template <class Visit>
  void along(Square s, glm::dvec2 from, glm::dvec2 to, const Visit& visit) const {
    const std::uint32_t tile = tile_of_[tile_index(s)];
    if (tile == kNone) return;
    const glm::dvec2 a = steps_in(s, from), b = steps_in(s, to), low = glm::min(a, b), high = glm::max(a, b);
    for (std::uint32_t e = tiles_[tile].first[slot(s)]; e != kNone; e = entries_[e].next) {
      const std::uint32_t box = entries_[e].box;
      if (high.x < (box & 255U) || low.x > (box >> 8U & 255U) + 1.0 || high.y < (box >> 16U & 255U) ||
          low.y > (box >> 24U) + 1.0) {
        continue;
      }
      visit(entries_[e].face);
    }
  }
  // Calls visit(FaceId) for every face.
  template <class Visit>
  void each_face(const Visit& visit) const {
    for (FaceId f = 0; f < faces_.size(); ++f) {
      if (faces_[f][0] != kNone) visit(f);
    }
  }
  // Calls visit(Face) for all triangles: the two of every plain square, then the faces. O(samples + faces)
  template <class Visit>
  void each_triangle(const Tree& tree, const Visit& visit) const {
    for (int j = 0; j + 1 < grid_.depth; ++j) {
      for (int i = 0; i + 1 < grid_.width; ++i) {
        if (!plain(tree, {i, j})) continue;
        for (const Face& face : plain_faces(corners(tree, {i, j}))) visit(face);
      }
    }
    each_face([&](FaceId f) { visit(faces_[f]); });
  }
  // The cells at the corners of plain squares and faces, ascending.
  std::vector<CellId> cells_at(const Tree& tree, std::span<const Square> squares,
                               std::span<const FaceId> faces) const;
  // The squares that a face lies over or touches, clipped to the terrain.
  SquareRange range(const Tree& tree, const Face& face) const;
  SquareRange range(glm::dvec2 low, glm::dvec2 high) const;  // (x, z)

  // Asks the processor for what crossings() will read, one step of the way each: the square's tile (0), its
  // first entry (1), and that entry (2). A batch of lines does each step for all of them, so that their reads
  // overlap.
  void prefetch(Square s, int step) const;
  // Appends the crossings of the vertical line at (x, z) in square s, unordered. A line through the common
  // edge of two faces crosses one of them.
  void crossings(const Tree& tree, float x, float z, Square s, std::vector<Crossing>& out) const;
  // Height of the topmost surface at a point of the terrain; kNoData over a hole.
  float top(const Tree& tree, glm::dvec2 plan) const;
  // Height of the plain square at a point in it.
  static float plain_height(const Tree& tree, float x, float z, Square s);

  // Changes take two steps: prepare() allocates and may throw, the others cannot.
  void prepare(const Tree& tree, std::span<const Square> covered, std::span<const Face> added);
  void set_covered(Square s, bool covered) noexcept;
  // Adds faces, with the entries of each square side by side, so that a line reads them in order.
  struct Placed {
    Square square;
    std::uint32_t face, box;  // number in the list
  };
  std::vector<Placed> place(const Tree& tree, std::span<const Face> faces) const;  // may throw
  void add(std::span<const Face> faces, std::span<const Placed> placed, std::span<FaceId> ids) noexcept;
  void remove(const Tree& tree, FaceId face) noexcept;

  Memory memory() const;
  void save(ByteSink&) const;
  static ComposedSurface load(ByteSource&, const Tree& tree);  // throws bad_input

 private:
  static constexpr int kSide = 16;  // squares along a tile
  static constexpr std::uint32_t kSquares = kSide * kSide;
  struct Tile {
    std::array<std::uint64_t, kSquares / 64> covered{};
    std::array<std::uint32_t, kSquares> first;
    Tile() { first.fill(kNone); }
  };
  struct Entry {
    FaceId face;
    std::uint32_t next;
    std::uint32_t box;  // of the face within the square, one byte per side: a line elsewhere misses the face
  };
  // The side of a box counts in steps of 1/256 of a square.
  static constexpr double kBoxSteps = 256;
  // Of a point in plan, from the square's first corner.
  glm::dvec2 steps_in(Square s, glm::dvec2 plan) const {
    return kBoxSteps *
           glm::dvec2((plan.x - grid_.origin_x) * per_x_ - s.i, (plan.y - grid_.origin_z) * per_z_ - s.j);
  }
  std::uint32_t box_in(Square s, const PlanBounds& face) const;

  std::size_t tile_index(Square s) const {
    return static_cast<std::size_t>(s.j / kSide) * tiles_x_ + static_cast<std::size_t>(s.i / kSide);
  }
  static std::uint32_t slot(Square s) {
    return static_cast<std::uint32_t>(s.j % kSide * kSide + s.i % kSide);
  }
  Tile& tile(Square s) noexcept;
  FaceId number(const Face& face) noexcept;
  void enter(Square s, FaceId face, std::uint32_t box) noexcept;

  SampleGrid grid_;
  double per_x_ = 1, per_z_ = 1;  // 1 / spacing
  std::size_t tiles_x_ = 0;
  std::vector<std::uint32_t> tile_of_;  // kNone where no square is covered or has a face
  std::vector<Tile> tiles_;
  std::vector<Face> faces_;  // unused ones: {kNone, next unused, -}
  std::vector<Entry> entries_;
  FaceId free_face_ = kNone;
  std::uint32_t free_entry_ = kNone;
  std::size_t face_count_ = 0, entry_count_ = 0;
};

}  // namespace terrabench::ght
