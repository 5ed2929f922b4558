// One event's change to a grounded heightmap tree, all of it or nothing. Every event is a function that
// stages the same four steps in an Edit (ours; for the paper's four, figure 12, see apply_event.h):
//   1. cut out: the part of the surface that the event touches is removed, up to a simple loop of cells;
//   2. new heightmaps are appended to the tree and their quadrilaterals become faces;
//   3. the outline of the new heightmaps lists their boundary cells;
//   4. join: triangles close the ring between loop and outline; superseded cells become links to new ones.
// The ring's corners are cells of the old and of the new heightmaps, so the surface stays closed, whatever
// earlier events left there. commit() also notes which cells now meet along the boundaries of heightmaps:
// the boundary links of §3.2 (boundary_links.h), which are not link cells.
//
// Square: between four of the root's samples; plain (two triangles) or covered by faces. Face: a triangle
// between any three cells, kept in Model::surface, not in the tree. Cell: a height, a link to a later cell,
// or void. Loop: the cells around the removed part. Outline: the boundary cells of the new heightmaps. Host:
// the parent of the new heightmaps. apply_event() finds it, creates the Edit, calls stage() and then
// commit().
//
// Before commit(), an Edit only appends nodes to the tree. The destructor removes them unless commit()
// succeeded; the tree is then as it was, to the bit. commit() first allocates all that it needs, then changes
// the tree by steps that cannot fail. Every cost is proportional to the region that the event touches.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "representations/ght/model.h"

namespace terrabench::ght {

inline constexpr std::string_view kNoData = "touches ground without data";
inline constexpr std::string_view kFillNoData = "fill the samples without data, or move the event";
inline constexpr std::string_view kMove = "move the event, or make it smaller";

class Edit {
 public:
  // New nodes become children of `host`, which must contain the event's region. `where` names the event in
  // errors.
  Edit(Model& model, NodeId host, std::string where)
      : model_(model), host_(host), where_(std::move(where)), nodes_before_(model.tree.nodes().size()) {}
  ~Edit() {
    if (!committed_) model_.tree.truncate(nodes_before_);
  }
  Edit(const Edit&) = delete;
  Edit& operator=(const Edit&) = delete;

  const Model& model() const { return model_; }
  const Tree& tree() const { return model_.tree; }
  const SampleGrid& grid() const { return model_.tree.grid(); }
  // Throws bad_input that names the event.
  [[noreturn]] void refuse(std::string_view what, std::string_view advice) const;
  // For an event whose region is known only after its first steps: before any heightmap is appended.
  void set_host(NodeId host) { host_ = host; }
  // Height of the ground before the event; refuses ground without data.
  float ground(glm::dvec2 plan) const;

  // Step 1. On commit(), the squares count as covered by faces, and the faces are removed.
  void remove(std::span<const Square> squares, std::span<const FaceId> faces);

  // Step 2. Appends a heightmap of void cells as a child of the host.
  GroundedHeightmap append(GroundedHeightmap heightmap);
  // For cells of new heightmaps only.
  void set_height(CellId c, float height) { model_.tree.set_height(c, height); }
  void set_link(CellId c, CellId target) { model_.tree.set_link(c, target); }
  void face(CellId a, CellId b, CellId c) { faces_.push_back({a, b, c}); }
  // Adds two faces, split along the shorter diagonal. Corners are counter-clockwise seen from the air and may
  // be links. Void and repeated corners are left out; of three, one face is made, of fewer none.
  void quad(std::array<CellId, 4> corners);
  // Adds all quadrilaterals of a heightmap. `mirrored`: the turn from columns to rows is clockwise seen from
  // the air.
  void quads(const GroundedHeightmap& heightmap, bool mirrored);
  std::span<const Face> faces() const { return faces_; }
  // Drops the recorded faces from number `from` on.
  void drop_faces(std::size_t from) { faces_.resize(from); }
  // On commit(), the square becomes plain again.
  void make_plain(Square s) { plain_.push_back(s); }

  // Step 4. On commit(), the cell `old` becomes a link to `by`, which must be a later cell.
  void supersede(CellId old, CellId by) { superseded_.emplace_back(old, by); }
  // Adds the triangles between a loop and an outline, both counter-clockwise. Refuses unless every cell of
  // the outline is a corner of a triangle that also has a corner in another heightmap.
  void close_ring(std::span<const CellId> loop, std::span<const CellId> outline);
  // Refuses the event if a new height lies less than one sample spacing above the roof of a tunnel or cave.
  void keep_clear_of_carvings() const;

  // Applies everything staged, or throws and changes nothing.
  void commit(events::Kind kind) { apply(kind, prepare()); }

 private:
  // All that apply() needs, so that it cannot fail.
  struct Prepared {
    std::vector<ComposedSurface::Placed> placed;  // per new face
    std::vector<FaceId> ids;                      // room for theirs
    std::vector<CellId> superseded;               // ascending
    RimChange rim;
    float lowest, highest;  // of the new heights
  };
  Prepared prepare();
  void apply(events::Kind, Prepared);
  NodeId first_new() const { return static_cast<NodeId>(nodes_before_); }
  // Visits the new nodes that are indexed.
  template <class Visit>
  void each_outdoor(const Visit& visit) const {
    for (NodeId n = first_new(); n < tree().nodes().size(); ++n) {
      if (tree().nodes()[n].area == Area::kOutdoor) visit(n, model_.range(tree().nodes()[n]));
    }
  }
  void check_faces() const;
  void check_joined(std::span<const CellId> outline) const;
  std::vector<std::pair<CellId, CellId>> joined_cells(std::span<const CellId> loop) const;

  Model& model_;
  NodeId host_;
  std::string where_;
  std::size_t nodes_before_;
  bool committed_ = false;
  std::vector<Square> covered_, plain_;
  std::vector<FaceId> removed_;
  std::vector<Face> faces_;
  std::vector<std::pair<CellId, CellId>> superseded_;  // old cell, new cell
};

}  // namespace terrabench::ght
