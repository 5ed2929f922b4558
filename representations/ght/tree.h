// The Grounded Heightmap Tree (Alonso, Joan-Arinyo & Solano, §3.1, figure 11): its nodes are grounded
// heightmaps, arrays of cells over a ground plane, and a cell holds a height, a link to a cell of another
// heightmap, or nothing. The paper's cells are structs with pointers (20 to 24 bytes). Here all cells lie in
// one array, at 4 bytes per cell and 2 bits for its kind, in the order of their nodes; a link is the number
// of a cell.
//
// Links lead to later cells only, so there are no cycles. A node's parent is an earlier node. Reading a cell
// is O(1), finding the node of a cell amortised O(1).
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "representations/ght/two_part_array.h"
#include "terrain/events/event.h"
#include "terrain/files.h"
#include "terrain/heightfield.h"
#include "terrain/memory.h"

namespace terrabench::ght {

using CellId = std::uint32_t;  // the number of a cell in the tree
using NodeId = std::uint32_t;
inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

enum class CellKind : std::uint8_t { kVoid, kHeight, kLink };
// The paper's TerrainType. A border leads from the ground into a carving.
enum class Area : std::uint8_t { kOutdoor, kIndoor, kBorder };

// Where the root's samples are in plan.
struct SampleGrid {
  int width = 0, depth = 0;
  float spacing_x = 1, spacing_z = 1;  // metres
  double origin_x = 0, origin_z = 0;   // of sample (0, 0)

  float x(int i) const { return static_cast<float>(origin_x + i * static_cast<double>(spacing_x)); }
  float z(int j) const { return static_cast<float>(origin_z + j * static_cast<double>(spacing_z)); }
  // The distance from the first sample, in samples.
  glm::dvec2 samples_to(glm::dvec2 plan) const {
    return {(plan.x - origin_x) / spacing_x, (plan.y - origin_z) / spacing_z};
  }
  float spacing() const { return std::min(spacing_x, spacing_z); }  // the smaller one
  std::size_t samples() const { return static_cast<std::size_t>(width) * depth; }
};

// The ground plane of a grounded heightmap (Alonso, Joan-Arinyo & Solano, figure 11): where its cells are and
// in which direction their heights are measured. Locating a cell is O(1).
//
// The paper gives a plane by a point and a normal vector, with an axis-aligned array. Here the two directions
// of the array are stored too, because events run in any direction, and heights need not be measured at right
// angles to them: all outdoor planes measure heights vertically, so that a cell keeps the height of the
// ground it was taken from and only the plane moves it. Measured along the plane's normal, a cell of height r
// would shift sideways by r·sin(inclination), and neighbouring planes would overlap or gape by that much.
struct GroundPlane {
  glm::vec3 origin{0};
  glm::vec3 u{1, 0, 0};       // from column to column, metres
  glm::vec3 v{0, 0, 1};       // from row to row, metres
  glm::vec3 taper{0};         // added to u per row: the rows of a trapezium have equally many cells
  glm::vec3 height{0, 1, 0};  // unit vector of heights

  glm::dvec3 at(double i, double j, double h) const {
    return glm::dvec3(origin) + i * (glm::dvec3(u) + j * glm::dvec3(taper)) + j * glm::dvec3(v) +
           h * glm::dvec3(height);
  }
  bool operator==(const GroundPlane&) const = default;
};

struct GroundedHeightmap {
  GroundPlane plane{};  // unused when aligned
  CellId first = 0;     // cell (0, 0); rows follow one another
  int columns = 0, rows = 0;
  NodeId parent = kNone;
  std::uint32_t event = kNone;  // number of the event that made it
  std::uint32_t depth = 0;      // the number of nodes above it
  Area area = Area::kOutdoor;
  bool aligned = false;  // its cells are at the root's samples, from (i0, j0) on
  int i0 = 0, j0 = 0;

  std::uint32_t cells() const {
    return static_cast<std::uint32_t>(columns) * static_cast<std::uint32_t>(rows);
  }
  CellId cell(int i, int j) const {
    return first + static_cast<std::uint32_t>(j) * static_cast<std::uint32_t>(columns) +
           static_cast<std::uint32_t>(i);
  }
};

// An applied event: it attached the nodes [first, first + nodes) to `host`.
struct Applied {
  events::Kind kind;
  NodeId host, first, nodes;
};

class Tree {
 public:
  static constexpr std::uint32_t kMostCells = kNone - 1;

  Tree() = default;
  // The root only, with one cell per sample, void where there is no data.
  Tree(const SampleGrid& grid, std::vector<float> heights);

  const SampleGrid& grid() const { return grid_; }
  const std::vector<GroundedHeightmap>& nodes() const { return nodes_; }
  const std::vector<Applied>& events() const { return events_; }
  std::uint32_t cells() const { return static_cast<std::uint32_t>(cells_.size()); }
  // Whether the root has samples without data; events never change that, because they refuse such ground.
  bool has_holes() const { return has_holes_; }

  CellKind kind(CellId c) const {
    return static_cast<CellKind>(kinds_[c / kPerWord] >> (c % kPerWord * 2) & 3U);
  }
  float height(CellId c) const { return std::bit_cast<float>(cells_[c]); }  // of a height
  CellId target(CellId c) const { return cells_[c]; }                       // of a link
  void prefetch(CellId c) const { __builtin_prefetch(&cells_[c]); }
  // The last cell that links lead to from c; c itself when it is no link.
  CellId resolve(CellId c) const {
    while (kind(c) == CellKind::kLink) c = target(c);
    return c;
  }
  NodeId node_of(CellId c) const {
    NodeId node = pages_[c / kPage];
    while (node + 1 < nodes_.size() && nodes_[node + 1].first <= c) ++node;
    return node;
  }
  glm::vec3 position(CellId c) const { return position(nodes_[node_of(c)], c); }  // of a height
  // x and z of position().
  glm::vec2 plan(CellId c) const {
    const glm::vec3 p = position(c);
    return {p.x, p.z};
  }
  CellId root_cell(int i, int j) const {
    return static_cast<std::uint32_t>(j) * static_cast<std::uint32_t>(grid_.width) +
           static_cast<std::uint32_t>(i);
  }
  // The cell that now holds the ground of a sample of the root, if any.
  CellId at_sample(int i, int j) const { return resolve(root_cell(i, j)); }

  // Appends a node of void cells and fills in its first cell and depth. Throws environment_error when cell
  // numbers or memory run out; the tree is then as before.
  NodeId append(GroundedHeightmap node);
  void append(const Applied& event) { events_.push_back(event); }
  void set_void(CellId c) { set(c, 0, CellKind::kVoid); }
  void set_height(CellId c, float height) { set(c, std::bit_cast<std::uint32_t>(height), CellKind::kHeight); }
  void set_link(CellId c, CellId target) { set(c, target, CellKind::kLink); }
  // Removes all nodes after the first `nodes`.
  void truncate(std::size_t nodes) noexcept;
  // append() refuses to go beyond this number of cells.
  void limit_cells(std::uint32_t most) { most_cells_ = most; }
  void reserve_event() { grow(events_, events_.size() + 1); }

  Memory memory() const;
  void save(ByteSink&) const;
  static Tree load(ByteSource&);  // throws bad_input

 private:
  static constexpr std::uint32_t kPerWord = 16, kPage = 64;

  glm::vec3 position(const GroundedHeightmap& node, CellId c) const {
    const auto at = static_cast<int>(c - node.first);
    const int i = at % node.columns, j = at / node.columns;
    if (node.aligned) return {grid_.x(node.i0 + i), height(c), grid_.z(node.j0 + j)};
    return glm::vec3(node.plane.at(i, j, height(c)));
  }
  void set(CellId c, std::uint32_t payload, CellKind kind) {
    cells_[c] = payload;
    std::uint32_t& word = kinds_[c / kPerWord];
    const std::uint32_t shift = c % kPerWord * 2;
    word = (word & ~(3U << shift)) | static_cast<std::uint32_t>(kind) << shift;
  }
  void resize_cells(std::size_t cells, NodeId node);

  SampleGrid grid_;
  TwoPartArray<std::uint32_t> cells_;  // the bits of a height, or the target of a link
  TwoPartArray<std::uint32_t> kinds_;  // 2 bits per cell
  TwoPartArray<NodeId> pages_;         // the node of every kPage-th cell
  std::vector<GroundedHeightmap> nodes_;
  std::vector<Applied> events_;
  std::uint32_t most_cells_ = kMostCells;
  bool has_holes_ = false;
};

}  // namespace terrabench::ght
