// Chunks of the implicit surface: their borders, their versions, and what edits change.
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <glm/geometric.hpp>

#include "terrain/error.h"
#include "tests/representations/implicit_ground.h"

namespace terrabench::test {
namespace {

class Chunks : public testing::TestWithParam<std::tuple<std::string_view, std::string_view>> {
 protected:
  std::unique_ptr<ImplicitSurface> build(const TerrainSource& source, std::int64_t resolution,
                                         double radius = 0) const {
    return implicit(source, {.resolution = resolution,
                             .kernel = std::get<0>(GetParam()),
                             .extractor = std::get<1>(GetParam()),
                             .radius = radius});
  }
};
INSTANTIATE_TEST_SUITE_P(
    Ways, Chunks, testing::Combine(testing::ValuesIn(kKernelNames), testing::ValuesIn(kExtractorNames)),
    [](const auto& at) {
      return std::string(std::get<0>(at.param)) + "_" + std::string(std::get<1>(at.param));
    });

// Full of ambiguous cells on every border.
TerrainSource crumbs() { return random_cells(8, 75, 24, 70, 2, 55); }

// Every open edge of a chunk inside the terrain is an edge of another chunk, with the same bits in positions
// and normals.
TEST_P(Chunks, MeetBitForBitAndDoNotCrossTheirBorders) {
  const auto built = build(crumbs(), 75, 1);
  ASSERT_EQ(built->chunks(), glm::ivec2(3, 3));
  const Bounds box = built->bounds();
  const float size = built->cell() * static_cast<float>(built->cells());
  for (int detail = 0; detail <= 5; ++detail) {
    std::map<std::pair<Vertex, Vertex>, int> uses;
    for (int c = 0; c < 9; ++c) {
      const glm::vec3 low =
          box.low + glm::vec3(static_cast<float>(c % 3), 0, static_cast<float>(c / 3)) * size;
      const TriangleMesh mesh = built->chunk({c % 3, c / 3}, detail);
      ASSERT_EQ(mesh.positions.size(), mesh.normals.size());
      for (const glm::vec3 p : mesh.positions) {
        ASSERT_TRUE(p.x >= low.x && p.x <= low.x + size && p.z >= low.z && p.z <= low.z + size);
      }
      for (const auto& [a, b] : open_edges(mesh)) {
        const glm::vec3 p = mesh.positions[a], q = mesh.positions[b];
        const bool on_border = (p.x == q.x && (p.x == box.low.x || p.x == box.high.x)) ||
                               (p.z == q.z && (p.z == box.low.z || p.z == box.high.z)) ||
                               (p.y == q.y && p.y == box.low.y);
        if (!on_border) ++uses[std::minmax(vertex_of(mesh, a), vertex_of(mesh, b))];
      }
    }
    for (const auto& [edge, count] : uses) ASSERT_EQ(count % 2, 0) << "detail " << detail;
    if (detail < 3) {
      EXPECT_GT(uses.size(), 20U);
    }
  }
}

// Open edges of a chunk lie on its border, so that neighbours close them.
TEST_P(Chunks, AreOpenOnlyAtTheirBorders) {
  const auto built = build(crumbs(), 75, 1);
  const TriangleMesh mesh = built->chunk({1, 1}, 0);
  const float size = built->cell() * static_cast<float>(built->cells());
  const glm::vec3 low = built->bounds().low + glm::vec3(size, 0, size), high = low + size;
  std::size_t open = 0;
  for (const auto& edge : open_edges(mesh)) {
    ++open;
    const glm::vec3 a = mesh.positions[edge.first], b = mesh.positions[edge.second];
    const bool on_side = (a.x == b.x && (a.x == low.x || a.x == high.x)) ||
                         (a.z == b.z && (a.z == low.z || a.z == high.z)) ||
                         (a.y == b.y && a.y == built->bounds().low.y);
    ASSERT_TRUE(on_side);
  }
  EXPECT_GT(open, 100U);
}

TEST_P(Chunks, AreTheWholeSurface) {
  const auto built = build(caves(), 70);
  double area = 0, walls = 0;
  const auto add = [&](const TriangleMesh& mesh, bool closed) {
    const Bounds box = built->bounds();
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
      const glm::dvec3 a = mesh.positions[mesh.indices[t]], b = mesh.positions[mesh.indices[t + 1]],
                       c = mesh.positions[mesh.indices[t + 2]];
      const double size = glm::length(glm::cross(b - a, c - a)) / 2;
      bool wall = false;
      for (int axis = 0; axis < 3; ++axis) {
        for (const double at : {box.low[axis], box.high[axis]}) {
          wall = wall || (a[axis] == at && b[axis] == at && c[axis] == at);
        }
      }
      (wall ? walls : area) += closed ? size : -size;
    }
  };
  add(built->mesh({}), true);
  const double whole = area;
  for (int j = 0; j < built->chunks().y; ++j) {
    for (int i = 0; i < built->chunks().x; ++i) add(built->chunk({i, j}, 0), false);
  }
  EXPECT_GT(whole, 1);
  EXPECT_GT(walls, 1);
  // Surface nets move vertices near borders onto them.
  EXPECT_NEAR(area, 0, (std::get<1>(GetParam()) == "marching_cubes" ? 1e-6 : 0.02) * whole);
}

TEST_P(Chunks, EditsEqualBuildingAnewAndTouchOnlyWhatTheKernelReaches) {
  const TerrainSource source = random_boxes(3, 128, 40, 2);
  const auto edited = build(source, 128), before = build(source, 128);
  std::mt19937 random(4);
  for (int round = 0; round < 4; ++round) {
    std::vector<std::uint64_t> versions;
    for (int c = 0; c < 16; ++c) versions.push_back(edited->version({c % 4, c / 4}));
    const auto low = glm::ivec3(random() % 112, random() % 112, random() % 112);
    std::vector<float> x, z;
    for (int c = 0; c < 256; ++c) {
      x.push_back(static_cast<float>(low.x + c % 16) + 0.5F);
      z.push_back(static_cast<float>(low.z + c / 16) + 0.5F);
    }
    const auto bottom = static_cast<float>(low.y);
    const std::vector<Span> strokes(256,
                                    Span{bottom, bottom + 16, round % 2 == 0 ? Material::kAir : Material{2}});
    std::vector<TriangleMesh> old;
    for (int c = 0; c < 16; ++c) old.push_back(edited->chunk({c % 4, c / 4}, 1));
    edited->edit({x, z}, strokes);
    before->edit({x, z}, strokes);
    // A structure that was saved and loaded has never seen an edit.
    const auto anew = reloaded("implicit", *before);
    const auto& fresh = dynamic_cast<const ImplicitSurface&>(*anew);
    int touched = 0;
    for (int c = 0; c < 16; ++c) {
      const glm::ivec2 at{c % 4, c / 4};
      EXPECT_TRUE(same_mesh(edited->chunk(at, 0), fresh.chunk(at, 0)));
      const bool grew = edited->version(at) > versions[static_cast<std::size_t>(c)];
      touched += grew ? 1 : 0;
      if (!grew) {
        EXPECT_TRUE(same_mesh(edited->chunk(at, 1), old[static_cast<std::size_t>(c)]));
      }
      // 16 columns, the kernel's 2 and a cell, on both sides.
      const glm::ivec2 from = at * 32, to = from + 32;
      const bool near =
          from.x <= low.x + 16 + 4 && to.x >= low.x - 4 && from.y <= low.z + 16 + 4 && to.y >= low.z - 4;
      EXPECT_LE(grew, near);
    }
    EXPECT_GE(touched, 1);
  }
}

TEST_P(Chunks, OneThreadMakesWhatManyMake) {
  const auto built = build(crumbs(), 75);
  const TriangleMesh many = built->mesh({});
  std::vector<TriangleMesh> chunks(9);
  std::atomic<int> wrong = 0;
  tbb::parallel_for(0, 36, [&](int c) {
    const TriangleMesh mesh = built->chunk({c % 3, c / 3 % 3}, 0);
    if (!same_mesh(mesh, built->chunk({c % 3, c / 3 % 3}, 0))) ++wrong;
  });
  EXPECT_EQ(wrong, 0);
  const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_TRUE(same_mesh(built->mesh({}), many));
}

}  // namespace
}  // namespace terrabench::test
