#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "terrain/source.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/raster_file.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

TEST(Catalogue, JacksboroIsTheKnownMountain) {
  const TerrainSource source = open_terrain("jacksboro");
  ASSERT_TRUE(source.heights);
  EXPECT_FALSE(source.solid);
  const Heightfield& field = *source.heights;
  EXPECT_EQ(field.width, 403);
  EXPECT_EQ(field.depth, 344);
  const HeightRange range = height_range(field);
  EXPECT_EQ(range.lowest, 236);
  EXPECT_EQ(range.highest, 1076);
  EXPECT_EQ(range.no_data, 0U);
  EXPECT_NEAR(field.cell_x, 74.57, 0.01);
  EXPECT_NEAR(field.cell_z, 92.47, 0.01);
  EXPECT_EQ(source.name, "jacksboro");
  EXPECT_EQ(source.checksum, checksum(field));
  EXPECT_THAT(source.notes, Contains(HasSubstr("cells of 3″")));
  EXPECT_LT(source.bounds().low.y, 236);
  EXPECT_EQ(source.bounds().high.y, 1076);
}

TEST(Catalogue, TopobathyHasSeaAndLandNorthFirst) {
  const TerrainSource source = open_terrain("topobathy");
  ASSERT_TRUE(source.heights);
  const Heightfield& field = *source.heights;
  EXPECT_EQ(field.width, 120);
  EXPECT_EQ(field.depth, 91);
  const HeightRange range = height_range(field);
  EXPECT_EQ(range.lowest, -1437);
  EXPECT_EQ(range.highest, 2205);
  // The south-west corner is open Pacific, the north-east the Coast Mountains.
  EXPECT_LT(field.at(0, 90), -1000);
  EXPECT_GT(field.at(119, 0), 0);
  EXPECT_LT(field.georeference.transform[5], 0);
  // A Mercator grid: cells are nearly square on the ground.
  EXPECT_NEAR(field.cell_x / field.cell_z, 1, 0.01);
}

// Compiled in: read without a path to the sources.
TEST(Catalogue, MountStHelensIsItsDemOf1980) {
  const TerrainSource source = open_terrain("helens");
  ASSERT_TRUE(source.heights);
  const Heightfield& field = *source.heights;
  EXPECT_EQ(field.width, 317);
  EXPECT_EQ(field.depth, 460);
  EXPECT_EQ(field.cell_x, 30);
  EXPECT_EQ(field.cell_z, 30);
  const HeightRange range = height_range(field);
  EXPECT_EQ(range.lowest, 694);
  EXPECT_EQ(range.highest, 2543);
  EXPECT_EQ(range.no_data, 0U);
  EXPECT_THAT(field.georeference.crs, HasSubstr("UTM zone 10N"));
  EXPECT_EQ(source.checksum, "11aa3118666a8ea5969443d26c75b5e9");
  EXPECT_EQ(open_terrain("helens").checksum, source.checksum);
}

TEST(Catalogue, MaineIsAWholeTile) {
  const TerrainSource source = open_terrain("maine");
  ASSERT_TRUE(source.heights);
  const Heightfield& field = *source.heights;
  EXPECT_EQ(field.width, 1201);
  EXPECT_EQ(field.depth, 1201);
  const HeightRange range = height_range(field);
  EXPECT_EQ(range.lowest, -34);
  EXPECT_EQ(range.highest, 463);
  EXPECT_EQ(range.no_data, 0U);
  EXPECT_NEAR(field.cell_x, 66.28, 0.05);
  EXPECT_NEAR(field.cell_z, 92.6, 0.05);
  EXPECT_THAT(source.notes, Contains(HasSubstr("cells of 3″")));
  EXPECT_EQ(source.checksum, "ebc438b2ee84c1972fe324c349261da4");
}

TEST(Catalogue, EveryLineIsCompleteAndUnique) {
  std::set<std::string_view> names;
  for (const TerrainType& type : terrains()) {
    EXPECT_TRUE(names.insert(type.name).second) << type.name;
    EXPECT_FALSE(type.summary.empty());
    EXPECT_FALSE(type.origin.empty());
    EXPECT_NE(type.open, nullptr);
  }
}

TEST(Catalogue, TerrainsOfEventsHaveTheirEventsAndRepeat) {
  for (const char* const name : {"canyon", "two-tunnels"}) {
    const TerrainSource source = open_terrain(name);
    ASSERT_TRUE(source.solid) << name;
    ASSERT_TRUE(source.events) << name;
    EXPECT_EQ(source.name, name);
    EXPECT_EQ(open_terrain(name, 5).checksum, source.checksum) << name;
  }
}

TEST(Catalogue, TheGeneratedGroundsAreGroundAndFollowTheSeed) {
  for (const char* const name : {"diamond-square", "faults", "planet-faults", "hills"}) {
    const TerrainSource source = open_terrain(name, 3);
    ASSERT_TRUE(source.heights) << name;
    EXPECT_EQ(source.name, name);
    EXPECT_EQ(source.checksum, checksum(*source.heights));
    const HeightRange range = height_range(*source.heights);
    EXPECT_EQ(range.no_data, 0U);
    EXPECT_GT(range.highest - range.lowest, 300) << name;
    EXPECT_LT(range.highest - range.lowest, 9000) << name;
    EXPECT_EQ(open_terrain(name, 3).checksum, source.checksum);
    EXPECT_NE(open_terrain(name, 4).checksum, source.checksum);
  }
}

TEST(Catalogue, APathIsATerrainToo) {
  const TemporaryFolder folder;
  RasterFile().write(folder / "hill.tif");
  const TerrainSource source = open_terrain(folder / "hill.tif");
  EXPECT_EQ(source.name, folder / "hill.tif");
  EXPECT_EQ(source.heights->width, 6);
}

TEST(Catalogue, ATypingSlipGetsTheNearestName) {
  const Failure failure = failure_of([] { (void)open_terrain("jaksboro"); });
  EXPECT_EQ(failure.code, ExitCode::kUsage);
  EXPECT_THAT(failure.what, HasSubstr("unknown terrain 'jaksboro'; did you mean 'jacksboro'?"));
  EXPECT_THAT(failure.advice, HasSubstr("topobathy"));
  EXPECT_THAT(failure.advice, HasSubstr("path"));
  EXPECT_THAT(failure_of([] { (void)open_terrain("helen"); }).what, HasSubstr("did you mean 'helens'?"));
  EXPECT_THAT(failure_of([] { (void)open_terrain("helens-mosiac"); }).what,
              HasSubstr("did you mean 'helens-mosaic'?"));
  EXPECT_THAT(failure_of([] { (void)open_terrain("himalaya"); }).what, Not(HasSubstr("did you mean")));
}

TEST(Catalogue, WhatLooksLikeAPathIsAMissingFile) {
  for (const char* const path : {"./foo.tif", "foo.tif", "dems/foo"}) {
    const Failure failure = failure_of([&] { (void)open_terrain(path); });
    EXPECT_EQ(failure.code, ExitCode::kBadInput) << path;
    EXPECT_THAT(failure.what, HasSubstr("no such file")) << path;
  }
}

}  // namespace
}  // namespace terrabench
