// How an event changes the surface: the part that it touches is cut out along a simple loop of cells, the
// event's new heightmaps are put into the hole, and the ring between the loop and their outline is closed
// with triangles between cells that exist on both sides. These triangles are the boundary links of the paper
// ("each cell in the boundary of a new heightmap is linked to the neighbor cell in another heightmap"): the
// surface is closed by construction, whatever lay there before. All costs are of the region touched.
//
// An Edit has three steps. Nodes are appended to the tree, which can be taken back; everything else is
// written down; commit() makes room for all of it and then changes the tree without a step that could fail.
// An Edit that goes out of scope before that leaves the tree as it was, to the bit.
//
// Carvings use the same steps: the walls come first, what they cut out of the ground at each mouth is the
// cut, and their rim is the outline that its ring closes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "representations/ght/surface.h"
#include "representations/ght/tree.h"
#include "terrain/error.h"

namespace terrabench::ght {

// Nodes by where they lie in plan, for finding an event's host. The list of a tile holds the nodes that touch
// it.
class NodeIndex {
 public:
  NodeIndex() = default;
  explicit NodeIndex(const Lattice& lattice);

  // Calls visit(NodeId) for nodes over the tile of a square, the latest first.
  template <class Visit>
  void over(Square s, const Visit& visit) const {
    for (std::uint32_t e = first_[tile(s)]; e != kNone; e = entries_[e].next) visit(entries_[e].node);
  }
  static std::size_t tiles(const SquareRange& range);
  void prepare(std::size_t tiles) { grow(entries_, entries_.size() + tiles); }  // finds room and may throw
  void add(const SquareRange& range, NodeId node) noexcept;
  Memory memory() const;

 private:
  static constexpr int kSide = 32;  // squares along a tile
  struct Entry {
    NodeId node;
    std::uint32_t next;
  };
  std::size_t tile(Square s) const {
    return static_cast<std::size_t>(s.j / kSide) * tiles_x_ + static_cast<std::size_t>(s.i / kSide);
  }
  std::size_t tiles_x_ = 0;
  std::vector<std::uint32_t> first_;
  std::vector<Entry> entries_;
};

// All that events change.
struct Model {
  Tree tree;
  Surface surface;
  NodeIndex index;               // of outdoor nodes but the root
  float floor = 0, ceiling = 0;  // under and over all ground, metres
  bool carved = false;           // whether there are tunnels or caves

  Model() = default;
  Model(Tree tree, float floor, float ceiling);
  void index_node(NodeId node);  // for loading; an Edit does it itself
};

// The cells of other nodes that a cell is linked to across its node's boundary: its corners' neighbours on
// all faces that it is part of, and around it on plain squares; ascending. Links run both ways. `c` holds a
// height.
void boundary_links(const Model& model, CellId c, std::vector<CellId>& out);

inline bool is_carving(events::Kind kind) {
  return kind == events::Kind::kTunnel || kind == events::Kind::kCave;
}
// Squares that a node's plane lies over.
SquareRange range(const Surface& surface, const Lattice& lattice, const Node& node);

// A rectangle in plan, perhaps turned: u0 ≤ u ≤ u1, d0 ≤ d ≤ d1 along and left of a line.
struct Region {
  events::Line line;
  double u0, u1, d0, d1;

  std::array<glm::dvec2, 4> corners() const;               // (x, z), counter-clockwise seen from above
  bool touches(std::array<glm::dvec2, 3> triangle) const;  // (x, z)
};

// A simple polygon in plan (x, z), and what is less than `margin` away from it.
struct Patch {
  std::span<const glm::dvec2> polygon;
  double margin;

  std::span<const glm::dvec2> corners() const { return polygon; }
  bool touches(std::array<glm::dvec2, 3> triangle) const;
};

// Why an event cannot be: thrown as bad_input that names the event.
class Refusal {
 public:
  explicit Refusal(std::string where) : where_(std::move(where)) {}
  [[noreturn]] void refuse(std::string_view what, std::string_view advice) const {
    throw bad_input(what, where_, advice);
  }

 private:
  std::string where_;
};

// The part of the surface that a region touches.
struct Cut {
  std::vector<Square> squares;     // plain ones, ascending
  std::vector<FaceId> faces;       // ascending
  std::vector<CellId> loop;        // around it, counter-clockwise seen from above
  std::vector<CellId> superseded;  // cells within the loop
};

// Squares and faces alone. Refuses ground at the terrain's border, without data, that lies over itself or
// that is the mouth of a carving.
Cut survey(const Model& model, const Region& region, const Refusal& refusal);
// With its loop; a bit more than the region touches where that has no simple loop. Refuses what has none.
Cut cut(const Model& model, const Region& region, const Refusal& refusal);
Cut cut(const Model& model, const Patch& patch, const Refusal& refusal);

class Edit {
 public:
  Edit(Model& model, const Refusal& refusal)
      : model_(model), refusal_(refusal), nodes_before_(model.tree.nodes().size()) {}
  ~Edit() {
    if (!committed_) model_.tree.truncate(nodes_before_);
  }
  Edit(const Edit&) = delete;
  Edit& operator=(const Edit&) = delete;

  Tree& tree() { return model_.tree; }  // only cells of new nodes may be changed
  // Appends a node of void cells.
  const Node& append(const Node& node) { return tree().nodes()[tree().append(node)]; }

  void remove(const Cut& cut);  // its squares and faces
  void face(CellId a, CellId b, CellId c) { faces_.push_back({a, b, c}); }
  // A quadrilateral, counter-clockwise seen from the air; voids and repeated cells make it a triangle or
  // nothing. Cells may be links.
  void quad(std::array<CellId, 4> corners);
  // All quadrilaterals of a node. `mirrored` when columns and rows run clockwise seen from the air.
  void quads(const Node& node, bool mirrored);
  std::span<const Face> faces() const { return faces_; }
  void drop_faces(std::size_t from) { faces_.resize(from); }
  void make_plain(Square s) { plain_.push_back(s); }
  // `old` becomes a link to `by`, which is later.
  void relink(CellId old, CellId by) { links_.push_back({old, by}); }
  // Triangles between the loop of a cut and the outline, both counter-clockwise. Refuses where one of the
  // outline's cells gets no link to another heightmap.
  void close_ring(std::span<const CellId> loop, std::span<const CellId> outline);
  // Refuses new heights within a cell of a tunnel or cave below.
  void keep_clear_of_carvings() const;

  // Throws, or does all of it.
  void commit(events::Kind kind, NodeId host);

 private:
  void check_faces() const;
  void check_linked(std::span<const CellId> outline) const;

  Model& model_;
  const Refusal& refusal_;
  std::size_t nodes_before_;
  bool committed_ = false;
  std::vector<Square> covered_, plain_;
  std::vector<FaceId> removed_;
  std::vector<Face> faces_;
  struct Link {
    CellId from, to;
  };
  std::vector<Link> links_;
};

}  // namespace terrabench::ght
