// Where the DEM reader places a raster: directions of rows and columns, cells in metres, units of the grid.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "terrain/sources/dem/dem.h"
#include "tests/terrain/raster_file.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench {
namespace {

using testing::Contains;
using testing::HasSubstr;

TEST(DemPlacement, TurnsRastersToNorthFirstAndWestFirst) {
  const TemporaryFolder folder;
  RasterFile file = metres();
  file.write(folder / "north.tif");
  const Heightfield north = read_dem(folder / "north.tif").heights;
  for (const bool flip_x : {false, true}) {
    for (const bool flip_z : {false, true}) {
      file.transform = {flip_x ? kUtm[0] + 6 * 30 : kUtm[0],
                        flip_x ? -30.0 : 30.0,
                        0,
                        flip_z ? kUtm[3] - 4 * 30 : kUtm[3],
                        0,
                        flip_z ? 30.0 : -30.0};
      file.value = [=](int i, int j) { return 100.0 + (flip_x ? 5 - i : i) + 10.0 * (flip_z ? 3 - j : j); };
      file.write(folder / "turned.tif");
      const Heightfield turned = read_dem(folder / "turned.tif").heights;
      EXPECT_EQ(turned.heights, north.heights) << flip_x << flip_z;
      EXPECT_EQ(turned.georeference, north.georeference) << flip_x << flip_z;
    }
  }
}

TEST(DemPlacement, DegreesBecomeMetresAtTheMiddleLatitude) {
  const TemporaryFolder folder;
  RasterFile file;
  file.transform = {-84.41375, 1.0 / 1200, 0, 36.6 + 2.0 / 1200, 0, -1.0 / 1200};
  file.epsg = kWgs84;
  file.write(folder / "a.tif");
  const Dem dem = read_dem(folder / "a.tif");
  EXPECT_NEAR(dem.heights.cell_x, 74.56, 0.01);
  EXPECT_NEAR(dem.heights.cell_z, 92.48, 0.01);
  EXPECT_THAT(dem.notes, Contains("cells of 3″ are 74.6 m × 92.5 m at 36.6° N"));
  EXPECT_EQ(dem.heights.georeference.transform, *file.transform);

  // The same without a reference system is guessed, and said.
  file.epsg = 0;
  file.write(folder / "b.tif");
  const Dem guessed = read_dem(folder / "b.tif");
  EXPECT_EQ(guessed.heights.cell_x, dem.heights.cell_x);
  EXPECT_THAT(guessed.notes, Contains(HasSubstr("look like degrees")));
}

TEST(DemPlacement, ADegreeHasItsKnownLengths) {
  // From the published radii of curvature of WGS 84, in metres: at the equator a = 6378137 and b²/a =
  // 6335439.3273; at 45° 6388838.2901 and 6367381.8156; at the pole a²/b = 6399593.6258.
  const double degree = std::acos(-1.0) / 180;
  EXPECT_NEAR(degree_lengths(0).east, 6378137 * degree, 0.001);
  EXPECT_NEAR(degree_lengths(0).north, 6335439.3273 * degree, 0.001);
  EXPECT_NEAR(degree_lengths(45).east, 6388838.2901 * std::sqrt(0.5) * degree, 0.001);
  EXPECT_NEAR(degree_lengths(-45).north, 6367381.8156 * degree, 0.001);
  EXPECT_NEAR(degree_lengths(90).north, 6399593.6258 * degree, 0.001);
  EXPECT_NEAR(degree_lengths(60, 1737400, 0).east, 1737400 * std::acos(-1.0) / 360,
              0.01);  // the Moon is a sphere
}

TEST(DemPlacement, LinearUnitsOfTheReferenceSystemBecomeMetres) {
  const TemporaryFolder folder;
  RasterFile file;
  file.transform = {2000000, 100, 0, 600000, 0, -100};
  file.epsg = 2274;  // Tennessee, US survey feet
  file.write(folder / "a.tif");
  const Dem dem = read_dem(folder / "a.tif");
  EXPECT_NEAR(dem.heights.cell_x, 100 * 1200.0 / 3937, 1e-4);
  EXPECT_THAT(dem.notes, Contains(HasSubstr("are 30.48")));
}

TEST(DemPlacement, NoGeoreferenceMeansMetreCellsAndIsSaid) {
  const TemporaryFolder folder;
  RasterFile().write(folder / "a.tif");
  const Dem dem = read_dem(folder / "a.tif");
  expect_ramp(dem.heights, 6, 4);
  EXPECT_EQ(dem.heights.cell_x, 1);
  EXPECT_EQ(dem.heights.georeference, Georeference{});
  EXPECT_THAT(dem.notes, Contains(HasSubstr("taken as 1 m")));
}

}  // namespace
}  // namespace terrabench
