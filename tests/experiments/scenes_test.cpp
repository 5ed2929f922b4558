// The grounds on which representations are compared, and tuning types on the smallest of them.
#include "experiments/cross/scenes.h"

#include <gtest/gtest.h>

#include "experiments/cross/fitting.h"
#include "terrain/source.h"

namespace terrabench::cross {
namespace {

TEST(Scenes, KnowEverySolidOfTheCatalogueByName) {
  for (const TerrainType& type : terrains()) {
    EXPECT_EQ(is_solid(std::string(type.name)), open_terrain(type.name).solid.has_value()) << type.name;
  }
}

TEST(Fitting, TakesGroundOfFewerSamplesThanTheCoarsestSettingHasColumns) {
  Progress silent;
  const Scene& tiny = scene({.terrain = "fractal", .size = 3}, silent);
  for (const RepresentationType& type : representations()) {
    Fitting for_bytes(tiny, type, silent), for_error(tiny, type, silent);
    const auto fitted = for_bytes.for_bytes(1e6);
    if (fitted) {
      EXPECT_LE(fitted->trial.file_bytes, 1e6) << type.name;
    }
    const auto exact = for_error.for_error(1e3);
    if (exact) {
      EXPECT_LE(exact->trial.rmse, 1e3) << type.name;
    }
    EXPECT_EQ(fitted.has_value(), !for_bytes.trials().empty()) << type.name;
  }
}

}  // namespace
}  // namespace terrabench::cross
