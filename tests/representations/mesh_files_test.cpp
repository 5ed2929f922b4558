// PLY and OBJ files: what is written is read again, files of other programs, and damaged files.
#include "representations/procedural_mesh/mesh_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "terrain/files.h"
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
      for (const char* name : {"a.ply", "ascii.ply", "a.OBJ"}) {
        SCOPED_TRACE(shape.name + " " + name);
        write_mesh(folder / name, mesh, name[1] == 's' ? PlyForm::kAscii : PlyForm::kBinary);
        expect_same(mesh, read_mesh(folder / name));
      }
    }
  }
  EXPECT_EQ(folder.names().size(), 3U);  // no temporary file is left
}

TEST(MeshFiles, AnEmptyMeshIsAMesh) {
  const TemporaryFolder folder;
  for (const char* name : {"a.ply", "a.obj"}) {
    write_mesh(folder / name, FaceMesh{});
    EXPECT_TRUE(read_mesh(folder / name).positions.empty());
  }
}

TEST(MeshFiles, ReadFilesOfOtherPrograms) {
  const TemporaryFolder folder;
  const FaceMesh ply = read_mesh(folder.write(
      "a.ply",
      "ply\r\nformat ascii 1.0\r\ncomment made elsewhere\r\nelement vertex 4\r\nproperty double x\r\n"
      "property double y\r\nproperty double z\r\nproperty uchar red\r\nproperty uchar green\r\n"
      "property uchar blue\r\nproperty float nx\r\nproperty float ny\r\nproperty float nz\r\n"
      "property float quality\r\nelement face 2\r\nproperty list uint8 int32 vertex_indices\r\n"
      "element edge 1\r\nproperty int a\r\nproperty int b\r\nend_header\r\n"
      "0 0 0 255 0 0 0 1 0 0.5\r\n1 0 0 255 0 0 0 1 0 .5\r\n1 0 1 0 0 0 0 1 0 1\r\n0 0 1.5e0 9 9 9 0 1 0 "
      "1\r\n"
      "3 0 1 2\r\n3 0 2 3\r\n0 1\r\n"));
  EXPECT_EQ(ply.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(ply.positions[3], glm::vec3(0, 0, 1.5F));
  const FaceMesh obj = read_mesh(folder.write(
      "a.obj",
      "# made elsewhere\nmtllib none.mtl\no thing\nv 0 0 0 1 0 0\nv 1 0 0\nv 1 0 1\nvt 0 0\nvt 1 0\nvt 1 1\n"
      "vn 0 1 0\nusemtl red\ns off\nf 1/1/1 2/2/1 3/3/1\nv 0 0 1\nvt 0 1 0\nf -4/-4 -2//1 -1/-1\n"));
  EXPECT_EQ(obj.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(obj.texture[3], glm::vec2(0, 1));
  EXPECT_EQ(obj.texture[1], glm::vec2(1, 0));
}

TEST(MeshFiles, RefuseWithTheReason) {
  const TemporaryFolder folder;
  const auto what = [&](const char* name, const std::string& content) {
    return failure_of([&] { read_mesh(folder.write(name, content)); }).what;
  };
  EXPECT_THAT(what("a.stl", "solid"), HasSubstr(".ply or .obj"));
  EXPECT_THAT(what("a.ply", ""), HasSubstr("not a PLY file"));
  EXPECT_THAT(what("a.ply", "ply\nformat ascii 1.0\n"), HasSubstr("no end"));
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  EXPECT_THAT(what("a.ply", head + "0 0 0 1 0 0 0 1"), HasSubstr("ends early"));
  EXPECT_THAT(what("a.ply", head + "0 0 0 1 0 0 0 1 0 3 0 1 9"), HasSubstr("vertex 9 of 3"));
  EXPECT_THAT(what("a.ply", head + "0 0 0 1 0 0 0 1 0 3 0 1 -1"), HasSubstr("vertex -1 of 3"));
  EXPECT_THAT(what("a.ply", head + "0 0 0 1 0 0 0 1 0 3 0 1 1"), HasSubstr("twice"));
  EXPECT_THAT(what("a.ply", head + "0 0 0 1 0 0 0 1 0 2 0 1"), HasSubstr("2 corners"));
  EXPECT_THAT(what("a.ply", head + "0 nan 0 1 0 0 0 1 0 3 0 1 2"), HasSubstr("'nan'"));
  EXPECT_THAT(what("a.ply", head + "0 0 0 1 0 0 0 1 0 99999999999 0 1 2"), HasSubstr("length"));
  EXPECT_THAT(what("a.obj", "v 0 0\n"), HasSubstr("not a finite number"));
  EXPECT_THAT(what("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"), HasSubstr("index '4' of 3"));
  EXPECT_THAT(what("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n"), HasSubstr("index '0'"));
  EXPECT_THAT(what("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n"), HasSubstr("2 corners"));
  EXPECT_THAT(what("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n"), HasSubstr("not an index"));
  EXPECT_THAT(
      what("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 1/2 3/1 4/1\n"),
      HasSubstr("one per vertex"));
  EXPECT_THAT(failure_of([&] { read_mesh(folder / "missing.ply"); }).what, HasSubstr("missing.ply"));
  FaceMesh bad = cube();
  bad.corners[0] = 8;
  EXPECT_THAT(failure_of([&] { write_mesh(folder / "b.ply", bad); }).what, HasSubstr("out of range"));
  EXPECT_FALSE(std::filesystem::exists(folder / "b.ply"));
}

// Every damaged file is refused or read as a mesh whose indices are in range; none stops the program.
TEST(MeshFiles, SurviveDamage) {
  const TemporaryFolder folder;
  std::mt19937 random(7);
  std::size_t refused = 0;
  for (const char* name : {"a.ply", "ascii.ply", "a.obj"}) {
    write_mesh(folder / name, textured(pyramid(5)), name[1] == 's' ? PlyForm::kAscii : PlyForm::kBinary);
    const std::string good = read_file(folder / name);
    for (int round = 0; round < 200; ++round) {
      std::string bytes = good;
      for (std::uint32_t i = 0; i < 1 + random() % 3; ++i) {
        bytes[random() % bytes.size()] =
            static_cast<char>(random() % 3 == 0 ? '0' + random() % 10 : random());
      }
      if (random() % 4 == 0) bytes.resize(random() % bytes.size());
      try {
        const FaceMesh mesh = read_mesh(folder.write(name, bytes));
        for (const std::uint32_t v : mesh.corners) ASSERT_LT(v, mesh.positions.size());
      } catch (const Error&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 200U);
}

}  // namespace
}  // namespace terrabench
