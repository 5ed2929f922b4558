// What both extractors share: the field of a block of cells, sampled plane by plane along z, which lattice
// points are solid as bits, and where the surface crosses an edge of the lattice. No more than four planes
// of a block are held, so that memory does not grow with the terrain.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "representations/implicit/sampled_field.h"
#include "terrain/mesh.h"

namespace terrabench {

enum class Extractor : std::uint8_t { kMarchingCubes, kSurfaceNets };
inline constexpr std::array<std::string_view, 2> kExtractorNames{"marching_cubes", "surface_nets"};

// The points at which the field is sampled: 0 … cells[axis] along each axis, `cell` apart from `low`. The
// last point lies at `high`, also where that makes the last cell smaller.
struct FieldLattice {
  FieldLattice(const Bounds&, float cell);
  // Metres; points beyond 0 and cells[axis] are `cell` apart, too.
  float position(int axis, int index) const {
    return index < cells[axis] ? low[axis] + static_cast<float>(index) * cell
                               : high[axis] + static_cast<float>(index - cells[axis]) * cell;
  }
  // A number for the edge along `axis` from a point, or for the cell above it; all at least -1.
  std::uint64_t key(int axis, int i, int j, int k) const {
    const auto n = [&](int along) { return static_cast<std::uint64_t>(cells[along]) + 3; };
    const auto at = [](int index) { return static_cast<std::uint64_t>(index + 1); };
    return ((at(j) * n(0) + at(i)) * n(1) + at(k)) * 4 + static_cast<std::uint64_t>(axis);
  }

  // Numbers of points along y, from `first` to `last`, between which the surface can lie over the rectangle
  // between two points in plan: all is solid below them, and all is air above them. Nothing if there is none.
  struct Levels {
    int first, last;
  };
  std::optional<Levels> levels(const SampledField&, glm::ivec2 begin, glm::ivec2 end) const;

  glm::ivec3 cells{1};
  glm::vec3 low, high;
  float cell;
};

// The part of a surface over a rectangle of cells.
struct SurfaceBlock {
  static constexpr std::uint32_t kForeign = 1U << 31;

  std::vector<glm::vec3> positions, normals;
  std::vector<std::uint32_t> indices;  // with kForeign set: number in `foreign`
  // Vertices that belong to a neighbouring block, and those of this block that neighbours may ask for.
  std::vector<std::uint64_t> foreign;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> border;
};

struct BlockTask {
  const SampledField& field;
  const FieldLattice& lattice;
  // Cells along x and z. Closed: cells -1 and cells[axis] exist, too; the points beyond the lattice are air,
  // so that the surface closes along the terrain's sides and floor, and vertices on the border to the next
  // block are foreign. Open: the surface ends at the block's border.
  glm::ivec2 begin, end;
  bool closed = false;
  // Normals come from differences of the field this far from a vertex, metres, six samples each; 0: from the
  // lattice's samples, linear between them.
  float gradient_step = 0;
};

class BlockSweep {
 public:
  // Samples the first planes. Afterwards planes z - 1 … z + 2 of plane() are valid.
  explicit BlockSweep(const BlockTask&);

  bool empty() const { return points_ == 0; }  // no surface here
  int z() const { return z_; }
  void advance();  // to z + 1

  // Lattice points along y are numbered from 0 in the block: number n is point first_y() + n. The first and
  // the last number lie outside: they are air when closed, and equal to their neighbours when open.
  int points() const { return points_; }
  int first_y() const { return first_y_; }

  // Bits of the column (i, j): word n / 64, bit n % 64. j from z() - 1 to z() + 2, i from begin.x - 1 to
  // end.x + 1; outside an open block the column at its border, outside the closed terrain nothing.
  const std::uint64_t* solid(int i, int j) const {
    return &bits_[(slot(j) * width_ + static_cast<std::size_t>(i - task_.begin.x + 1)) * words_];
  }
  std::size_t words() const { return words_; }
  static bool bit(const std::uint64_t* column, int n) { return (column[n / 64] >> (n % 64) & 1) != 0; }
  // Corners of the cell above number n of column (i, j), as cell_cases() numbers them.
  int cell_case(int i, int j, int n) const;
  // Calls use(n) for each number in [first, end) whose bit is set in word(w), in ascending order.
  template <class Word, class Use>
  static void for_each_bit(int first, int end, const Word& word, const Use& use) {
    for (int w = first / 64; w * 64 < end; ++w) {
      std::uint64_t bits = word(static_cast<std::size_t>(w));
      if (w == first / 64) bits &= ~std::uint64_t{0} << (first % 64);
      if ((w + 1) * 64 > end) bits &= (std::uint64_t{1} << (end % 64)) - 1;
      for (; bits != 0; bits &= bits - 1) use(w * 64 + std::countr_zero(bits));
    }
  }
  // A word of the column moved down by one number.
  std::uint64_t above(const std::uint64_t* column, std::size_t w) const {
    return column[w] >> 1 | (w + 1 < words_ ? column[w + 1] << 63 : 0);
  }
  // The cells between columns i, i + 1 and j, j + 1 that the surface passes.
  std::uint64_t crossed_cells(int i, int j, std::size_t w) const;

  struct Crossing {
    glm::vec3 position, normal;
  };
  // On the edge along `axis` from number n of column (i, j), one of whose ends is solid.
  Crossing crossing(int axis, int i, int j, int n) const;

 private:
  std::size_t slot(int j) const { return static_cast<std::size_t>(j - task_.begin.y + 1) % 4; }
  // The values of column (i, j).
  const float* column(int i, int j) const {
    return &values_[(slot(j) * width_ + static_cast<std::size_t>(i - task_.begin.x + 1)) * ys_.size()];
  }
  bool outside(glm::ivec3 point) const;
  glm::vec3 gradient(glm::ivec3 point) const;  // from the samples; (i, n, j)
  glm::vec3 gradient_at(glm::vec3) const;
  void load(int j);
  void set_bits(int j);
  glm::vec3 place(glm::ivec3 point) const {
    return {xs_[static_cast<std::size_t>(point.x - task_.begin.x + 1)],
            ys_[static_cast<std::size_t>(point.y)],
            zs_[static_cast<std::size_t>(point.z - task_.begin.y + 1)]};
  }

  BlockTask task_;
  int z_ = 0, points_ = 0, first_y_ = 0;
  std::size_t width_ = 0, words_ = 0;
  std::vector<float> xs_, ys_, zs_;  // positions, from one before the block on
  // 1 / (distance between a point's neighbours), alike.
  std::array<std::vector<float>, 3> per_metre_;
  std::vector<float> values_;        // four planes
  std::vector<std::uint64_t> bits_;  // four planes
  std::unique_ptr<FieldPlanes> planes_;
};

SurfaceBlock marching_cubes(const BlockTask&);
// A vertex per sheet of the surface in a cell, at the mean of its crossings (surface nets, Gibson 1998, with
// the sheets of dual marching cubes, Nielson 2004); a quadrilateral per crossed edge. Closed, but where two
// sheets meet on an ambiguous face an edge can have four triangles.
SurfaceBlock surface_nets(const BlockTask&);

SurfaceBlock extract(Extractor, const BlockTask&);

// The closed surface over a whole lattice. Parallel over blocks; the same mesh for any number of threads.
// Holds little more than one and a half times the mesh at its peak, never the field. Throws usage_error for
// 2³¹ vertices or more.
TriangleMesh closed_surface(const SampledField&, const FieldLattice&, Extractor);

}  // namespace terrabench
