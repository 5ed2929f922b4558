#include <gtest/gtest.h>

#include <algorithm>

#include "experiments/meshgrow/forest_scene.h"
#include "renderers/raytrace/raytraced_picture.h"
#include "terrain/error.h"

namespace terrabench::meshgrow {
namespace {

View small_view(const Forest& forest) {
  View view;
  view.eye = {0.5F * forest.side(), forest.height(0.5F * forest.side(), forest.side()) + 15,
              forest.side() + 60};
  view.target = {0.5F * forest.side(), view.eye.y - 7, 0.5F * forest.side()};
  view.vertical_fov = 0.4F;
  view.width = 32;
  view.height = 24;
  view.far = 1000;
  return view;
}

TEST(LazyForest, ACacheForOnePartAtATimeGivesTheSamePicture) {
  const Forest forest({.instances = 7, .all_leaves = false});
  const View view = small_view(forest);
  const std::vector<std::uint8_t> levels = forest.plants().choose_levels(view, {.spacing = 2});
  const HeapScope heap;
  LazyForest large(forest, levels, std::size_t{1} << 30);
  const CoherentPicture picture = trace_coherent(large.parts(), view, {.samples = 2, .bounces = 1});
  const growing::Expanded all = large.expanded();
  EXPECT_EQ(all.cache.evictions, 0U);
  EXPECT_EQ(all.cache.misses, all.parts);
  EXPECT_EQ(all.again, 0U);
  EXPECT_EQ(all.outside, 0U);
  EXPECT_GT(all.parts, 2U);
  EXPECT_LE(all.faces, large.faces_chosen());
  EXPECT_LT(all.faces, forest.plants().total_faces());
  // The allocator holds what memory() says, and the picture.
  const double held = static_cast<double>(heap.held()) - 16.0 * static_cast<double>(picture.radiance.size());
  EXPECT_NEAR(static_cast<double>(large.memory().total()), held, 0.02 * held);

  // The largest part alone, as a cache for everything would hold it.
  std::size_t largest = 0;
  for (std::uint32_t i = 0; i < levels.size(); ++i) {
    large.parts().open(i, [&](const RayPart& part) { largest = std::max(largest, part.bytes()); });
  }
  // Embree's bytes for a part may differ a little from one time to the next.
  LazyForest small(forest, levels, largest + largest / 50);
  const CoherentPicture again = trace_coherent(small.parts(), view, {.samples = 2, .bounces = 1});
  EXPECT_EQ(picture.radiance, again.radiance);
  EXPECT_GT(small.expanded().cache.evictions, 0U);
  EXPECT_LE(small.expanded().cache.peak_bytes, largest + largest / 50);
  EXPECT_EQ(small.expanded().parts, all.parts);
  EXPECT_EQ(small.expanded().faces, all.faces);

  LazyForest none(forest, levels, 1000);
  EXPECT_THROW(trace_coherent(none.parts(), view, {.samples = 1, .bounces = 0}), Error);
}

TEST(LazyForest, ZeroInstancesShowTheGround) {
  const Forest forest({.instances = 0});
  EXPECT_EQ(forest.plants().total_faces(), 0U);
  LazyForest lazy(forest, {}, 1 << 20);
  View view = small_view(forest);  // without plants the ground is a metre wide
  view.target = {0.5F, forest.height(0.5F, 0.5F), 0.5F};
  view.eye = view.target + glm::vec3(0, 1, 2);
  const CoherentPicture picture = trace_coherent(lazy.parts(), view, {.samples = 1, .bounces = 0});
  EXPECT_GT(std::count(picture.objects.begin(), picture.objects.end(), 1U), 0);
  EXPECT_EQ(lazy.expanded().parts, 0U);
  EXPECT_THROW(Forest({.instances = 1'000'000'000}), Error);
}

// Each level with fewer leaves covers as much of a picture as the level with all of them, unsmoothed.
TEST(ForestPlants, KeepTheirCoverWithFewerLeaves) {
  const Forest forest({.instances = 16});
  const growing::PlantedScene& plants = forest.plants();
  std::vector<bool> seen(plants.models().size());
  for (std::uint32_t i = 0; i < plants.instances().size(); ++i) {
    const std::uint32_t model = plants.instances()[i].model;
    if (seen[model]) continue;
    seen[model] = true;
    auto covered = [&, view = View{}](std::size_t level) mutable {
      const ModelMesh mesh = triangles_of(plants.mesh(i, level).mesh);
      if (view.target.y == 0) view = overview(bounds_of(mesh.mesh), 96, 96, {0, 0.3F, 1});
      RayScene scene;
      scene.add_placed({.mesh = &mesh.mesh});
      RaytracedPicture picture(scene, view, {.samples = 1, .bounces = 0});
      picture.accumulate();
      double count = 0;
      for (int pixel = 0; pixel < 96 * 96; ++pixel)
        count += picture.object(pixel % 96, pixel / 96) != 0 ? 1 : 0;
      return count;
    };
    const auto& growth = plants.models()[model].growth;
    const std::size_t last = static_cast<std::size_t>(std::ranges::count(growth, 0U)) - 1;
    const double whole = covered(last);
    for (std::size_t level = last + 1; level < growth.size(); ++level) {
      EXPECT_NEAR(covered(level), whole, 0.1 * whole) << plants.models()[model].name << ", level " << level;
    }
  }
}

}  // namespace
}  // namespace terrabench::meshgrow
