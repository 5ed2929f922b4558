// The grounds on which representations are compared, and tuning types on the smallest of them.
#include "experiments/cross/representations/scenes.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "experiments/cross/representations/setting_search.h"
#include "terrain/events/event_file.h"
#include "terrain/source.h"

namespace terrabench::cross {
namespace {

TEST(Scenes, KnowEverySolidOfTheCatalogueByName) {
  for (const TerrainType& type : terrains()) {
    EXPECT_EQ(is_solid(std::string(type.name)), open_terrain(type.name).solid.has_value()) << type.name;
  }
}

TEST(Scenes, KnowAScriptThatDigsForASolid) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "scenes_script.toml";
  const auto write = [&](const events::Script& script) { std::ofstream(file) << events::to_text(script); };
  write({"diamond-square", 1, 33, {}, {}});
  EXPECT_FALSE(is_solid(file));
  EXPECT_TRUE(open_terrain(file.string()).heights);
  write({"diamond-square", 1, 33, {events::RadialErosion{glm::dvec3(0), glm::dvec3(1)}}, {}});
  EXPECT_TRUE(is_solid(file));
  std::filesystem::remove(file);
}

TEST(Scenes, MaineIsTheMiddleOfTheTile) {
  Progress silent;
  const TerrainSource part = scene({.terrain = "maine"}, silent).source, tile = open_terrain("maine");
  ASSERT_EQ(part.heights->width, 513);
  ASSERT_EQ(part.heights->depth, 513);
  EXPECT_EQ(part.heights->at(0, 0), tile.heights->at(344, 344));
  EXPECT_EQ(part.heights->at(512, 512), tile.heights->at(856, 856));
}

TEST(SettingSearch, TakesGroundOfFewerSamplesThanTheCoarsestSettingHasColumns) {
  Progress silent;
  const Scene& tiny = scene({.terrain = "fractal", .size = 3}, silent);
  for (const RepresentationType& type : representations()) {
    SettingSearch search(tiny, type, silent);
    if (const auto chosen = search.for_error(1e3)) {
      EXPECT_LE(chosen->trial.error, 1e3) << type.name;
    }
  }
}

}  // namespace
}  // namespace terrabench::cross
