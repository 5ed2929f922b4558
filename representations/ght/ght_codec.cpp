// The tree's own form: lattice, nodes, cells and their kinds, events, faces, and which squares they cover.
// The indices are made again on loading. What is read is checked to be a tree that every query can walk.
#include <algorithm>
#include <cmath>

#include "representations/column_grid.h"
#include "representations/ght/ght.h"

namespace terrabench {
namespace ght {
namespace {

constexpr float kFarthest = 1e12F;  // metres; sums of a few such lengths are still numbers

bool sane(float v) { return std::abs(v) <= kFarthest; }

void save(const Node& node, ByteSink& out) {
  out.put(node.frame);
  for (const int v : {node.columns, node.rows, node.i0, node.j0}) out.put(v);
  out.put(node.parent);
  out.put(node.event);
  out.put(node.area);
  out.put(static_cast<std::uint8_t>(node.aligned));
}

Node load_node(ByteSource& in) {
  Node node;
  node.frame = in.get<Frame>();
  for (const glm::vec3& v :
       {node.frame.origin, node.frame.u, node.frame.v, node.frame.taper, node.frame.height}) {
    if (!sane(v.x) || !sane(v.y) || !sane(v.z)) in.fail("a node's plane is nowhere");
  }
  for (int* v : {&node.columns, &node.rows, &node.i0, &node.j0}) *v = in.get<int>();
  node.parent = in.get<NodeId>();
  node.event = in.get<std::uint32_t>();
  const auto area = in.get<std::uint8_t>(), aligned = in.get<std::uint8_t>();
  if (area > static_cast<std::uint8_t>(Area::kBorder) || aligned > 1) in.fail("a node's type cannot be");
  node.area = static_cast<Area>(area);
  node.aligned = aligned != 0;
  return node;
}

void check_node(const Node& node, NodeId id, const Lattice& lattice, ByteSource& in) {
  const bool root = id == 0;
  if (node.columns < 1 || node.rows < 1 || node.columns > ColumnGrid::kMaxColumns * 4 ||
      node.rows > ColumnGrid::kMaxColumns * 4) {
    in.fail("a node's size cannot be");
  }
  if (node.aligned && !(node.i0 >= 0 && node.j0 >= 0 && node.i0 <= lattice.width - node.columns &&
                        node.j0 <= lattice.depth - node.rows)) {
    in.fail("a node lies outside the root");
  }
  if (root ? !(node.aligned && node.columns == lattice.width && node.rows == lattice.depth &&
               node.parent == kNone && node.event == kNone && node.area == Area::kOutdoor)
           : node.parent >= id) {
    in.fail("a node's place in the tree cannot be");
  }
}

void check_cells(const Tree& tree, ByteSource& in) {
  for (CellId c = 0; c < tree.cells(); ++c) {
    switch (tree.kind(c)) {
      case CellKind::kVoid:
        if (tree.target(c) != 0) in.fail("an empty cell is not empty");
        break;
      case CellKind::kHeight:
        if (!sane(tree.height(c))) in.fail("a height is no number of metres");
        break;
      case CellKind::kLink:
        // Later cells only, so that links end: in a height, or over the mouth of a carving in nothing.
        if (tree.target(c) <= c || tree.target(c) >= tree.cells() ||
            (tree.kind(tree.target(c)) == CellKind::kVoid &&
             tree.nodes()[tree.node_of(tree.target(c))].area != Area::kBorder)) {
          in.fail("a link leads nowhere");
        }
        break;
      default:
        in.fail("a cell is neither height nor link nor empty");
    }
  }
}

void check_events(const Tree& tree, ByteSource& in) {
  std::uint64_t next = 1;
  for (std::uint32_t e = 0; e < tree.events().size(); ++e) {
    const Applied& event = tree.events()[e];
    if (static_cast<int>(event.kind) >= events::kKinds || event.first != next || event.nodes < 1 ||
        event.host >= event.first || next + event.nodes > tree.nodes().size()) {
      in.fail("an event cannot be");
    }
    for (std::uint32_t n = event.first; n < event.first + event.nodes; ++n) {
      if (tree.nodes()[n].event != e || tree.nodes()[n].parent != event.host)
        in.fail("a node is of another event");
    }
    next += event.nodes;
  }
  if (next != tree.nodes().size()) in.fail("a node is of no event");
}

// The cells at the corners of plain squares stand there.
void check_plain(const Model& model, ByteSource& in) {
  const Tree& tree = model.tree;
  const Lattice& lattice = tree.lattice();
  const CellId root = tree.nodes()[0].cells();
  for (int j = 0; j + 1 < lattice.depth; ++j) {
    for (int i = 0; i + 1 < lattice.width; ++i) {
      const Square s{i, j};
      if (!model.surface.plain(tree, s)) continue;
      for (int k = 0; k < 4; ++k) {
        const int a = i + k % 2, b = j + k / 2;
        const CellId c = tree.at_sample(a, b);
        if (tree.kind(c) != CellKind::kHeight) in.fail("a plain square has no such corner");
        if (c < root) {
          if (c != tree.root_cell(a, b)) in.fail("a sample links to another one");
          continue;
        }
        const Node& node = tree.nodes()[tree.node_of(c)];
        if (!node.aligned || node.i0 > a || node.j0 > b || node.i0 + node.columns <= a ||
            node.j0 + node.rows <= b || node.cell(a - node.i0, b - node.j0) != c) {
          in.fail("a plain square's corner stands elsewhere");
        }
      }
    }
  }
}

}  // namespace

void Tree::save(ByteSink& out) const {
  for (const int v : {lattice_.width, lattice_.depth}) out.put(v);
  for (const float v : {lattice_.cell_x, lattice_.cell_z}) out.put(v);
  for (const double v : {lattice_.origin_x, lattice_.origin_z}) out.put(v);
  out.put(static_cast<std::uint32_t>(nodes_.size()));
  for (const Node& node : nodes_) ght::save(node, out);
  for (const auto* array : {&cells_, &kinds_}) {
    out.put_array(std::span(array->first()));
    out.put_array(std::span(array->second()));
  }
  out.put(static_cast<std::uint32_t>(events_.size()));
  for (const Applied& event : events_) {
    out.put(event.kind);
    for (const NodeId n : {event.host, event.first, event.nodes}) out.put(n);
  }
}

Tree Tree::load(ByteSource& in) {
  Tree tree;
  Lattice& lattice = tree.lattice_;
  for (int* v : {&lattice.width, &lattice.depth}) *v = in.get<int>();
  for (float* v : {&lattice.cell_x, &lattice.cell_z}) *v = in.get<float>();
  for (double* v : {&lattice.origin_x, &lattice.origin_z}) *v = in.get<double>();
  if (lattice.width < 1 || lattice.depth < 1 || lattice.width > ColumnGrid::kMaxColumns ||
      lattice.depth > ColumnGrid::kMaxColumns || !(lattice.cell_x > 0 && lattice.cell_z > 0) ||
      !sane(lattice.x(lattice.width - 1)) || !sane(lattice.z(lattice.depth - 1)) || !sane(lattice.x(0)) ||
      !sane(lattice.z(0)) || lattice.x(1) <= lattice.x(0) || lattice.z(1) <= lattice.z(0)) {
    in.fail("the lattice cannot be");
  }
  const auto nodes = in.get<std::uint32_t>();
  std::uint64_t cells = 0;
  for (NodeId n = 0; n < nodes; ++n) {
    Node node = load_node(in);
    check_node(node, n, lattice, in);
    node.first = static_cast<CellId>(cells);
    node.depth = n == 0 ? 0 : tree.nodes_[node.parent].depth + 1;
    cells += static_cast<std::uint64_t>(node.columns) * static_cast<std::uint64_t>(node.rows);
    if (cells > kMostCells || cells > in.left() / sizeof(std::uint32_t))
      in.fail("there are fewer cells than the nodes have");
    tree.nodes_.push_back(node);
  }
  if (nodes == 0) in.fail("there is no root");
  tree.cells_ = TwoPartArray(in.get_array<std::uint32_t>(cells));
  tree.kinds_ = TwoPartArray(in.get_array<std::uint32_t>((cells + kPerWord - 1) / kPerWord));
  if (cells % kPerWord != 0 && tree.kinds_.back() >> cells % kPerWord * 2 != 0)
    in.fail("there are more kinds than cells");
  tree.pages_.resize((cells + kPage - 1) / kPage);
  NodeId at = 0;
  for (std::size_t p = 0; p < tree.pages_.size(); ++p) {
    while (at + 1 < nodes && tree.nodes_[at + 1].first <= p * kPage) ++at;
    tree.pages_[p] = at;
  }
  const auto events = in.get<std::uint32_t>();
  for (std::uint32_t e = 0; e < events; ++e) {
    Applied event{};
    event.kind = in.get<events::Kind>();
    for (NodeId* n : {&event.host, &event.first, &event.nodes}) *n = in.get<NodeId>();
    tree.events_.push_back(event);
  }
  check_cells(tree, in);
  check_events(tree, in);
  for (CellId c = 0; c < tree.nodes_[0].cells(); ++c)
    tree.has_holes_ = tree.has_holes_ || tree.kind(c) == CellKind::kVoid;
  return tree;
}

void Surface::save(ByteSink& out) const {
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

Surface Surface::load(ByteSource& in, const Tree& tree) {
  const Lattice& lattice = tree.lattice();
  Surface surface(lattice);
  const auto faces = in.get_array<Face>(in.get<std::uint32_t>());
  for (const Face& face : faces) {
    for (const CellId c : face) {
      if (c >= tree.cells() || tree.kind(c) != CellKind::kHeight) in.fail("a face has no such corner");
      const glm::vec3 p = tree.position(c);
      if (!sane(p.x) || !sane(p.y) || !sane(p.z)) in.fail("a face is nowhere");
    }
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0])
      in.fail("a face has fewer than three corners");
    if (surface.range(tree, face).count() > kMostSquares) in.fail("a face is too large");
  }
  if (!faces.empty() && (lattice.width < 2 || lattice.depth < 2))
    in.fail("there are faces where there is no square");
  std::vector<Square> covered;
  for (auto tiles = in.get<std::uint32_t>(); tiles > 0; --tiles) {
    const auto t = in.get<std::uint32_t>();
    const auto bits = in.get<std::array<std::uint64_t, kSquares / 64>>();
    if (t >= surface.tile_of_.size()) in.fail("a tile lies outside the terrain");
    for (std::uint32_t k = 0; k < kSquares; ++k) {
      if ((bits[k / 64] >> k % 64 & 1U) == 0) continue;
      const Square s{static_cast<int>(t % surface.tiles_x_ * kSide + k % kSide),
                     static_cast<int>(t / surface.tiles_x_ * kSide + k / kSide)};
      if (s.i < 1 || s.j < 1 || s.i + 2 >= lattice.width || s.j + 2 >= lattice.depth)
        in.fail("a face covers the border");
      for (int b = 0; b < 9; ++b) {
        if (hole(tree, {s.i - 1 + b % 3, s.j - 1 + b / 3})) in.fail("a face covers a hole");
      }
      covered.push_back(s);
    }
  }
  std::size_t entries = 0;
  for (const Face& face : faces) entries += surface.range(tree, face).count();
  require_memory(entries * (sizeof(Entry) + sizeof(Face)), "grounded heightmap tree");
  surface.prepare(tree, covered, faces);
  for (const Square s : covered) surface.set_covered(s, true);
  for (const Face& face : faces) surface.add(tree, face);
  return surface;
}

}  // namespace ght

using namespace ght;

void Ght::save(ByteSink& out) const {
  model_.tree.save(out);
  model_.surface.save(out);
  out.put(model_.floor);
  out.put(model_.ceiling);
}

std::unique_ptr<Representation> Ght::load(ByteSource& in) {
  std::unique_ptr<Ght> loaded(new Ght);
  Model& model = loaded->model_ = Model(Tree::load(in), 0, 0);
  model.surface = Surface::load(in, model.tree);
  model.floor = in.get<float>();
  model.ceiling = in.get<float>();
  if (!sane(model.floor) || !sane(model.ceiling) || model.floor > model.ceiling)
    in.fail("the bounds cannot be");
  check_plain(model, in);
  for (NodeId n = 1; n < model.tree.nodes().size(); ++n) {
    const Node& node = model.tree.nodes()[n];
    model.carved = model.carved || is_carving(model.tree.events()[node.event].kind);
    const SquareRange r = range(model.surface, model.tree.lattice(), node);
    constexpr int kSlack = 4;  // cells are no larger than squares
    if (std::max(r.i1 - r.i0, r.j1 - r.j0) > node.columns + node.rows + kSlack)
      in.fail("a node is too wide for its cells");
    if (node.area == Area::kOutdoor) model.index_node(n);
  }
  return loaded;
}

}  // namespace terrabench
