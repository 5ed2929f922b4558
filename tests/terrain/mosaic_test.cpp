#include "terrain/sources/mosaic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "terrain/source.h"

namespace terrabench {
namespace {

TEST(Mosaic, EverySecondTileIsMirroredAndBordersAreNotDoubled) {
  Heightfield tile = Heightfield::zeros(3, 2, 5, 7);
  tile.heights = {1, 2, 3, 4, 5, 6};
  const Heightfield mosaic = mirrored_mosaic(tile, 7);
  EXPECT_EQ(mosaic.cell_x, 5);
  EXPECT_EQ(mosaic.cell_z, 7);
  EXPECT_TRUE(mosaic.georeference.crs.empty());
  // The tile begins two columns and two rows after the first.
  EXPECT_THAT(mosaic.heights, testing::ElementsAre(3, 2, 1, 2, 3, 2, 1,  //
                                                   6, 5, 4, 5, 6, 5, 4,  //
                                                   3, 2, 1, 2, 3, 2, 1,  //
                                                   6, 5, 4, 5, 6, 5, 4,  //
                                                   3, 2, 1, 2, 3, 2, 1,  //
                                                   6, 5, 4, 5, 6, 5, 4,  //
                                                   3, 2, 1, 2, 3, 2, 1));
}

TEST(Mosaic, ASmallerSizeIsTheTilesMiddle) {
  Heightfield tile = Heightfield::zeros(4, 4);
  std::iota(tile.heights.begin(), tile.heights.end(), 0.0F);
  EXPECT_THAT(mirrored_mosaic(tile, 2).heights, testing::ElementsAre(5, 6, 9, 10));
  EXPECT_THAT(mirrored_mosaic(Heightfield::zeros(1, 1), 3).heights, testing::Each(0));
}

// No step between neighbouring samples is larger than on the tile.
TEST(Mosaic, MountStHelensIsContinuousOverItsTiles) {
  const auto steepest = [](const Heightfield& field) {
    float most = 0;
    for (int j = 1; j < field.depth; ++j) {
      for (int i = 1; i < field.width; ++i) {
        most = std::max({most, std::abs(field.at(i, j) - field.at(i - 1, j)),
                         std::abs(field.at(i, j) - field.at(i, j - 1))});
      }
    }
    return most;
  };
  const TerrainSource mosaic = open_terrain("helens-mosaic"), tile = open_terrain("helens");
  EXPECT_EQ(mosaic.heights->width, 4097);
  EXPECT_EQ(mosaic.heights->depth, 4097);
  EXPECT_EQ(steepest(*mosaic.heights), steepest(*tile.heights));
}

}  // namespace
}  // namespace terrabench
