// A ray-traced picture that gets better with each sample. Its pixels depend on the scene, the view and the
// number of samples alone: not on the number of threads, nor on how the samples are divided into calls.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "renderers/raytrace/path_tracer.h"
#include "renderers/raytrace/ray_camera.h"
#include "renderers/raytrace/ray_scene.h"
#include "terrain/image.h"
#include "terrain/progress.h"
#include "terrain/view.h"

namespace terrabench {

class RaytracedPicture {
 public:
  // Throws as PathTracer and RayCamera do, environment_error for lack of memory. The scene must outlive it.
  // 20 bytes per pixel.
  RaytracedPicture(const RayScene&, const View&, const RaytraceSettings& = {}, Progress* = nullptr);

  // Until every pixel has so many samples; settings.samples if 0. In parallel, tile by tile, in passes over
  // the whole picture. Throws Error(kInterrupted) after Progress::interrupt(), which leaves tiles with
  // different numbers of samples, and a picture that a further call continues; bad_input where a material is
  // not finite. O(pixels · samples · bounces) rays.
  void accumulate(int samples = 0, Progress* = nullptr);

  int samples() const;  // of the pixel that has the fewest
  // The mean of the samples that do not show the scene's background; black for none.
  glm::vec3 radiance(int x, int y) const;
  // Surfaces and sky are tone mapped, the background is not.
  Image image() const;
  // The number of the instance in the middle of the pixel, plus 1; 0 for the sky.
  std::uint32_t object(int x, int y) const { return objects_[pixel(x, y)]; }

  int width() const { return width_; }
  int height() const { return height_; }
  const PathTracer& tracer() const { return tracer_; }

 private:
  static constexpr int kTile = 32;  // pixels along its sides
  struct Tile {
    int x0, y0, x1, y1;
    int samples = 0;
  };
  std::size_t pixel(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }
  const Tile& tile_at(int x, int y) const;
  void trace(Tile&, int until);
  // False for one that shows the background.
  bool sample(int x, int y, int number, glm::vec3& radiance) const;
  float wire_opacity(const glm::vec2& at, const RayHit&) const;

  RayCamera camera_;
  RaytraceSettings settings_;
  PathTracer tracer_;
  int width_, height_, tiles_across_;
  bool has_wires_;
  std::vector<Tile> tiles_;
  std::vector<glm::vec3> sums_;         // per pixel
  std::vector<std::uint32_t> counted_;  // samples in the sum
  std::vector<std::uint32_t> objects_;
};

// A whole picture in one call.
Image raytrace(const RayScene&, const View&, const RaytraceSettings& = {}, Progress* = nullptr);

}  // namespace terrabench
