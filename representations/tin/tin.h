// Triangulated irregular network: the samples of a heightmap that greedy insertion picks (Garland & Heckbert
// 1995), triangulated by Delaunay; the ground is linear on each triangle. The one knob is the largest error.
// 56 B per vertex, of which 48 B are the triangles, and 2 to 4 B to find them by; a query walks over a few
// triangles, O(1) on most ground. An edit triangulates again what it changes (reinsertion.h).
//
// To follow a TIN: greedy_insertion.h (which samples), delaunay.h (how they are joined), then here.
#pragma once

#include <optional>
#include <vector>

#include "representations/heightmap/heightmap.h"
#include "representations/line_grid.h"
#include "representations/representation.h"
#include "representations/tin/locator.h"
#include "terrain/tin/greedy_insertion.h"

namespace terrabench {

class Tin final : public Representation {
 public:
  static std::span<const ParameterSpec> parameters();
  // A solid gives its topmost surface. Throws usage_error for fewer than 2 × 2 samples.
  static std::unique_ptr<Representation> build(const TerrainSource&, const Parameters&, Progress&);
  static std::unique_ptr<Representation> load(ByteSource&);
  static std::unique_ptr<Representation> decode(ByteSource&);

  const tin::Approximation& ground() const { return ground_; }
  std::size_t triangles() const { return ground_.surface.triangles().size(); }
  // As Heightmap::height(): no-data outside the bounds and in holes; between the outermost samples and the
  // bounds the border's height continues.
  float height(float x, float z) const;

  void spans(Columns where, SpanSink& out) const override;
  // The samples change as those of a heightmap that has this surface's heights, and no sample then is missed
  // by more than the largest error that the TIN was built with. Edits beside each other can each move
  // samples between them by as much; over 1,000 random spheres on hills it came to 1.8 times as much.
  // After a throw for want of memory the TIN must not be used.
  void edit(Columns where, std::span<const Span> what) override;
  std::optional<LineGrid> edited_lines() const override { return lines(); }
  // The triangles, closed by walls along the border and around holes and by the same triangles at the floor.
  TriangleMesh mesh(MeshDetail) const override;
  Memory memory() const override;  // payload: vertices and heights; index: triangles and where to find them
  void save(ByteSink&) const override;  // vertices and heights alone, which determine the triangles
  bool encode(double largest_error, ByteSink&) const override;
  Bounds bounds() const override { return grid_.bounds; }
  LineGrid lines() const override;
  std::vector<std::pair<std::string, std::string>> facts() const override;

 private:
  // In order.
  Tin(const HeightGrid& grid, float largest_error, tin::Approximation);
  float height_in(const tin::Triangle&, double i, double j) const;
  std::optional<tin::Locator::Point> point_at(float x, float z) const;  // none outside the bounds
  float height_at(tin::Locator::Point, std::uint32_t triangle) const;
  void heights(Columns where, std::span<float> tops) const;  // of up to Locator::kAtOnce columns
  glm::vec3 position(std::uint32_t vertex) const;
  // `numbers`: of the vertices among the positions.
  void add_margin(std::span<const std::uint32_t> numbers, std::vector<glm::vec3>& positions,
                  std::vector<glm::u32vec3>& triangles) const;

  tin::Approximation in_order() const;

  HeightGrid grid_;
  float largest_error_;  // metres
  tin::Approximation ground_;
  bool edited_ = false;  // the ground is not in order
  tin::Locator locator_;
};

}  // namespace terrabench
