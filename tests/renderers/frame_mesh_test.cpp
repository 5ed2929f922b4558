// Meshes of a frame: drawn beside the heights, uploaded once per id, and freed when no longer listed.
#include <gtest/gtest.h>

#include "lod/lod.h"
#include "renderers/frame_renderer.h"
#include "tests/renderers/ground.h"
#include "tests/terrain/ground.h"

namespace terrabench {
namespace {

class FrameMeshes : public ::testing::Test {
 protected:
  FrameMeshes() {
    method_ = lod("brute_force").build(field_, {}, silent_);
    view_.eye = {20, 60, 20.001F};
    view_.target = {20, 0, 20};
    view_.up = {0, 0, -1};
    view_.width = view_.height = 60;
    view_.far = 200;
    frame_ = method_->update(view_);
  }
  FrameMesh mesh(std::uint64_t id, const TriangleMesh& of) const {
    return {id, of.positions, of.normals, of.indices};
  }
  // The numbers of the triangles at the picture's middle and near its corner.
  std::pair<std::uint32_t, std::uint32_t> seen(FrameRenderer& renderer) const {
    const auto numbers = renderer.triangle_numbers(frame_, view_);
    return {numbers[30 * 60 + 30], numbers[3 * 60 + 3]};
  }

  Heightfield field_ = test::flat(41, 41);
  Progress silent_;
  std::unique_ptr<Lod> method_;
  View view_;
  Frame frame_;
  std::unique_ptr<GlContext> context_ = open_context("osmesa", 16, 16);
  // A square of 4 × 4 cells around the middle of the ground, 5 m above it.
  TriangleMesh table_ = [] {
    TriangleMesh mesh = testing::ground(4, 16, [](float, float) { return 5.0F; });
    for (glm::vec3& p : mesh.positions) p += glm::vec3(12, 0, 12);
    return mesh;
  }();
};

TEST_F(FrameMeshes, HideTheGroundBelowThem) {
  FrameRenderer renderer(*context_);
  const std::uint32_t ground = 2 * 40 * 40;
  const auto bare = seen(renderer);
  EXPECT_LE(bare.first, ground);
  const FrameMesh meshes[] = {mesh(7, table_)};
  frame_.meshes = meshes;
  const auto covered = seen(renderer);
  EXPECT_GT(covered.first, ground);
  EXPECT_LE(covered.first, ground + 32);
  EXPECT_EQ(covered.second, bare.second);
  frame_.meshes = {};
  EXPECT_EQ(seen(renderer), bare);
}

// Numbered after the batches, in the frame's order.
TEST_F(FrameMeshes, AreNumberedInOrder) {
  TriangleMesh higher = table_;
  for (glm::vec3& p : higher.positions) p.y += 5;
  FrameRenderer renderer(*context_);
  const FrameMesh meshes[] = {mesh(7, table_), mesh(8, higher)};
  frame_.meshes = meshes;
  const std::uint32_t ground = 2 * 40 * 40;
  EXPECT_GT(seen(renderer).first, ground + 32);
  const FrameMesh swapped[] = {mesh(8, higher), mesh(7, table_)};
  frame_.meshes = swapped;
  EXPECT_LE(seen(renderer).first, ground + 32);
}

TEST_F(FrameMeshes, AreUploadedOncePerId) {
  FrameRenderer renderer(*context_);
  const std::size_t bytes = table_.positions.size() * 24 + table_.indices.size() * 4;
  const auto sent = [&](std::initializer_list<FrameMesh> listed) {
    const std::vector<FrameMesh> meshes(listed);
    frame_.meshes = meshes;
    frame_.uploads = {};
    const std::size_t before = renderer.bytes_uploaded();
    renderer.draw(frame_, view_, {});
    return renderer.bytes_uploaded() - before;
  };
  sent({});  // the heights
  const std::size_t commands = sent({});
  EXPECT_EQ(sent({mesh(1, table_)}) - commands, bytes);
  EXPECT_EQ(sent({mesh(1, table_)}) - commands, 0U);
  EXPECT_EQ(sent({mesh(1, table_), mesh(2, table_)}) - commands, bytes);
  EXPECT_EQ(sent({mesh(2, table_)}) - commands, 0U);
  EXPECT_EQ(sent({mesh(1, table_)}) - commands, bytes);  // freed before
}

TEST_F(FrameMeshes, HaveWiresToo) {
  FrameRenderer renderer(*context_);
  const FrameMesh meshes[] = {mesh(7, table_)};
  frame_.meshes = meshes;
  renderer.draw(frame_, view_, {});
  const Image plain = renderer.image();
  FrameStyle wires;
  wires.wire_width = 1;
  renderer.draw(frame_, view_, wires);
  const Image wired = renderer.image();
  int darker = 0;
  for (int x = 22; x < 38; ++x) darker += wired.pixel(x, 30)[1] + 20 < plain.pixel(x, 30)[1] ? 1 : 0;
  EXPECT_GT(darker, 0);
}

}  // namespace
}  // namespace terrabench
