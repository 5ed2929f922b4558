// Edits of a TIN, against a heightmap that has its surface's heights.
#include <gtest/gtest.h>

#include "representations/edit_tools.h"
#include "terrain/error.h"
#include "tests/representations/ground.h"
#include "tests/representations/tin_ground.h"

namespace terrabench::test {
namespace {

HeightGrid grid_of(const Tin& surface) {
  const LineGrid lines = surface.lines();
  return {lines.width, lines.depth, 0, 0, lines.cell_x, lines.cell_z, surface.bounds()};
}

std::vector<float> sampled(const Tin& surface) {
  const LineGrid lines = surface.lines();
  std::vector<float> heights;
  for (int j = 0; j < lines.depth; ++j) {
    for (int i = 0; i < lines.width; ++i) heights.push_back(surface.height(lines.x(i), lines.z(j)));
  }
  return heights;
}

// Delaunay, as no other triangulation of the same samples is; neighbours, places of data and bytes.
void expect_sound(const Tin& surface, const std::vector<float>& heights) {
  const Delaunay& joined = surface.ground().surface;
  const int width = surface.lines().width, depth = surface.lines().depth;
  ASSERT_EQ(corners(joined), corners(triangulated(width, depth, joined.vertices())));
  ASSERT_EQ(surface.ground().heights.size(), joined.vertices().size());
  for (std::uint32_t t = 0; t < joined.triangles().size(); ++t) {
    const auto [a, b, c] = joined.corners(joined.triangles()[t]);
    ASSERT_GT(tin::twice_area(a, b, c), 0);
    ASSERT_TRUE(tin::before(a, b) && tin::before(a, c)) << "planes of a copy are equal to the bit";
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t beyond = joined.triangles()[t].neighbour[k];
      if (beyond == Delaunay::kNone) continue;
      const auto& back = joined.triangles()[beyond].neighbour;
      ASSERT_EQ(std::ranges::count(back, t), 1);
    }
  }
  const auto copy = reloaded("tin", surface);
  ASSERT_EQ(saved(*copy), saved(surface));
  const std::vector<float> again = sampled(static_cast<const Tin&>(*copy));
  for (std::size_t s = 0; s < heights.size(); ++s) {
    ASSERT_EQ(std::isnan(again[s]), std::isnan(heights[s])) << s;
    if (std::isnan(heights[s])) continue;
    ASSERT_FLOAT_EQ(again[s], heights[s]) << s;
  }
  EXPECT_TRUE(check_edges(surface.mesh({})).watertight());
}

Sphere random_sphere(std::mt19937& random, const Bounds& bounds, float largest) {
  std::uniform_real_distribution<float> unit(0, 1);
  const glm::vec3 at(unit(random), unit(random), unit(random));
  return {bounds.low + at * bounds.size(), (0.1F + unit(random)) * largest};
}

// Compares after each sphere; with `low` near the floor, spheres make holes in the ground and fill them.
void edit_at_random(const Heightfield& field, float max_error, int edits, float largest) {
  const auto surface = build_tin(field, max_error);
  std::mt19937 random(5);
  std::vector<float> before = sampled(*surface);
  std::size_t changed = 0, holes = 0;
  for (int edit = 0; edit < edits; ++edit) {
    const Sphere sphere = random_sphere(random, surface->bounds(), largest);
    const Material material = random() % 2 == 0 ? Material::kAir : Material::kBedrock;
    Heightmap model(grid_of(*surface), before);
    const std::size_t columns = fill_sphere(model, sphere, material);
    EXPECT_EQ(fill_sphere(*surface, sphere, material), columns);
    const std::vector<float> after = sampled(*surface);
    for (std::size_t s = 0; s < after.size(); ++s) {
      const float expected = model.heights()[s];
      ASSERT_EQ(std::isnan(after[s]), std::isnan(expected)) << edit << ' ' << s;
      if (std::isnan(expected)) {
        ++holes;
        continue;
      }
      ASSERT_NEAR(after[s], expected, max_error * 1.0001) << edit << ' ' << s;
    }
    changed += after != before ? 1 : 0;
    before = after;
    if (edit % 50 == 0 || edit == edits - 1) expect_sound(*surface, before);
  }
  EXPECT_GT(changed, static_cast<std::size_t>(edits) / 4);
  EXPECT_GT(holes, 0U);
}

TEST(TinEdit, AThousandSpheresAreThoseOfAHeightmap) { edit_at_random(hills(60, 45), 5, 1000, 100); }
TEST(TinEdit, SoAreThoseOnFineAndOnCoarseSurfaces) {
  edit_at_random(hills(40, 70), 0.1F, 200, 150);
  edit_at_random(hills(40, 70), 60, 200, 150);
}
TEST(TinEdit, SoAreThoseOverVoids) {
  Heightfield field = hills(50, 50);
  std::mt19937 random(3);
  for (float& h : field.heights) {
    if (random() % 9 == 0) h = Heightfield::kNoData;
  }
  for (int j = 15; j < 35; ++j) {
    for (int i = 10; i < 40; ++i) field.at(i, j) = Heightfield::kNoData;
  }
  field.at(0, 0) = field.at(49, 49) = Heightfield::kNoData;
  edit_at_random(field, 8, 300, 120);
}

TEST(TinEdit, FarFromTheSphereNothingChanges) {
  const auto surface = build_tin(hills(200, 200), 5);
  const std::vector<float> before = sampled(*surface);
  const LineGrid lines = surface->lines();
  const Sphere sphere{{lines.x(90), surface->height(lines.x(90), lines.z(110)), lines.z(110)}, 100};
  EXPECT_GT(fill_sphere(*surface, sphere, Material::kAir), 100U);
  const std::vector<float> after = sampled(*surface);
  std::size_t changed = 0;
  for (int j = 0; j < 200; ++j) {
    for (int i = 0; i < 200; ++i) {
      const std::size_t at = static_cast<std::size_t>(j) * 200 + static_cast<std::size_t>(i);
      if (std::max(std::abs(i - 90), std::abs(j - 110)) > 25) {
        ASSERT_EQ(after[at], before[at]) << i << ' ' << j;
      }
      changed += after[at] != before[at] ? 1 : 0;
    }
  }
  EXPECT_GT(changed, 100U);
}

TEST(TinEdit, WhatChangesNoHeightChangesNothing) {
  const auto surface = build_tin(hills(50, 50), 5);
  const std::vector<std::byte> before = saved(*surface);
  const float x = 200, z = 200, ground = surface->height(x, z);
  const Span above{ground + 1, ground + 9, Material::kAir}, below{ground - 9, ground - 1, Material::kBedrock};
  surface->edit({{&x, 1}, {&z, 1}}, {&above, 1});
  surface->edit({{&x, 1}, {&z, 1}}, {&below, 1});
  EXPECT_EQ(saved(*surface), before);
}

TEST(TinEdit, OnAPlaneThePlaneStays) {
  Heightfield field = Heightfield::zeros(150, 100);
  for (int j = 0; j < field.depth; ++j) {
    for (int i = 0; i < field.width; ++i) field.at(i, j) = 0.5F * static_cast<float>(i) + 100;
  }
  const auto surface = build_tin(field, 0.01);
  ASSERT_EQ(surface->triangles(), 2U);
  fill_sphere(*surface, {{70, surface->height(70, 50), 50}, 6}, Material::kAir);
  EXPECT_LT(surface->height(70, 50), field.at(70, 50) - 5);
  for (int j = 0; j < field.depth; ++j) {
    for (int i = 0; i < field.width; ++i) {
      if (std::hypot(i - 70, j - 50) < 7) continue;
      const float height = surface->height(static_cast<float>(i), static_cast<float>(j));
      ASSERT_NEAR(height, field.at(i, j), 0.0101F) << i << ' ' << j;
    }
  }
  EXPECT_LT(surface->triangles(), 600U);
}

TEST(TinEdit, WhereAHoleIsFilledNoVertexIsLeft) {
  const auto surface = build_tin(Heightfield::zeros(60, 50), 0.01);
  const float floor = surface->bounds().low.y;
  for (const Sphere& sphere :
       {Sphere{{30, 0, 20}, 7}, {{20, floor, 20}, 9}, {{0, floor, 0}, 9}, {{59, 0, 20}, 40}}) {
    fill_sphere(*surface, sphere, Material::kAir);
    EXPECT_GT(surface->triangles(), 30U);
    EXPECT_FALSE(surface->height(sphere.centre.x, sphere.centre.z + 1) >= 0);
    fill_sphere(*surface, {sphere.centre, 100}, Material::kBedrock);
    EXPECT_EQ(surface->triangles(), 2U);
    for (const float height : sampled(*surface)) ASSERT_EQ(height, 0);
  }
}

TEST(TinEdit, ACavityIsRefusedAndChangesNothing) {
  const auto surface = build_tin(hills(50, 50), 5);
  const std::vector<std::byte> before = saved(*surface);
  EXPECT_THROW(surface->apply(events::Carving{}), Error);
  const float x = 200, z = 200;
  const Span thin{5, 5, Material::kAir};
  EXPECT_THROW(surface->edit({{&x, 1}, {&z, 1}}, {&thin, 1}), Error);
  EXPECT_EQ(saved(*surface), before);
}

TEST(TinEdit, DiggingAndFillingAThousandTimesPilesUpNothing) {
  const auto surface = build_tin(hills(80, 80), 5);
  const Bounds bounds = surface->bounds();
  const Sphere sphere{{400, 0.5F * (bounds.low.y + bounds.high.y), 800}, 150};
  const auto stir = [&] {
    fill_sphere(*surface, sphere, Material::kAir);
    fill_sphere(*surface, sphere, Material::kBedrock);
  };
  for (int k = 0; k < 10; ++k) stir();
  const std::size_t triangles = surface->triangles(), bytes = surface->memory().total();
  for (int k = 0; k < 490; ++k) stir();
  EXPECT_LE(surface->triangles(), triangles + triangles / 20);
  EXPECT_LE(surface->memory().total(), bytes + bytes / 10);
}

TEST(TinEdit, ALoadedTinIsEditedAsTheOneThatWasSaved) {
  const auto surface = build_tin(hills(70, 60), 4);
  std::mt19937 random(8);
  for (int k = 0; k < 20; ++k) {
    fill_sphere(*surface, random_sphere(random, surface->bounds(), 100), Material::kAir);
  }
  const auto copy = reloaded("tin", *surface);
  for (int k = 0; k < 20; ++k) {
    const Sphere sphere = random_sphere(random, surface->bounds(), 100);
    fill_sphere(*surface, sphere, Material::kBedrock);
    fill_sphere(*copy, sphere, Material::kBedrock);
    ASSERT_EQ(saved(*copy), saved(*surface)) << k;
  }
}

// All corners stay, and all else may go: from a full lattice, too.
TEST(DelaunayRemoval, LeavesTheTriangulationOfTheOthers) {
  constexpr std::uint16_t kSide = 12;
  std::vector<Sample> lattice;
  for (std::uint16_t j = 0; j < kSide; ++j) {
    for (std::uint16_t i = 0; i < kSide; ++i) lattice.push_back({i, j});
  }
  for (unsigned seed = 0; seed < 30; ++seed) {
    std::vector<Sample> samples = seed % 2 == 0 ? lattice : some_samples(kSide, 60, seed);
    std::mt19937 random(seed);
    Delaunay surface = triangulated(kSide, kSide, samples);
    std::vector<Sample> left = surface.vertices();
    std::shuffle(left.begin() + 4, left.end(), random);  // after the corners
    std::vector<std::uint32_t> changed;
    while (left.size() > 4) {
      for (std::size_t n = std::min<std::size_t>(left.size() - 4, 1 + random() % 9); n > 0; --n) {
        const std::uint32_t t = surface.locate(left.back(), changed.empty() ? 0 : changed.back());
        surface.remove(surface.vertex_at(left.back(), t), t, changed);
        left.pop_back();
      }
      surface.compact_triangles();
      changed.clear();
      surface.compact_vertices([&](Sample s) { return surface.locate(s, 0); });
      ASSERT_EQ(surface.vertices().size(), left.size());
      ASSERT_EQ(corners(surface), corners(triangulated(kSide, kSide, left))) << seed;
    }
  }
}

}  // namespace
}  // namespace terrabench::test
