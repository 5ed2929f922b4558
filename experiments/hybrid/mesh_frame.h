// A frame that draws one mesh, for measurements of what the landscape's shaders make of a known surface.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "terrain/frame.h"
#include "terrain/image.h"
#include "terrain/mesh.h"

namespace terrabench::hybrid {

class MeshFrame {
 public:
  explicit MeshFrame(TriangleMesh mesh)
      : mesh_(std::move(mesh)), entry_{1, mesh_.positions, mesh_.normals, mesh_.indices} {
    range_.target = DirtyRange::Target::kMesh;
    range_.count = static_cast<std::uint32_t>(entry_.bytes());
    frame_.meshes = {&entry_, 1};
    frame_.uploads = {&range_, 1};
    frame_.stats.triangles = mesh_.triangles();
  }
  MeshFrame(const MeshFrame&) = delete;
  MeshFrame& operator=(const MeshFrame&) = delete;
  const Frame& frame() const { return frame_; }

 private:
  TriangleMesh mesh_;
  FrameMesh entry_;
  DirtyRange range_;
  Frame frame_;
};

// A level square with its low corner at the origin, `side` metres wide.
inline TriangleMesh level_ground(float side) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, side}, {side, 0, 0}, {side, 0, side}};
  mesh.normals.assign(4, {0, 1, 0});
  mesh.indices = {0, 1, 2, 2, 1, 3};
  return mesh;
}

// The light that a byte of a picture shows, 0 to 1; exact below the display's shoulder (display.glsl).
inline double light_of(std::uint8_t byte) {
  const double c = byte / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

}  // namespace terrabench::hybrid
