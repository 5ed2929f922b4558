// The Grounded Heightmap Tree as a representation (Alonso, Joan-Arinyo & Solano, "The Grounded Heightmap
// Tree. A New Data Structure for Terrain Representation"): a heightmap, and for every event on it further
// heightmaps on planes of their own, so that overhangs and tunnels take memory only where they are.
//
// Building is O(samples), an event O(region it touches). A column costs as much as in a heightmap plus one
// link where the surface is plain, otherwise O(faces over its square).
//
//   event                            in the paper            its new heightmaps are made in
//   LinearErosion                    §3.2, figures 13, 17    linear_erosion.cpp
//   RadialErosion                    §3.2, figures 13, 17    radial_erosion.cpp
//   DipFault (normal and inverse)    §3.2, figures 13, 18    dip_fault.cpp
//   LateralFault                     §3.2, figure 13         lateral_fault.cpp
//   Carving (tunnel and cave)        §3.2, figures 15, 16    carving.cpp, carving_walls.cpp
//
// To follow one event, such as a dip fault: the opening comment of edit.h; the event's file (dip_fault.cpp),
// its opening comment and then from stage() at the end; join_to_ground() in along_line.cpp; Edit::apply()
// in edit.cpp. What can wait: the formula as data (terrain/events/event.h), cut_out.h, the
// triangles of the ring (close_ring()).
#pragma once

#include <memory>

#include "representations/ght/apply_event.h"
#include "representations/representation.h"

namespace terrabench {

class Ght final : public Representation {
 public:
  static std::span<const ParameterSpec> parameters();
  // From a sculpture its ground and then its events; from a heightfield its heights; from any other solid its
  // topmost surface. Throws as ght::apply_event() does.
  static std::unique_ptr<Representation> build(const TerrainSource&, const Parameters&, Progress&);
  static std::unique_ptr<Representation> load(ByteSource&);
  static std::unique_ptr<Representation> decode(ByteSource&);
  // The root only, from heights that check_heights() accepts. `floor` is the lowest height of the solid.
  Ght(const ght::SampleGrid& grid, std::vector<float> heights, float floor);

  // Strong guarantee.
  void apply(const events::Event& event) override {
    apply_event(model_, event, model_.tree.events().size() + 1);
  }
  void limit_cells(std::uint32_t most) { model_.tree.limit_cells(most); }
  const ght::Model& model() const { return model_; }

  void spans(Columns where, SpanSink& out) const override;
  // A closed mesh of all heightmaps. Any detail other than the tree's own gives only the topmost surface, as
  // heights that far apart: inclined heightmaps have no common coarser grid.
  TriangleMesh mesh(MeshDetail) const override;
  Memory memory() const override;
  void save(ByteSink&) const override;
  bool encode(double largest_error, ByteSink&) const override;
  Bounds bounds() const override;
  LineGrid lines() const override;
  std::unique_ptr<RayCaster> ray_caster() const override;
  // A census of the tree, and whether its invariants hold.
  std::vector<std::pair<std::string, std::string>> facts() const override;

 private:
  Ght() = default;
  static std::unique_ptr<Representation> with_tree(ght::Tree, ByteSource& rest);

  ght::Model model_;
};

}  // namespace terrabench
