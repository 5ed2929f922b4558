// The tree's own file form: grid, nodes, cells and their kinds, events, faces, and the squares that they
// cover. Loading makes the boundary links and the indices again, which follow from these, and checks that
// every query can safely read the tree.
#include <algorithm>
#include <cmath>
#include <limits>

#include "representations/coding/height_codec.h"
#include "representations/column_grid.h"
#include "representations/ght/ght.h"

namespace terrabench {
namespace ght {
namespace {

constexpr float kFarthest = 1e12F;  // metres; sums of a few such lengths stay finite

bool sane(float v) { return std::abs(v) <= kFarthest; }

template <class... Values>
void put(ByteSink& out, const Values&... values) {
  (out.put(values), ...);
}
template <class... Values>
void get(ByteSource& in, Values&... values) {
  ((values = in.get<Values>()), ...);
}

void save(const GroundedHeightmap& node, ByteSink& out) {
  put(out, node.plane, node.columns, node.rows, node.i0, node.j0, node.parent, node.event, node.area,
      static_cast<std::uint8_t>(node.aligned));
}

GroundedHeightmap load_node(ByteSource& in) {
  GroundedHeightmap node;
  std::uint8_t area = 0, aligned = 0;
  get(in, node.plane);
  for (const glm::vec3& v :
       {node.plane.origin, node.plane.u, node.plane.v, node.plane.taper, node.plane.height}) {
    if (!sane(v.x) || !sane(v.y) || !sane(v.z)) in.fail("a node's plane is not finite or too far away");
  }
  get(in, node.columns, node.rows, node.i0, node.j0, node.parent, node.event, area, aligned);
  if (area > static_cast<std::uint8_t>(Area::kBorder) || aligned > 1) in.fail("invalid type of a node");
  node.area = static_cast<Area>(area);
  node.aligned = aligned != 0;
  return node;
}

void check_node(const GroundedHeightmap& node, NodeId id, const SampleGrid& grid, ByteSource& in) {
  const bool root = id == 0;
  if (node.columns < 1 || node.rows < 1 || node.columns > ColumnGrid::kMaxColumns * 4 ||
      node.rows > ColumnGrid::kMaxColumns * 4) {
    in.fail("invalid size of a node");
  }
  if (node.aligned && !(node.i0 >= 0 && node.j0 >= 0 && node.i0 <= grid.width - node.columns &&
                        node.j0 <= grid.depth - node.rows)) {
    in.fail("a node lies outside the root");
  }
  if (root ? !(node.aligned && node.columns == grid.width && node.rows == grid.depth &&
               node.parent == kNone && node.event == kNone && node.area == Area::kOutdoor)
           : node.parent >= id) {
    in.fail("invalid place of a node in the tree");
  }
}

void check_cells(const Tree& tree, ByteSource& in) {
  for (CellId c = 0; c < tree.cells(); ++c) {
    switch (tree.kind(c)) {
      case CellKind::kVoid:
        if (tree.target(c) != 0) in.fail("a void cell has a value");
        break;
      case CellKind::kHeight:
        if (!sane(tree.height(c))) in.fail("a height is not finite or too large");
        break;
      case CellKind::kLink:
        // To later cells only, so that links end: in a height, or over the mouth of a carving in a void cell.
        if (tree.target(c) <= c || tree.target(c) >= tree.cells() ||
            (tree.kind(tree.target(c)) == CellKind::kVoid &&
             tree.nodes()[tree.node_of(tree.target(c))].area != Area::kBorder)) {
          in.fail("a link leads nowhere");
        }
        break;
      default:
        in.fail("invalid kind of a cell");
    }
  }
}

void check_events(const Tree& tree, ByteSource& in) {
  std::uint64_t next = 1;
  for (std::uint32_t e = 0; e < tree.events().size(); ++e) {
    const Applied& event = tree.events()[e];
    if (static_cast<int>(event.kind) >= events::kKinds || event.first != next || event.nodes < 1 ||
        event.host >= event.first || next + event.nodes > tree.nodes().size()) {
      in.fail("invalid event");
    }
    for (std::uint32_t n = event.first; n < event.first + event.nodes; ++n) {
      if (tree.nodes()[n].event != e || tree.nodes()[n].parent != event.host)
        in.fail("a node belongs to another event");
    }
    next += event.nodes;
  }
  if (next != tree.nodes().size()) in.fail("a node belongs to no event");
}

// The cells at the corners of plain squares must be there.
void check_plain(const Model& model, ByteSource& in) {
  const Tree& tree = model.tree;
  const SampleGrid& grid = tree.grid();
  const CellId root = tree.nodes()[0].cells();
  for (int j = 0; j + 1 < grid.depth; ++j) {
    for (int i = 0; i + 1 < grid.width; ++i) {
      const Square s{i, j};
      if (!model.surface.plain(tree, s)) continue;
      for (int k = 0; k < 4; ++k) {
        const int a = i + k % 2, b = j + k / 2;
        const CellId c = tree.at_sample(a, b);
        if (tree.kind(c) != CellKind::kHeight) in.fail("a corner of a plain square has no height");
        if (c < root) {
          if (c != tree.root_cell(a, b)) in.fail("a sample links to another sample");
          continue;
        }
        const GroundedHeightmap& node = tree.nodes()[tree.node_of(c)];
        if (!node.aligned || node.i0 > a || node.j0 > b || node.i0 + node.columns <= a ||
            node.j0 + node.rows <= b || node.cell(a - node.i0, b - node.j0) != c) {
          in.fail("a corner of a plain square is elsewhere");
        }
      }
    }
  }
}

// The heights of all cells, NaN for those without.
std::vector<float> heights_of(const Tree& tree) {
  std::vector<float> heights(tree.cells(), std::numeric_limits<float>::quiet_NaN());
  for (CellId c = 0; c < tree.cells(); ++c) {
    if (tree.kind(c) == CellKind::kHeight) heights[c] = tree.height(c);
  }
  return heights;
}

// The tree with all heights 0, which compresses well, and the heights of each node.
void encode(const Tree& tree, double largest_error, ByteSink& out) {
  const std::vector<float> heights = heights_of(tree);
  Tree bare = tree;
  for (CellId c = 0; c < tree.cells(); ++c) {
    if (tree.kind(c) == CellKind::kHeight) bare.set_height(c, 0);
  }
  bare.save(out);
  const double step = step_for(heights, largest_error);
  for (const GroundedHeightmap& node : tree.nodes())
    encode_heights(std::span(heights).subspan(node.first, node.cells()), node.columns, step, out);
}

Tree decode_tree(ByteSource& in) {
  const auto floor = in.get<float>(), ceiling = in.get<float>();
  if (!(floor <= ceiling)) in.fail("invalid bounds");
  Tree tree = Tree::load(in);
  for (const GroundedHeightmap& node : tree.nodes()) {
    std::vector<float> heights = decode_heights(in, node.columns, node.rows);
    if (node.aligned) clamp_heights(heights, floor, ceiling);
    for (CellId c = node.first; c < node.first + node.cells(); ++c) {
      const float height = heights[c - node.first];
      if (std::isnan(height) == (tree.kind(c) == CellKind::kHeight))
        in.fail("a cell has a height where the tree has none, or none where it has one");
      if (std::isnan(height)) continue;
      if (!sane(height)) in.fail("a height is too large");
      tree.set_height(c, height);
    }
  }
  return tree;
}

}  // namespace

void Tree::save(ByteSink& out) const {
  put(out, grid_.width, grid_.depth, grid_.spacing_x, grid_.spacing_z, grid_.origin_x, grid_.origin_z,
      static_cast<std::uint32_t>(nodes_.size()));
  for (const GroundedHeightmap& node : nodes_) ght::save(node, out);
  for (const auto* array : {&cells_, &kinds_}) {
    out.put_array(std::span(array->first()));
    out.put_array(std::span(array->second()));
  }
  out.put(static_cast<std::uint32_t>(events_.size()));
  for (const Applied& event : events_) put(out, event.kind, event.host, event.first, event.nodes);
}

Tree Tree::load(ByteSource& in) {
  Tree tree;
  SampleGrid& grid = tree.grid_;
  get(in, grid.width, grid.depth, grid.spacing_x, grid.spacing_z, grid.origin_x, grid.origin_z);
  if (grid.width < 1 || grid.depth < 1 || grid.width > ColumnGrid::kMaxColumns ||
      grid.depth > ColumnGrid::kMaxColumns || !(grid.spacing_x > 0 && grid.spacing_z > 0) ||
      !sane(grid.x(grid.width - 1)) || !sane(grid.z(grid.depth - 1)) || !sane(grid.x(0)) ||
      !sane(grid.z(0)) || grid.x(1) <= grid.x(0) || grid.z(1) <= grid.z(0)) {
    in.fail("invalid grid");
  }
  const auto nodes = in.get<std::uint32_t>();
  std::uint64_t cells = 0;
  for (NodeId n = 0; n < nodes; ++n) {
    GroundedHeightmap node = load_node(in);
    check_node(node, n, grid, in);
    node.first = static_cast<CellId>(cells);
    node.depth = n == 0 ? 0 : tree.nodes_[node.parent].depth + 1;
    cells += static_cast<std::uint64_t>(node.columns) * static_cast<std::uint64_t>(node.rows);
    if (cells > kMostCells || cells > in.left() / sizeof(std::uint32_t))
      in.fail("fewer cells than the nodes need");
    tree.nodes_.push_back(node);
  }
  if (nodes == 0) in.fail("no root");
  tree.cells_ = TwoPartArray(in.get_array<std::uint32_t>(cells));
  tree.kinds_ = TwoPartArray(in.get_array<std::uint32_t>((cells + kPerWord - 1) / kPerWord));
  if (cells % kPerWord != 0 && tree.kinds_.back() >> cells % kPerWord * 2 != 0)
    in.fail("more kinds than cells");
  tree.pages_.resize((cells + kPage - 1) / kPage);
  NodeId at = 0;
  for (std::size_t p = 0; p < tree.pages_.size(); ++p) {
    while (at + 1 < nodes && tree.nodes_[at + 1].first <= p * kPage) ++at;
    tree.pages_[p] = at;
  }
  const auto events = in.get<std::uint32_t>();
  for (std::uint32_t e = 0; e < events; ++e) {
    Applied event{};
    get(in, event.kind, event.host, event.first, event.nodes);
    tree.events_.push_back(event);
  }
  check_cells(tree, in);
  check_events(tree, in);
  for (CellId c = 0; c < tree.nodes_[0].cells(); ++c)
    tree.has_holes_ = tree.has_holes_ || tree.kind(c) == CellKind::kVoid;
  return tree;
}

void ComposedSurface::save(ByteSink& out) const {
  out.put(static_cast<std::uint32_t>(face_count_));
  each_face([&](FaceId f) { out.put(faces_[f]); });
  std::vector<std::uint32_t> covering;
  for (std::uint32_t t = 0; t < tile_of_.size(); ++t) {
    if (tile_of_[t] == kNone) continue;
    const Tile& tile = tiles_[tile_of_[t]];
    if (std::any_of(tile.covered.begin(), tile.covered.end(), [](std::uint64_t w) { return w != 0; })) {
      covering.push_back(t);
    }
  }
  out.put(static_cast<std::uint32_t>(covering.size()));
  for (const std::uint32_t t : covering) {
    out.put(t);
    out.put(tiles_[tile_of_[t]].covered);
  }
}

ComposedSurface ComposedSurface::load(ByteSource& in, const Tree& tree) {
  const SampleGrid& grid = tree.grid();
  ComposedSurface surface(grid);
  const auto faces = in.get_array<Face>(in.get<std::uint32_t>());
  for (const Face& face : faces) {
    for (const CellId c : face) {
      if (c >= tree.cells() || tree.kind(c) != CellKind::kHeight) in.fail("a corner of a face has no height");
      const glm::vec3 p = tree.position(c);
      if (!sane(p.x) || !sane(p.y) || !sane(p.z)) in.fail("a corner of a face is not finite or too far away");
    }
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0])
      in.fail("a face has two equal corners");
    if (surface.range(tree, face).count() > kMostSquares) in.fail("a face is too large");
  }
  if (!faces.empty() && (grid.width < 2 || grid.depth < 2)) in.fail("faces without squares");
  std::vector<Square> covered;
  for (auto tiles = in.get<std::uint32_t>(); tiles > 0; --tiles) {
    const auto t = in.get<std::uint32_t>();
    const auto bits = in.get<std::array<std::uint64_t, kSquares / 64>>();
    if (t >= surface.tile_of_.size()) in.fail("a tile lies outside the terrain");
    for (std::uint32_t k = 0; k < kSquares; ++k) {
      if ((bits[k / 64] >> k % 64 & 1U) == 0) continue;
      const Square s{static_cast<int>(t % surface.tiles_x_ * kSide + k % kSide),
                     static_cast<int>(t / surface.tiles_x_ * kSide + k / kSide)};
      if (s.i < 1 || s.j < 1 || s.i + 2 >= grid.width || s.j + 2 >= grid.depth)
        in.fail("a face covers the border");
      for (int b = 0; b < 9; ++b) {
        if (hole(tree, {s.i - 1 + b % 3, s.j - 1 + b / 3})) in.fail("a face covers a hole");
      }
      covered.push_back(s);
    }
  }
  std::size_t entries = 0;
  for (const Face& face : faces) entries += surface.range(tree, face).count();
  require_memory(entries * (sizeof(Entry) + sizeof(Placed) + sizeof(Face)), "grounded heightmap tree");
  surface.prepare(tree, covered, faces);
  for (const Square s : covered) surface.set_covered(s, true);
  std::vector<FaceId> ids(faces.size());
  surface.add(faces, surface.place(tree, faces), ids);
  return surface;
}

}  // namespace ght

using namespace ght;

void Ght::save(ByteSink& out) const {
  model_.tree.save(out);
  model_.surface.save(out);
  put(out, model_.floor, model_.ceiling);
}

bool Ght::encode(double largest_error, ByteSink& out) const {
  put(out, model_.floor, model_.ceiling);
  ght::encode(model_.tree, largest_error, out);
  model_.surface.save(out);
  put(out, model_.floor, model_.ceiling);
  return true;
}

std::unique_ptr<Representation> Ght::load(ByteSource& in) { return with_tree(Tree::load(in), in); }
std::unique_ptr<Representation> Ght::decode(ByteSource& in) { return with_tree(decode_tree(in), in); }

std::unique_ptr<Representation> Ght::with_tree(Tree tree, ByteSource& in) {
  std::unique_ptr<Ght> loaded(new Ght);
  Model& model = loaded->model_ = Model(std::move(tree), 0, 0);
  model.surface = ComposedSurface::load(in, model.tree);
  get(in, model.floor, model.ceiling);
  if (!sane(model.floor) || !sane(model.ceiling) || model.floor > model.ceiling) in.fail("invalid bounds");
  check_plain(model, in);
  for (NodeId n = 1; n < model.tree.nodes().size(); ++n) {
    const GroundedHeightmap& node = model.tree.nodes()[n];
    model.carved = model.carved || is_carving(model.tree.events()[node.event].kind);
    const SquareRange r = model.range(node);
    constexpr int kSlack = 4;  // cells are at most one sample spacing apart
    if (std::max(r.i1 - r.i0, r.j1 - r.j0) > node.columns + node.rows + kSlack)
      in.fail("a node is too wide for its cells");
    if (node.area == Area::kOutdoor) model.index_node(n);
  }
  link_all(model);
  return loaded;
}

}  // namespace terrabench
