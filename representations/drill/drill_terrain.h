// The drill representation (Stuetzle & Franklin 2012, "Representing terrain with mathematical operators"):
// on disk only the drills are kept (drills.h, drill_codec.h); queries are answered by the terrain that they
// regenerate, which is held as a heightmap. Queries are as fast as a heightmap's, and memory is larger; on
// disk 13,000 drills for 400² samples take a thirtieth of the heights as floats, at an error of about 2 % of
// their range.
#pragma once

#include <memory>

#include "representations/drill/drills.h"
#include "representations/heightmap/heightmap.h"
#include "representations/representation.h"

namespace terrabench {

class DrillTerrain final : public Representation {
 public:
  static std::span<const ParameterSpec> parameters();
  // A solid gives its topmost surface. A terrain in which no flow reaches tau has no drills and becomes a
  // plateau. Throws usage_error for options that check_options() refuses and budgets that cannot be kept,
  // bad_input for heights beyond 10⁹ m.
  static std::unique_ptr<Representation> build(const TerrainSource&, const Parameters&, Progress&);
  static std::unique_ptr<Representation> load(ByteSource&);
  static std::unique_ptr<Representation> decode(ByteSource&);

  const Drills& drills() const { return drills_; }
  const Heightmap& surface() const { return *surface_; }  // the regenerated terrain

  void spans(Columns where, SpanSink& out) const override { surface_->spans(where, out); }
  TriangleMesh mesh(MeshDetail detail) const override { return surface_->mesh(detail); }  // as Heightmap's
  Memory memory() const override;  // payload: drills and regenerated heights; index: positions and directions
  void save(ByteSink&) const override;
  bool encode(double largest_error, ByteSink&) const override;  // as save(): building rounds
  Bounds bounds() const override { return surface_->bounds(); }
  LineGrid lines() const override;
  std::unique_ptr<RayCaster> ray_caster() const override;  // as Heightmap's
  std::vector<std::pair<std::string, std::string>> facts() const override;

 private:
  DrillTerrain(Drills drills, HeightGrid grid);

  Drills drills_;
  std::unique_ptr<Heightmap> surface_;
  std::int64_t tau_ = 0;  // that found the channels, for facts(); 0: not known, of a loaded file
};

}  // namespace terrabench
