// The implicit surface of the hybrid paper (§3.1.2): the zero set of the stacks' convolution with a kernel,
// as a mesh. Holds the stacks alone; surfaces are made when they are asked for, so that an edit costs no more
// than the stacks' own, and its caller rebuilds the chunks whose version grew.
//
// spans() and mesh() agree: the solid is where the field is positive at the lattice's points, linear between
// them along y. What is thinner than the kernel's radius may vanish, and corners are rounded: this is no
// lossless structure, and materials come back as bedrock.
//
// mesh() is closed: by the box of bounds() along the sides and the floor, whose upper edges share vertices
// and normals with the surface. chunk() has the surface alone, without these walls. Where the field is
// exactly 0 at a lattice point, triangles without area are possible.
#pragma once

#include <memory>
#include <vector>

#include "representations/implicit/block_sweep.h"
#include "representations/implicit/stack_field.h"
#include "terrain/mesh_chunks.h"

namespace terrabench {

class ImplicitSurface final : public Representation, public MeshChunks {
 public:
  static std::span<const ParameterSpec> parameters();
  static std::unique_ptr<Representation> build(const TerrainSource&, const Parameters&, Progress&);
  static std::unique_ptr<ImplicitSurface> build_surface(const TerrainSource&, const Parameters&, Progress&);
  static std::unique_ptr<Representation> load(ByteSource&);
  static std::unique_ptr<Representation> decode(ByteSource&);

  // `radius` and `cell` in metres; 0 for automatic ones: a kernel of two columns, and cells of one column, or
  // larger if the terrain would have more than 1024 of them along y. Throws usage_error as StackField, and
  // for more than kMaxCells cells along an axis.
  ImplicitSurface(std::unique_ptr<LayeredStack>, Kernel, double radius, double cell, Extractor);

  const LayeredStack& stack() const { return *stack_; }
  const StackField& field() const { return field_; }
  const FieldLattice& lattice() const { return lattice_; }

  // O(columns of the kernel's support · levels of the lattice) per line.
  void spans(Columns where, SpanSink& out) const override;
  // Samples two points of the lattice's line per position, or a whole line where positions share it.
  void materials(Points where, std::span<Material> out) const override;
  // Edits the stacks; versions grow of all chunks that the kernel around the columns reaches.
  void edit(Columns where, std::span<const Span> what) override;
  ThermalErosion erode_to(double talus, Progress&) override;
  TriangleMesh mesh(MeshDetail) const override;
  Memory memory() const override;
  void save(ByteSink&) const override;
  bool encode(double largest_error, ByteSink&) const override;
  Bounds bounds() const override { return stack_->bounds(); }
  std::optional<LineGrid> edited_lines() const override;
  std::unique_ptr<RayCaster> ray_caster() const override;  // the zero set, which mesh() approximates

  static constexpr int kMaxCells = 65535;

  // Chunks of 32 × 32 cells. At all details normals come from differences over one cell of detail 0, so that
  // an edit never changes a chunk farther away than the kernel and a cell. Where the terrain is no whole
  // number of cells, the last lattice point lies on its border instead of beyond.
  float cell() const override { return lattice_.cell; }
  int cells() const override { return kChunkCells; }
  glm::ivec2 chunks() const override { return chunks_; }
  TriangleMesh chunk(glm::ivec2 at, int detail) const override;
  std::uint64_t version(glm::ivec2 at) const override { return versions_[number(at)]; }

 private:
  static constexpr int kChunkCells = 32;
  std::size_t number(glm::ivec2 at) const {
    return static_cast<std::size_t>(at.y) * static_cast<std::size_t>(chunks_.x) +
           static_cast<std::size_t>(at.x);
  }
  void save_field(ByteSink&) const;
  static std::unique_ptr<Representation> with_field(std::unique_ptr<Representation> stack, ByteSource&);
  void touch(int column_i, int column_j);

  std::unique_ptr<LayeredStack> stack_;
  StackField field_;
  FieldLattice lattice_;
  Extractor extractor_;
  glm::ivec2 chunks_{1};
  std::vector<std::uint64_t> versions_;  // per chunk, row by row
};

}  // namespace terrabench
