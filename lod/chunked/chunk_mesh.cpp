#include "lod/chunked/chunk_mesh.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "lod/plan_triangle.h"
#include "terrain/progress.h"
#include "terrain/tin/greedy_insertion.h"

namespace terrabench::chunked {
namespace {

using Indices = std::vector<std::uint32_t>;

void add(Indices& to, std::uint32_t a, std::uint32_t b, std::uint32_t c) { to.insert(to.end(), {a, b, c}); }

// A vertex at the upper end of a skirt. `at`: cells along the side, from left to right as seen from outside.
struct Top {
  int at;
  float height;
  std::uint32_t vertex;
};

bool over_line(const Top& a, const Top& b, const Top& c) {  // whether b is above the line from a to c
  return static_cast<double>(b.at - a.at) * (static_cast<double>(c.height) - a.height) <
         static_cast<double>(c.at - a.at) * (static_cast<double>(b.height) - a.height);
}

// Fills the side from the tops down to its two ends on the floor. Peaks are cut off one by one; the rest has
// one lowest vertex, and each end on the floor sees all of it up to there.
void hang(std::span<const Top> tops, std::uint32_t to_floor, Indices& out) {
  std::vector<Top> rest;
  for (const Top& top : tops) {
    for (; rest.size() > 1 && over_line(rest.end()[-2], rest.back(), top); rest.pop_back()) {
      add(out, rest.end()[-2].vertex, top.vertex, rest.back().vertex);
    }
    rest.push_back(top);
  }
  const std::uint32_t left = rest.front().vertex + to_floor, right = rest.back().vertex + to_floor;
  const auto lowest =
      static_cast<std::size_t>(std::ranges::min_element(rest, {}, &Top::height) - rest.begin());
  add(out, left, right, rest[lowest].vertex);
  for (std::size_t k = 0; k + 1 < rest.size(); ++k) {
    add(out, k < lowest ? left : right, rest[k + 1].vertex, rest[k].vertex);
  }
}

// The samples of a square, and the triangulation over them.
class Cut {
 public:
  Cut(const GroundGrid& grid, const PatchGrid::Patch& square, float largest_error)
      : grid_(grid), square_(square), field_(Heightfield::zeros(square.columns + 1, square.rows + 1)) {
    for (int j = 0; j <= square.rows; ++j) {
      std::copy_n(&grid.heights[vertex({0, static_cast<std::uint16_t>(j)})], field_.width, &field_.at(0, j));
    }
    Progress silent;
    ground_ = tin::greedy_insertion(field_, largest_error, silent);
  }

  // Returns its error.
  float add_surface(Indices& out) const {
    float error = 0;
    for (const tin::Triangle& t : ground_.surface.triangles()) {
      Corner corners[3];
      for (int k = 0; k < 3; ++k) {
        const tin::Sample at = ground_.surface.vertex(t, (3 - k) % 3);  // turned the other way round
        corners[k] = {at.i, at.j, field_.at(at.i, at.j)};
        out.push_back(vertex(at));
      }
      for_samples_on(corners, field_.width, field_.depth,
                     [&](int x, int z, float y) { error = std::max(error, std::abs(field_.at(x, z) - y)); });
    }
    return error;
  }

  void add_skirt(Side side, Indices& out) const {
    std::vector<Top> tops;
    for (const tin::Sample at : ground_.surface.vertices()) {  // by rows, each from west to east
      const bool on_side = side == kNorth   ? at.j == 0
                           : side == kEast  ? at.i == square_.columns
                           : side == kSouth ? at.j == square_.rows
                                            : at.i == 0;
      const int along = side == kNorth || side == kSouth ? at.i : at.j;
      if (on_side) tops.push_back({along, field_.at(at.i, at.j), vertex(at)});
    }
    if (side == kNorth || side == kEast) {
      std::ranges::reverse(tops);
      for (Top& top : tops) top.at = -top.at;
    }
    hang(tops, static_cast<std::uint32_t>(grid_.heights.size()), out);
  }

 private:
  std::uint32_t vertex(tin::Sample at) const {
    return static_cast<std::uint32_t>(square_.j0 + at.j) * static_cast<std::uint32_t>(grid_.width) +
           static_cast<std::uint32_t>(square_.i0 + at.i);
  }

  const GroundGrid& grid_;
  const PatchGrid::Patch& square_;
  Heightfield field_;
  tin::Approximation ground_;
};

// add_part(part, indices) appends one part.
template <class AddPart>
ChunkMesh of_parts(bool skirts, const AddPart& add_part) {
  ChunkMesh mesh;
  for (int part = 0; part < kParts; ++part) {
    if (part != kSurface && !skirts) continue;
    const std::size_t before = mesh.indices.size();
    add_part(static_cast<Part>(part), mesh.indices);
    mesh.counts[static_cast<std::size_t>(part)] = static_cast<std::uint32_t>(mesh.indices.size() - before);
  }
  return mesh;
}

}  // namespace

ChunkMesh triangulate(const GroundGrid& grid, const PatchGrid::Patch& square, float largest_error,
                      bool skirts) {
  const Cut cut(grid, square, largest_error);
  float error = 0;
  ChunkMesh mesh = of_parts(skirts, [&](Part part, Indices& out) {
    if (part == kSurface) {
      error = cut.add_surface(out);
    } else {
      cut.add_skirt(side_of(part), out);
    }
  });
  mesh.error = error;
  return mesh;
}

namespace {

// Calls use(x, z, height) for the samples of the square under a triangle, from its low corner on.
// height_of(vertex) gives that of a corner.
template <class HeightOf, class Use>
void for_samples_under(const std::uint32_t* vertices, const GroundGrid& grid, const PatchGrid::Patch& square,
                       const HeightOf& height_of, const Use& use) {
  const auto width = static_cast<std::uint32_t>(grid.width);
  Corner corners[3];
  for (int k = 0; k < 3; ++k) {
    corners[k] = {static_cast<int>(vertices[k] % width) - square.i0,
                  static_cast<int>(vertices[k] / width) - square.j0, height_of(vertices[k])};
  }
  const auto [west, east] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
  const auto [north, south] = std::minmax({corners[0].z, corners[1].z, corners[2].z});
  if (east < 0 || south < 0 || west > square.columns || north > square.rows) return;
  for_samples_on(corners, square.columns + 1, square.rows + 1, [&](int x, int z, float y) {
    if (x >= 0 && z >= 0 && x <= square.columns && z <= square.rows) use(x, z, y);
  });
}

}  // namespace

void morph_to(std::span<const std::uint32_t> coarser, const GroundGrid& grid, const PatchGrid::Patch& square,
              ChunkMesh& mesh) {
  const auto width = static_cast<std::uint32_t>(grid.width);
  const auto samples = static_cast<std::uint32_t>(grid.heights.size());
  Heightfield there = Heightfield::zeros(square.columns + 1, square.rows + 1);
  for (std::size_t k = 0; k < coarser.size(); k += 3) {
    for_samples_under(
        &coarser[k], grid, square, [&](std::uint32_t v) { return grid.heights[v]; },
        [&](int x, int z, float y) { there.at(x, z) = y; });
  }
  const auto height_there = [&](std::uint32_t v) {
    return there.at(static_cast<int>(v % width) - square.i0, static_cast<int>(v / width) - square.j0);
  };
  const std::span surface(mesh.indices.begin() + mesh.counts[kSouthSkirt] + mesh.counts[kWestSkirt],
                          mesh.counts[kSurface]);
  for (std::size_t k = 0; k < surface.size(); k += 3) {
    for_samples_under(&surface[k], grid, square, height_there, [&](int x, int z, float y) {
      const std::size_t at = static_cast<std::size_t>(square.j0 + z) * width + square.i0 + x;
      mesh.morphed_error = std::max(mesh.morphed_error, std::abs(grid.heights[at] - y));
    });
  }
  std::vector<std::uint32_t> used(surface.begin(), surface.end());
  std::ranges::sort(used);
  const auto repeated = std::ranges::unique(used);
  used.erase(repeated.begin(), repeated.end());
  for (const std::uint32_t v : used) mesh.vertices.push_back({v, height_there(v)});
  for (std::uint32_t& index : mesh.indices) {
    if (index >= samples) continue;  // on the floor
    index = 2 * samples + static_cast<std::uint32_t>(std::ranges::lower_bound(used, index) - used.begin());
  }
}

ChunkMesh exact_pattern(const GroundGrid& grid, const PatchGrid::Patch& square, bool skirts) {
  const auto width = static_cast<std::uint32_t>(grid.width);
  const auto columns = static_cast<std::uint32_t>(square.columns),
             rows = static_cast<std::uint32_t>(square.rows);
  const auto to_floor = static_cast<std::uint32_t>(grid.heights.size());
  // An edge of a side, from left to right as seen from outside.
  const auto hang_edge = [&](Indices& out, std::uint32_t from, std::uint32_t to) {
    add(out, from, from + to_floor, to + to_floor);
    add(out, from, to + to_floor, to);
  };
  return of_parts(skirts, [&](Part part, Indices& out) {
    if (part == kSurface) {
      for (std::uint32_t j = 0; j < rows; ++j) {
        for (std::uint32_t i = 0; i < columns; ++i) {
          const std::uint32_t at = j * width + i;
          add(out, at, at + width, at + 1);
          add(out, at + 1, at + width, at + width + 1);
        }
      }
      return;
    }
    const bool along_x = part == kNorthSkirt || part == kSouthSkirt;
    const std::uint32_t step = along_x ? 1 : width, edges = along_x ? columns : rows;
    const std::uint32_t first = part == kSouthSkirt ? rows * width : part == kEastSkirt ? columns : 0;
    for (std::uint32_t k = 0; k < edges; ++k) {
      const std::uint32_t from = first + k * step, to = from + step;
      const bool forward = part == kSouthSkirt || part == kWestSkirt;
      hang_edge(out, forward ? from : to, forward ? to : from);
    }
  });
}

}  // namespace terrabench::chunked
