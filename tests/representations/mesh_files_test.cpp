// PLY and OBJ files: what is written is read again.
#include "representations/procedural_mesh/mesh_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/representations/face_shapes.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench {
namespace {

using testing::HasSubstr;

void expect_same(const FaceMesh& a, const FaceMesh& b) {
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.texture, b.texture);
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.first_corner, b.first_corner);
}

FaceMesh textured(FaceMesh mesh) {
  for (const glm::vec3& p : mesh.positions) mesh.texture.push_back({p.x / 3, p.z * 7});
  return mesh;
}

TEST(MeshFiles, WriteAndReadTheSame) {
  const TemporaryFolder folder;
  for (const Shape& shape : shapes()) {
    for (const bool with_texture : {false, true}) {
      const FaceMesh mesh = with_texture ? textured(shape.mesh) : shape.mesh;
      for (const char* name : {"a.ply", "a.OBJ"}) {
        SCOPED_TRACE(shape.name + " " + name);
        write_mesh(folder / name, mesh);
        expect_same(mesh, read_mesh(folder / name));
      }
    }
  }
  EXPECT_EQ(folder.names().size(), 2U);  // no temporary file is left
}

TEST(MeshFiles, AnEmptyMeshIsAMesh) {
  const TemporaryFolder folder;
  for (const char* name : {"a.ply", "a.obj"}) {
    write_mesh(folder / name, FaceMesh{});
    EXPECT_TRUE(read_mesh(folder / name).positions.empty());
  }
}

TEST(MeshFiles, OtherFilesAreRefused) {
  const TemporaryFolder folder;
  const auto what = [&](const char* name, const std::string& content) {
    return failure_of([&] { read_mesh(folder.write(name, content)); }).what;
  };
  EXPECT_THAT(what("a.stl", "solid"), HasSubstr(".ply or .obj"));
  EXPECT_THAT(what("a.ply", "nothing"), HasSubstr("cannot read"));
  EXPECT_THAT(what("a.ply",
                   "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                   "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                   "0 0 0 1 0 0 0 1 0 3 0 1 9"),
              HasSubstr("vertex 9 of 3"));
  EXPECT_THAT(failure_of([&] { read_mesh(folder / "missing.ply"); }).what, HasSubstr("missing.ply"));
}

}  // namespace
}  // namespace terrabench
