// Where grass grows and how much of it (hybrid paper, §3.3): the triangles whose slope is below a limit, and
// the number of strands on each. Decided here, on the processor, so that every GPU draws the same number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "terrain/mesh.h"

namespace terrabench {

// The angle of a surface whose unit normal has this y, in degrees. The paper's (1 − y) · 90 is 0 for level
// ground, 90 for a wall and 180 for a ceiling, as the true angle acos(y), but up to 19° less in between.
enum class SlopeAngle : std::uint8_t { kPrinted, kTrue };
double slope_angle(double normal_y, SlopeAngle);

// How a strand's root follows from the corners A, B, C and the barycentric coordinates (a, b, c). The paper
// prints A × a × B × b × C × c. Only the sum is a point of the triangle.
enum class PointReading : std::uint8_t {
  kSum,           // A·a + B·b + C·c
  kProduct,       // the products by component, as a shading language multiplies vectors
  kCrossProduct,  // (A·a × B·b) × C·c
};

// Where the pseudo-random numbers come from.
enum class RandomReading : std::uint8_t {
  kHash,     // integers that are scrambled from the bits of the corners: the same on every GPU
  kPrinted,  // the sine of large numbers, as in the paper: each GPU places the strands elsewhere
};

struct GrassGrowth {
  std::int64_t strands = 0;  // on all triangles together, with two billboards each; at most kMostStrands
  float steepest = 45;       // degrees; no grass on triangles with a larger slope angle
  SlopeAngle slope = SlopeAngle::kPrinted;
  PointReading point = PointReading::kSum;
  RandomReading random = RandomReading::kHash;
  bool by_area = false;  // strands per area are equal; otherwise strands per triangle, as in the paper
  bool turned = false;   // billboards stand in any direction; otherwise along a triangle's first edge, as in
                         // the paper, which shows as rows on regular meshes
  float height = 0.4F, width = 0.4F;  // metres, of a billboard in the mean
  float height_variation = 0.35F;     // guide strands are higher or lower by up to this share
  float texture_metres = 8;  // of ground per unit of the texture coordinates, which seed the printed numbers

  static constexpr std::int64_t kMostStrands = 4'194'240;
};

// Borrowed for the duration of a call.
struct GrassGround {
  std::span<const glm::vec3> positions, normals;  // metres; unit length, one per position
  std::span<const std::uint32_t> indices;         // three per triangle, counter-clockwise seen from the air
};
GrassGround grass_ground(const TriangleMesh&);

struct GrassPlan {
  // Consecutive triangles with the same number of strands, at least 1.
  struct Run {
    std::uint32_t first = 0, triangles = 0, strands = 0;  // strands of each
  };
  // Corners a, b, c and, as w, the number of the triangle's first strand; one entry more, with w = strands.
  // Those with the most strands come first.
  std::vector<glm::uvec4> triangles;
  std::vector<Run> runs;

  std::size_t growing() const { return triangles.empty() ? 0 : triangles.size() - 1; }
  std::int64_t strands() const { return triangles.empty() ? 0 : triangles.back().w; }
};

// Spreads the strands evenly over the triangles that are not too steep: each gets the same number, or one
// more. Triangles without area and those with coordinates or normals that are not finite get none; without
// any triangle to grow on, there are no strands. Throws usage_error for a number of strands outside its
// range, lengths that are not positive, other numbers of normals than of positions, and indices out of range.
// O(n log n) for n triangles.
GrassPlan plan_grass(const GrassGround&, const GrassGrowth&);

}  // namespace terrabench
