// Rays on grounded heightmap trees against every triangle of their meshes, and between points that columns
// know to be solid and air.
#include "representations/ght/ght_rays.h"

#include <tbb/global_control.h>

#include "tests/representations/ght_ground.h"
#include "tests/representations/rays.h"
#include "tests/terrain/events_ground.h"

namespace terrabench::test {
namespace {

using namespace events;

// A tunnel through a ridge, and a cave beside it.
Ght carved_ridge() {
  Ght ght = make_ght(ridge());
  ght.apply(square_tunnel({20, 15, 32}, {44, 15, 32}));
  Carving cave = square_tunnel({20, 15, 46}, {34, 16, 46});
  cave.cave = true;
  cave.roughness = 0.2;
  ght.apply(cave);
  return ght;
}

// Each kind of geotectonic event, some over one another. The ground has coordinates that floats round.
Ght faulted(unsigned seed) {
  constexpr float kCell = 7.3F;
  Ght ght = make_ght(rolling(70, 64, kCell, 0.3F, seed));
  const auto at = [](double x, double z) { return glm::dvec2(x, z) * double{kCell}; };
  ght.apply(DipFault{true, at(12, 14), at(50, 20), 9 * kCell, 3 * kCell, 60});
  ght.apply(DipFault{false, at(20, 44), at(50, 40), 7 * kCell, 2 * kCell, 70});
  ght.apply(RadialErosion{{30 * kCell, 22 * kCell, 30 * kCell}, glm::dvec3(5, 7, 4) * double{kCell}});
  ght.apply(LinearErosion{at(8, 50), at(40, 52), 2 * kCell, 35});
  ght.apply(LateralFault{at(56, 20), at(60, 50), 5 * kCell, 4 * kCell});
  return ght;
}

// From places in a box in all directions.
std::vector<Ray> rays_within(const Bounds& box, int count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0, 1);
  std::normal_distribution<float> normal;
  std::vector<Ray> rays;
  for (int r = 0; r < count; ++r) {
    rays.push_back({box.low + glm::vec3(unit(random), unit(random), unit(random)) * box.size(),
                    {normal(random), normal(random), normal(random)}});
  }
  return rays;
}

TEST(GhtRays, GroundWithoutEventsIsItsHeightmap) {
  expect_hits(make_ght(rolling(40, 33, 2.5F)), make_ght(rolling(40, 33, 2.5F)).mesh({}), 21);
  Heightfield holed = rolling(30, 41);
  std::mt19937 random(4);
  for (float& h : holed.heights) h = random() % 20 == 0 ? Heightfield::kNoData : h;
  const Ght ght = make_ght(holed);
  expect_hits(ght, ght.mesh({}), 22);
}

TEST(GhtRays, EventsAreTheTrianglesOfTheMesh) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Ght ght = faulted(seed);
    ASSERT_GT(ght.model().surface.faces(), 1000U);
    expect_hits(ght, ght.mesh({}), 23 + seed);
  }
}

TEST(GhtRays, TunnelsAndCavesAreHitFromOutsideAndFromWithin) {
  const Ght ght = carved_ridge();
  const TriangleMesh mesh = ght.mesh({});
  expect_hits(ght, mesh, 31);
  // Around and in the tunnel and the cave: starts in solid ground and in the air under it.
  const std::vector<Ray> rays = rays_within({{18, 11, 28}, {46, 19, 50}}, 1500);
  const std::vector<float> distances = cast(ght, rays);
  SpanSink sink;
  std::size_t under = 0;
  for (std::size_t r = 0; r < rays.size(); ++r) {
    expect_hit(distances[r], brute_force(mesh, rays[r]), r);
    sink.clear();
    ght.spans({std::span(&rays[r].origin.x, 1), std::span(&rays[r].origin.z, 1)}, sink);
    const auto column = sink.column(0);
    under += column.size() == 2 && rays[r].origin.y > column[0].top && rays[r].origin.y < column[1].bottom;
  }
  EXPECT_GT(under, 50U);
}

// Between any solid point and any point in the air there is a surface. Points lie on samples and on the lines
// between them, so that the way there passes along edges and through corners.
TEST(GhtRays, NoneSlipsBetweenSolidAndAir) {
  for (const Ght& ght : {carved_ridge(), faulted(4)}) {
    const ght::SampleGrid& grid = ght.model().tree.grid();
    const float inside = 0.05F * grid.spacing();
    std::vector<glm::vec3> solid, air;
    SpanSink sink;
    for (int j = 0; j < grid.depth; ++j) {
      for (int i = 0; i < grid.width; ++i) {
        const float x = grid.x(i), z = grid.z(j);
        sink.clear();
        ght.spans({std::span(&x, 1), std::span(&z, 1)}, sink);
        const auto column = sink.column(0);
        for (std::size_t k = 0; k < column.size(); ++k) {
          if (column[k].top - column[k].bottom > 2 * inside) solid.push_back({x, column[k].top - inside, z});
          if (k > 0 && column[k].bottom - column[k - 1].top > 2 * inside) {
            air.push_back({x, column[k].bottom - inside, z});
          }
        }
        air.push_back({x, column.back().top + inside, z});
      }
    }
    std::mt19937 random(6);
    std::vector<Ray> rays;
    for (int r = 0; r < 100000; ++r) {
      const glm::vec3 from = solid[random() % solid.size()], to = air[random() % air.size()];
      rays.push_back(r % 2 == 0 ? Ray{from, to - from, 0, 1} : Ray{to, from - to, 0, 1});
      // Near by, in the same row of samples: along the edges of squares.
      const std::size_t a = random() % solid.size();
      const auto near = std::find_if(air.begin(), air.end(), [&](const glm::vec3& p) {
        return p.z == solid[a].z && std::abs(p.x - solid[a].x) < 4 * grid.spacing() && p != solid[a];
      });
      if (r % 20 == 0 && near != air.end()) rays.push_back({solid[a], *near - solid[a], 0, 1});
    }
    const std::vector<float> distances = cast(ght, rays);
    std::size_t slipped = 0;
    for (const float distance : distances) slipped += !std::isfinite(distance);
    EXPECT_EQ(slipped, 0U);
  }
}

TEST(GhtRays, ThreadsChangeNothing) {
  const Ght ght = faulted(5);
  const std::vector<Ray> rays = random_rays(ght.bounds(), 18, 20000);
  const std::vector<float> many = cast(ght, rays);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(many, cast(ght, rays));
}

}  // namespace
}  // namespace terrabench::test
