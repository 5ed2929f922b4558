// Meshes of "meshgrow" (Tobler, Maierhofer and Wilkie) as terrain: a plane displaced by heights (§3), a model
// of any form (§3 to §5), or a model that stands on such a plane.
//
// What is solid follows from signed crossings with the expanded mesh, which a vertical line passes from far
// above: closed parts fill their inside, and what overlaps is united; below an open sheet, such as a
// displaced plane, the ground is solid down to the floor. An open sheet must look up. Everything is bedrock.
//
// A solid loses all but its topmost surface, since no rules are known that approximate a given shape (§3: "we
// cannot automatically generate the rules"). Heights come back to the bit at their samples, and on two
// triangles per cell between them; a single row or column of samples has no area and is empty, and so is a
// sample all of whose cells lack a height.
//
// The file is the description alone, and is expanded again by load(). In memory both are held: about 55 B per
// quadrilateral besides the description. A column query is O(triangles near it).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "representations/procedural_mesh/displaced_plane.h"
#include "representations/procedural_mesh/triangle_columns.h"
#include "representations/representation.h"

namespace terrabench {

// What the terrain is expanded from.
struct MeshDescription {
  // A plane displaced by a texture; no lines: none.
  HeightTexture ground;
  Bounds ground_bounds;  // low.y is the floor
  int levels = 0;        // subdivisions of the plane
  // A model as text (model.h), scaled, then moved; empty: none.
  std::vector<char> model;
  float scale = 1;
  glm::vec3 offset{0};

  int leave_out = 0;  // of the last subdivisions, of the plane and of the model

  bool has_ground() const { return !ground.x.empty(); }
  // Expanded; so many more of the last levels are left out, as far as there are levels. `origin` names the
  // model in errors. Throws what parse_model() and growing::expand() throw.
  FaceMesh polygons(const std::string& origin, int leave_out_more = 0) const;
  // With `largest_error` as Representation::encode() does.
  void save(ByteSink&, std::optional<double> largest_error = {}) const;
  static MeshDescription load(ByteSource&, bool encoded = false);
};

class ProceduralMesh final : public Representation {
 public:
  static std::span<const ParameterSpec> parameters();
  // A source that was opened from a model (model_terrain.h) is expanded again from its own description.
  static std::unique_ptr<Representation> build(const TerrainSource&, const Parameters&, Progress&);
  static std::unique_ptr<Representation> load(ByteSource&);
  static std::unique_ptr<Representation> decode(ByteSource&);
  // Throws as polygons(), and bad_input for a model whose open sheets look down.
  ProceduralMesh(MeshDescription, const std::string& origin);

  const MeshDescription& description() const { return description_; }
  std::size_t description_bytes() const;  // as save() writes it
  std::size_t expanded_bytes() const { return columns_.memory().total(); }
  const TriangleColumns& columns() const { return columns_; }
  // The polygons, expanded once more.
  FaceMesh polygons() const override { return description_.polygons("model"); }

  void spans(Columns where, SpanSink& out) const override;
  // The triangles that spans() crosses; sheets are closed by walls and a floor. Watertight, but parts that
  // overlap stay as they are. Detail: the last levels are left out while edges stay shorter than a cell.
  TriangleMesh mesh(MeshDetail) const override;
  // Payload: description and triangles; index: the bins of columns.
  Memory memory() const override;
  void save(ByteSink& out) const override { description_.save(out); }
  bool encode(double largest_error, ByteSink&) const override;
  Bounds bounds() const override { return bounds_; }
  std::vector<std::pair<std::string, std::string>> facts() const override;

 private:
  MeshDescription description_;
  TriangleColumns columns_;
  Bounds bounds_;
  float spacing_ = 0;  // metres between neighbouring vertices
};

// A procedural mesh as the solid of a terrain source, from which any representation may be built. build()
// recognises it and expands its description again.
struct MeshColumns {
  std::shared_ptr<const ProceduralMesh> mesh;
  void operator()(const ColumnSamples&, std::span<Material>) const;
};

}  // namespace terrabench
