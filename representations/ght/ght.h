// The Grounded Heightmap Tree as a representation (Alonso, Joan-Arinyo & Solano, "The Grounded Heightmap
// Tree. A New Data Structure for Terrain Representation"): a heightmap, and for every event on it further
// heightmaps on planes of their own, so that overhangs and tunnels are held where they are and nowhere else.
//
// Building is O(samples), an event O(region it touches). A column costs as in a heightmap plus one link where
// the surface is plain, else O(faces over its square).
#pragma once

#include <memory>

#include "representations/ght/dispatch.h"
#include "representations/representation.h"

namespace terrabench {

class Ght final : public Representation {
 public:
  static std::span<const ParameterSpec> parameters();
  // A sculpture's ground and then its events; heights alone; of other solids the topmost surface. Events
  // throw as ght::dispatch() does.
  static std::unique_ptr<Representation> build(const TerrainSource&, const Parameters&, Progress&);
  static std::unique_ptr<Representation> load(ByteSource&);
  // The root alone, from heights as check_heights() allows; the floor lies `floor` high.
  Ght(const ght::Lattice& lattice, std::vector<float> heights, float floor);

  // Strong guarantee.
  void apply(const events::Event& event) { dispatch(model_, event, model_.tree.events().size() + 1); }
  void limit_cells(std::uint32_t most) { model_.tree.limit_cells(most); }
  const ght::Model& model() const { return model_; }

  void spans(Columns where, SpanSink& out) const override;
  // Closed over all links. A detail other than the tree's own gives the topmost surface alone, as heights
  // that far apart: heightmaps that lean have no common coarser lattice.
  TriangleMesh mesh(MeshDetail) const override;
  Memory memory() const override;
  void save(ByteSink&) const override;
  Bounds bounds() const override;

 private:
  Ght() = default;

  ght::Model model_;
};

}  // namespace terrabench
