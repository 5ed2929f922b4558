#include "representations/procedural_mesh/displaced_plane.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>

#include "representations/procedural_mesh/subdivision/subdivide.h"

namespace terrabench {
namespace {

class Plane {
 public:
  Plane(const HeightTexture& texture, int levels) : texture_(texture), stride_(std::size_t{1} << levels) {}

  FaceMesh base() const {
    const std::size_t cells_x = cells(texture_.x.size()), cells_z = cells(texture_.z.size());
    FaceMesh mesh;
    for (std::size_t j = 0; j <= cells_z; ++j) {
      for (std::size_t i = 0; i <= cells_x; ++i) {
        mesh.texture.emplace_back(i * stride_, j * stride_);
        mesh.positions.push_back(position(mesh.texture.back()));
        if (std::isnan(mesh.positions.back().y)) mesh.positions.back().y = 0;
      }
    }
    for (std::size_t j = 0; j < cells_z; ++j) {
      for (std::size_t i = 0; i < cells_x; ++i) {
        const auto north = static_cast<std::uint32_t>(j * (cells_x + 1) + i);
        const auto south = static_cast<std::uint32_t>(north + cells_x + 1);
        mesh.add_face({north, south, south + 1, north + 1});
      }
    }
    return mesh;
  }

  // Texture coordinates count texels while the plane is subdivided, so that they stay whole numbers.
  subdivision::PlacementRule rule() const {
    using namespace subdivision;
    PlacementRule rule;
    rule.base = rule.texture = Base::kLinear;
    const Signal up = [this](const VertexBatch& batch, std::span<float> out) {
      for (std::size_t v = 0; v < out.size(); ++v) {
        const float height = position(batch.texture[v]).y;
        out[v] = std::isnan(height) ? 0 : height - batch.positions[v].y;
      }
    };
    rule.displacements.push_back(
        {.axis = Axis::kFixed, .by_scale = false, .where = Where::kNewVertices, .amount = up});
    return rule;
  }

  // Beyond the border lies the border.
  glm::uvec2 texel(glm::vec2 at) const {
    return glm::min(glm::uvec2(at), glm::uvec2(texture_.x.size() - 1, texture_.z.size() - 1));
  }
  glm::vec3 position(glm::vec2 at) const {
    const glm::uvec2 t = texel(at);
    return {texture_.x[t.x], texture_.heights[t.y * texture_.x.size() + t.x], texture_.z[t.y]};
  }

 private:
  std::size_t cells(std::size_t lines) const { return (lines - 2) / stride_ + 1; }

  const HeightTexture& texture_;
  std::size_t stride_;
};

// Faces whose vertices have a height and lie apart, and their vertices.
FaceMesh faces_with_heights(FaceMesh&& mesh, const Plane& plane) {
  constexpr std::uint32_t kUnused = 0xFFFFFFFFU;
  FaceMesh kept;
  std::vector<std::uint32_t> number(mesh.positions.size(), kUnused);
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const auto corners = mesh.face(f);
    const auto texel = [&](std::size_t k) { return plane.texel(mesh.texture[corners[k]]); };
    const bool flat = texel(0) == texel(1) || texel(1) == texel(2);
    const bool full =
        std::ranges::none_of(corners, [&](std::uint32_t v) { return std::isnan(mesh.positions[v].y); });
    if (flat || !full) continue;
    for (const std::uint32_t corner : corners) {
      if (number[corner] != kUnused) continue;
      number[corner] = static_cast<std::uint32_t>(kept.positions.size());
      kept.positions.push_back(mesh.positions[corner]);
      kept.texture.push_back(mesh.texture[corner]);
    }
    kept.add_face({number[corners[0]], number[corners[1]], number[corners[2]], number[corners[3]]});
  }
  return kept;
}

}  // namespace

int usable_levels(const HeightTexture& texture, int levels) {
  const std::size_t lines = std::min(texture.x.size(), texture.z.size());
  if (lines < 2) return 0;
  return std::min(levels, static_cast<int>(std::bit_width(lines - 1)) - 1);
}

FaceMesh displaced_plane(const HeightTexture& texture, int levels, int leave_out) {
  if (std::min(texture.x.size(), texture.z.size()) < 2) return {};
  levels = usable_levels(texture, levels);
  const Plane plane(texture, levels);
  const std::vector<subdivision::PlacementRule> rules(
      static_cast<std::size_t>(std::max(0, levels - leave_out)), plane.rule());
  subdivision::RefinementOptions options;
  options.most_faces = std::uint64_t{1} << 28;
  FaceMesh mesh = subdivision::subdivide(plane.base(), rules, options);
  // Sums of displacements round; the texture does not. Neither are halves of uneven lines the lines between.
  tbb::parallel_for(std::size_t{0}, mesh.positions.size(),
                    [&](std::size_t v) { mesh.positions[v] = plane.position(mesh.texture[v]); });
  mesh = faces_with_heights(std::move(mesh), plane);
  const glm::vec2 last(texture.x.size() - 1, texture.z.size() - 1);
  for (glm::vec2& t : mesh.texture) t = glm::vec2(std::min(t.x, last.x), std::min(t.y, last.y)) / last;
  return mesh;
}

}  // namespace terrabench
