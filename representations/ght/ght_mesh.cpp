#include <algorithm>
#include <cmath>

#include "representations/column_grid.h"
#include "representations/ght/ght.h"
#include "representations/heightmap/closed_mesh.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

using namespace ght;

// The four squares around a sample, as bits.
enum Quadrant : unsigned { kNorthWest = 1, kNorthEast = 2, kSouthWest = 4, kSouthEast = 8 };

// The closed mesh: plain squares and faces on top, all squares at the floor, and walls where a square has no
// neighbour. Events refuse the border and holes, so walls are needed under plain squares only.
class Mesher {
 public:
  explicit Mesher(const Model& model) : model_(model), tree_(model.tree), grid_(model.tree.grid()) {}

  TriangleMesh run() {
    if (grid_.width < 2 || grid_.depth < 2) return {};
    // Per sample a top and a floor vertex and two triangles on each, and the faces.
    require_memory(grid_.samples() * (2 * sizeof(glm::vec3) + 12 * sizeof(std::uint32_t)) +
                       model_.surface.faces() * (sizeof(glm::vec3) / 2 + 3 * sizeof(std::uint32_t)) +
                       (tree_.cells() + 2 * grid_.samples()) * sizeof(std::uint32_t),
                   "mesh of a grounded heightmap tree");
    vertex_of_.assign(tree_.cells(), kNone);
    tops_.assign(grid_.samples(), {kNone, kNone});
    floors_.assign(grid_.samples(), {kNone, kNone});
    for (int j = 0; j < grid_.depth; ++j) {
      for (int i = 0; i < grid_.width; ++i) place(i, j);
    }
    for (int j = 0; j + 1 < grid_.depth; ++j) {
      for (int i = 0; i + 1 < grid_.width; ++i) {
        if (ground(i, j)) emit({i, j});
      }
    }
    model_.surface.each_face([&](FaceId f) {
      for (const CellId c : model_.surface.face(f)) mesh_.indices.push_back(vertex(c));
    });
    return std::move(mesh_);
  }

 private:
  // The vertices of a sample for the squares south and north of it: two different ones where only two squares
  // meet, at a corner.
  struct Vertices {
    std::uint32_t south, north;
  };

  bool ground(int i, int j) const {
    return i >= 0 && j >= 0 && i + 1 < grid_.width && j + 1 < grid_.depth &&
           !ComposedSurface::hole(tree_, {i, j});
  }
  std::uint32_t add(glm::vec3 position) {
    if (mesh_.positions.size() == kNone) {
      throw usage_error("more than 2³² vertices", "mesh of a grounded heightmap tree",
                        "ask for a coarser mesh");
    }
    mesh_.positions.push_back(position);
    return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
  }
  std::uint32_t vertex(CellId c) {
    if (vertex_of_[c] == kNone) vertex_of_[c] = add(tree_.position(c));
    return vertex_of_[c];
  }

  void place(int i, int j) {
    const unsigned around = (ground(i - 1, j - 1) ? kNorthWest : 0U) | (ground(i, j - 1) ? kNorthEast : 0U) |
                            (ground(i - 1, j) ? kSouthWest : 0U) | (ground(i, j) ? kSouthEast : 0U);
    if (around == 0) return;
    const bool doubled = around == (kNorthWest | kSouthEast) || around == (kNorthEast | kSouthWest);
    const std::size_t at = static_cast<std::size_t>(j) * grid_.width + i;
    const glm::vec3 floor = {grid_.x(i), model_.floor, grid_.z(j)};
    floors_[at].south = floors_[at].north = add(floor);
    if (doubled) floors_[at].north = add(floor);
    bool plain = false;
    for (int k = 0; k < 4 && !plain; ++k) {
      const Square s{i - k % 2, j - k / 2};
      plain = ground(s.i, s.j) && !model_.surface.covered(s);
    }
    if (!plain) return;
    const CellId c = tree_.at_sample(i, j);
    tops_[at].south = tops_[at].north = vertex(c);
    if (doubled) tops_[at].north = add(tree_.position(c));
  }

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
  }

  void emit(Square s) {
    const std::size_t north = static_cast<std::size_t>(s.j) * grid_.width + s.i, south = north + grid_.width;
    const std::uint32_t nw = tops_[north].south, ne = tops_[north + 1].south;
    const std::uint32_t sw = tops_[south].north, se = tops_[south + 1].north;
    const std::uint32_t nw0 = floors_[north].south, ne0 = floors_[north + 1].south;
    const std::uint32_t sw0 = floors_[south].north, se0 = floors_[south + 1].north;
    triangle(nw0, ne0, sw0);
    triangle(ne0, se0, sw0);
    if (model_.surface.covered(s)) return;
    triangle(nw, sw, ne);
    triangle(ne, sw, se);
    // From a to b, seen from above, the ground is on the left and the wall faces right.
    const auto wall = [&](std::uint32_t a, std::uint32_t b, std::uint32_t a0, std::uint32_t b0) {
      triangle(a0, b0, b);
      triangle(a0, b, a);
    };
    if (!ground(s.i, s.j + 1)) wall(sw, se, sw0, se0);
    if (!ground(s.i + 1, s.j)) wall(se, ne, se0, ne0);
    if (!ground(s.i, s.j - 1)) wall(ne, nw, ne0, nw0);
    if (!ground(s.i - 1, s.j)) wall(nw, sw, nw0, sw0);
  }

  const Model& model_;
  const Tree& tree_;
  const SampleGrid& grid_;
  TriangleMesh mesh_;
  std::vector<std::uint32_t> vertex_of_;  // of each cell
  std::vector<Vertices> tops_, floors_;   // of each sample
};

// Coordinates from low to high, about `spacing` apart.
std::vector<float> places(float low, float high, float spacing) {
  const int steps = static_cast<int>(
      std::clamp(std::round((high - low) / spacing), 1.0F, static_cast<float>(ColumnGrid::kMaxColumns)));
  std::vector<float> at;
  for (int i = 0; i < steps; ++i)
    at.push_back(low + (high - low) * static_cast<float>(i) / static_cast<float>(steps));
  at.push_back(high);
  return at;
}

}  // namespace

TriangleMesh Ght::mesh(MeshDetail detail) const {
  const Bounds box = bounds();
  if (!(detail.cell > 0) || box.high.x <= box.low.x || box.high.z <= box.low.z) return Mesher(model_).run();
  const std::vector<float> x = places(box.low.x, box.high.x, detail.cell),
                           z = places(box.low.z, box.high.z, detail.cell);
  require_memory(x.size() * z.size() * sizeof(float), "mesh of a grounded heightmap tree");
  std::vector<float> tops(x.size() * z.size());
  for (std::size_t k = 0; k < tops.size(); ++k) {
    tops[k] = model_.surface.top(model_.tree, {x[k % x.size()], z[k / x.size()]});
  }
  return closed_mesh(x, z, tops, model_.floor);
}

}  // namespace terrabench
