// The ground around a channel pixel as a block in space, with upright planes through the pixel: how the drill
// paper's figure 2 shows cross-sections being gathered. Orthographic, seen from the south-south-west.
// Distances are in samples, as the paper counts them; heights are stretched so that relief shows.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "terrain/heightfield.h"
#include "terrain/image.h"

namespace terrabench::drill {

class CuttingPlanes {
 public:
  static constexpr int kPlanes = 12;  // of the 120, evenly spaced: more would hide the ground
  static constexpr int kMargin = 4;   // samples of ground beyond the planes

  // Planes end `w` samples from the pixel, which lies at least w + kMargin samples from the border.
  CuttingPlanes(const Heightfield& ground, std::uint32_t pixel, int w);

  // O(pixels · side of the block), parallel.
  Image draw(int width, int height) const;
  // Metres of the ground per sample of distance that are drawn as long as each other.
  double metres_per_sample() const { return metres_; }

 private:
  struct Crossing {
    double along;  // the ray's parameter
    bool edge;     // near the plane's outline
  };

  double ground(double east, double south) const;  // height above the base in samples, bilinear
  bool inside(const glm::dvec3& p) const;
  glm::dvec3 origin(double x, double y, int width, int height) const;
  double per_pixel(int width, int height) const;
  Rgb surface(const glm::dvec3& p) const;
  Rgb colour(const glm::dvec3& from) const;
  // Those in front of the ray's parameter `end`, nearest first.
  std::vector<Crossing> crossings(const glm::dvec3& from, double end) const;

  Heightfield block_;  // (2·half + 1)², the pixel in its middle
  int w_, half_;
  double metres_ = 1, low_ = 0, top_ = 0;  // top: of the planes, in samples above the base
};

}  // namespace terrabench::drill
