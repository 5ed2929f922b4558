// A frame that draws one mesh through the landscape's renderer, without a level-of-detail method.
#pragma once

#include <utility>

#include "terrain/frame.h"
#include "terrain/mesh.h"

namespace terrabench::figures {

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

}  // namespace terrabench::figures
