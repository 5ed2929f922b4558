// `terrabench represent`: the flow rasters as another program reads them, and what it says of drills.
#include <gdal_priv.h>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "terrain/hydrology/flow.h"
#include "terrain/source.h"
#include "terrain/sources/dem/dem.h"
#include "tests/experiments/command_line.h"

namespace terrabench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// A raster through GDAL alone.
struct Raster {
  int width = 0, depth = 0;
  std::vector<float> values;
  std::array<double, 6> transform{};
  std::string crs, unit;

  explicit Raster(const std::filesystem::path& path) {
    GDALAllRegister();
    const std::unique_ptr<GDALDataset> dataset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER));
    if (dataset == nullptr) return;
    width = dataset->GetRasterXSize();
    depth = dataset->GetRasterYSize();
    dataset->GetGeoTransform(transform.data());
    char* wkt = nullptr;
    if (dataset->GetSpatialRef() != nullptr) dataset->GetSpatialRef()->exportToWkt(&wkt);
    if (wkt != nullptr) crs = wkt;
    CPLFree(wkt);
    unit = dataset->GetRasterBand(1)->GetUnitType();
    values.resize(static_cast<std::size_t>(width) * depth);
    if (dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, width, depth, values.data(), width, depth,
                                            GDT_Float32, 0, 0, nullptr) != CE_None) {
      values.clear();
    }
  }
  float at(int i, int j) const { return values[static_cast<std::size_t>(j) * width + i]; }
};

class Represent : public CommandLine {};

// The directions as GIS tools read them, told apart from the program's own tables.
const std::map<int, std::pair<int, int>> kDirections{{1, {1, 0}},   {2, {1, 1}},   {4, {0, 1}},
                                                     {8, {-1, 1}},  {16, {-1, 0}}, {32, {-1, -1}},
                                                     {64, {0, -1}}, {128, {1, -1}}};

// Every pixel's flow is one more than that of the pixels that say they drain into it; outlets hold it all.
void expect_flow(const Raster& flow, const Raster& direction) {
  std::vector<double> arriving(flow.values.size(), 1);
  double leaving = 0, pixels = 0;
  for (int j = 0; j < flow.depth; ++j) {
    for (int i = 0; i < flow.width; ++i) {
      if (std::isnan(flow.at(i, j))) continue;
      ++pixels;
      if (direction.at(i, j) == 0) {
        leaving += flow.at(i, j);
        continue;
      }
      const auto step = kDirections.find(static_cast<int>(direction.at(i, j)));
      ASSERT_NE(step, kDirections.end()) << i << " " << j;
      const int x = i + step->second.first, z = j + step->second.second;
      ASSERT_TRUE(x >= 0 && z >= 0 && x < flow.width && z < flow.depth) << i << " " << j;
      arriving[static_cast<std::size_t>(z) * flow.width + x] += flow.at(i, j);
    }
  }
  EXPECT_EQ(leaving, pixels);
  for (std::size_t p = 0; p < arriving.size(); ++p) {
    if (!std::isnan(flow.values[p])) {
      ASSERT_EQ(flow.values[p], arriving[p]) << p;
    }
  }
}

TEST_F(Represent, WritesTheFlowThatItRoutesWhereTheTerrainLies) {
  const Outcome outcome = call("$T represent jacksboro --as drill --crop 20 30 120 90 --write-flow flow.tif");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  const Heightfield ground = crop(*open_terrain("jacksboro").heights, 20, 30, 120, 90);
  const FlowNetwork network = route_flow(ground);
  const Raster flow(folder_ / "flow.tif"), direction(folder_ / "flow-direction.tif");
  for (const Raster* const raster : {&flow, &direction}) {
    ASSERT_EQ(raster->width, 120);
    ASSERT_EQ(raster->depth, 90);
    ASSERT_EQ(raster->values.size(), network.size());
    EXPECT_EQ(raster->transform, ground.georeference.transform);
    EXPECT_NEAR(raster->transform[0], -84.41375 + 20 / 1200.0, 1e-9);
    EXPECT_NEAR(raster->transform[3], 36.732916666666668 - 30 / 1200.0, 1e-9);
    EXPECT_THAT(raster->crs, HasSubstr("4326"));
    EXPECT_EQ(raster->unit, "");
  }
  for (std::size_t p = 0; p < network.size(); ++p) {
    ASSERT_EQ(flow.values[p], static_cast<float>(network.accumulation[p])) << p;
    const int code = network.flows(p) ? 1 << network.direction[p] : 0;
    ASSERT_EQ(direction.values[p], static_cast<float>(code)) << p;
  }
  expect_flow(flow, direction);
  EXPECT_EQ(temporary_files(), 0U);
}

TEST_F(Represent, FlowHasNoDataWhereTheTerrainHasNone) {
  Heightfield ground = crop(*open_terrain("jacksboro").heights, 0, 0, 60, 50);
  for (int j = 20; j < 30; ++j) {
    for (int i = 25; i < 40; ++i) ground.at(i, j) = Heightfield::kNoData;
  }
  write_geotiff(folder_ / "holes.tif", ground);
  const Outcome outcome = call("$T represent holes.tif --as drill --write-flow out/flow.tif");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  const Raster flow(folder_ / "out/flow.tif"), direction(folder_ / "out/flow-direction.tif");
  ASSERT_EQ(flow.values.size(), ground.heights.size());
  ASSERT_EQ(direction.values.size(), ground.heights.size());
  for (std::size_t p = 0; p < flow.values.size(); ++p) {
    ASSERT_EQ(std::isnan(flow.values[p]), Heightfield::is_no_data(ground.heights[p])) << p;
    ASSERT_EQ(std::isnan(direction.values[p]), Heightfield::is_no_data(ground.heights[p])) << p;
  }
  expect_flow(flow, direction);
}

TEST_F(Represent, RefusesToRouteFlowOverASolidBeforeItBuilds) {
  const Outcome outcome = call("$T represent caves --as drill --save d.tb --write-flow flow.tif");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.text, HasSubstr("--write-flow"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "d.tb"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "flow.tif"));
}

TEST_F(Represent, SaysThatThereAreNoChannels) {
  const Outcome plateau = call("$T represent jacksboro --as drill --set tau=200000 --save d.tb");
  EXPECT_EQ(plateau.code, 0) << plateau.text;
  EXPECT_THAT(plateau.text, HasSubstr("warning     no channels"));
  EXPECT_THAT(plateau.text, HasSubstr("tau = 200000"));
  EXPECT_EQ(call("$T info d.tb").code, 0);
  EXPECT_THAT(call("$T represent jacksboro --as drill").text, Not(HasSubstr("warning")));
}

TEST_F(Represent, KeepsABudgetOrSaysThatItCannot) {
  const std::string drill = "$T represent jacksboro --as drill --crop 0 0 120 120 ";
  const Outcome kept = call(drill + "--budget-bytes 2000 --save d.tb");
  EXPECT_EQ(kept.code, 0) << kept.text;
  EXPECT_THAT(kept.text, Not(HasSubstr("warning")));
  // The saved file has a header of its own beside the drills.
  EXPECT_LT(std::filesystem::file_size(folder_ / "d.tb"), 2200U);
  EXPECT_THAT(call(drill + "--budget-bytes 3").text, HasSubstr("no drills within the budget"));
  EXPECT_THAT(call(drill + "--max-rmse 40").text, Not(HasSubstr("warning")));
  EXPECT_THAT(call(drill + "--max-rmse 0.001").text, HasSubstr("no drills within the budget"));
  for (const char* const wrong : {"--budget-bytes 0", "--budget-bytes -5", "--budget-bytes many",
                                  "--max-rmse 0", "--max-rmse 1 --budget-bytes 9"}) {
    EXPECT_EQ(call(drill + wrong).code, 2) << wrong;
  }
  EXPECT_EQ(call("$T represent jacksboro --as heightmap --budget-bytes 9").code, 2);
}

}  // namespace
}  // namespace terrabench
