// Where the DEM reader places a raster: directions of rows and columns, cells in metres, units of the grid.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "terrain/sources/dem/dem.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/raster_file.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

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

TEST(DemPlacement, WindowsCountFromTheNorthWestHoweverTheFileIsOrdered) {
  const TemporaryFolder folder;
  RasterFile file = metres();
  file.write(folder / "north.tif");
  DemOptions options;
  options.window = {1, 2, 4, 1};
  const Heightfield north = read_dem(folder / "north.tif", options).heights;
  EXPECT_EQ(north.at(0, 0), 121);
  file.transform = {kUtm[0] + 6 * 30, -30, 0, kUtm[3] - 4 * 30, 0, 30};
  file.value = [](int i, int j) { return 100.0 + (5 - i) + 10.0 * (3 - j); };
  file.write(folder / "turned.tif");
  const Heightfield turned = read_dem(folder / "turned.tif", options).heights;
  EXPECT_EQ(turned.heights, north.heights);
  EXPECT_EQ(turned.georeference, north.georeference);
}

TEST(DemPlacement, CellsAreAsLargeAsTheGroundWhereAProjectionStretchesIt) {
  const TemporaryFolder folder;
  RasterFile file = metres();
  file.width = file.depth = 8;
  // The middle at 60° N. Web Mercator is x = aλ, y = a ln tan(45° + φ/2), so that a metre of the map is cos
  // φ·N/a along the parallel and cos φ·M/a along the meridian. EPSG:3395 is the same on the ellipsoid: cos
  // φ·N/a both.
  const double kPi = std::acos(-1.0), a = 6378137, e2 = 0.00669437999014;
  const double q = 1 - e2 * 0.75, n = 1 / std::sqrt(q), m = (1 - e2) / (q * std::sqrt(q));
  struct Projection {
    int epsg;
    double northing, x, z;
  };
  const double e = std::sqrt(e2), s = std::sqrt(0.75);
  const double web = a * std::log(std::tan(75 * kPi / 180));
  const double world = web - a * e / 2 * std::log((1 + e * s) / (1 - e * s));
  for (const Projection& p : {Projection{3857, web, 50 * n, 50 * m}, {3395, world, 50 * n, 50 * n}}) {
    file.epsg = p.epsg;
    file.transform = {1000000 - 400, 100, 0, p.northing + 400, 0, -100};
    file.write(folder / "a.tif");
    const Dem dem = read_dem(folder / "a.tif");
    EXPECT_NEAR(dem.heights.cell_x, p.x, 0.001) << p.epsg;
    EXPECT_NEAR(dem.heights.cell_z, p.z, 0.001) << p.epsg;
    EXPECT_EQ(dem.heights.georeference.transform, *file.transform)
        << "saved files keep the map's coordinates";
    EXPECT_THAT(dem.notes, Contains(HasSubstr("on the ground at 60.0° N"))) << p.epsg;
  }
}

TEST(DemPlacement, ProjectionsOfSurveysKeepTheirCells) {
  const TemporaryFolder folder;
  RasterFile file = metres();
  struct Place {
    int epsg;
    double x, y;
  };
  // UTM in the middle of its zone (0.9996) and at its border, British and French grids, Albers of the USA.
  for (const Place& at : {Place{32633, 500000, 5100000},
                          {32633, 750000, 5100000},
                          {27700, 400000, 300000},
                          {2154, 700000, 6600000},
                          {5070, 0, 2000000}}) {
    file.epsg = at.epsg;
    file.transform = {at.x, 30, 0, at.y, 0, -30};
    file.write(folder / "a.tif");
    const Dem dem = read_dem(folder / "a.tif");
    EXPECT_EQ(dem.heights.cell_x, 30) << at.epsg;
    EXPECT_EQ(dem.heights.cell_z, 30) << at.epsg;
    EXPECT_THAT(dem.notes, testing::IsEmpty()) << at.epsg;
  }
}

TEST(DemPlacement, SkewedGroundIsSaid) {
  const TemporaryFolder folder;
  RasterFile file = metres();
  file.system = "+proj=sinu +R=6371007.181 +units=m";  // MODIS tiles; far from its middle meridian
  file.transform = {5000000, 463.3, 0, 5000000, 0, -463.3};
  file.write(folder / "a.tif");
  EXPECT_THAT(read_dem(folder / "a.tif").notes, Contains(HasSubstr("rows and columns meet at")));
}

TEST(DemPlacement, GeocentricCoordinatesAreNoPlan) {
  const TemporaryFolder folder;
  const std::string path = folder.write(
      "a.vrt",
      "<VRTDataset rasterXSize=\"3\" rasterYSize=\"2\"><SRS>EPSG:4978</SRS><GeoTransform>0, 5, 0, 0, 0, "
      "-5</GeoTransform><VRTRasterBand dataType=\"Int16\" band=\"1\"/></VRTDataset>");
  const Failure failure = failure_of([&] { (void)read_dem(path); });
  EXPECT_EQ(failure.code, ExitCode::kBadInput);
  EXPECT_THAT(failure.what, HasSubstr("geocentric"));
}

// The unit of a saved file's vertical reference system, metres.
double vertical_unit(const std::string& path) {
  const std::unique_ptr<GDALDataset> saved(GDALDataset::Open(path.c_str()));
  const OGRSpatialReference* const system = saved->GetSpatialRef();
  return system->IsVertical() != 0 ? system->GetTargetLinearUnits("VERT_CS") : 0;
}

TEST(DemPlacement, HeightsInFeetAreSavedUnderAVerticalSystemInMetres) {
  const TemporaryFolder folder;
  RasterFile file;
  file.transform = {2000000, 100, 0, 600000, 0, -100};
  file.system = "EPSG:2274+6360";  // Tennessee, and NAVD88 height (ftUS)
  file.write(folder / "a.tif");
  EXPECT_NEAR(vertical_unit(folder / "a.tif"), 1200.0 / 3937, 1e-9) << "the test's own file";
  const Dem dem = read_dem(folder / "a.tif");
  EXPECT_FLOAT_EQ(dem.heights.at(0, 0), static_cast<float>(100 * 1200.0 / 3937));
  write_geotiff(folder / "b.tif", dem.heights);
  EXPECT_EQ(vertical_unit(folder / "b.tif"), 1);
  const Dem back = read_dem(folder / "b.tif");
  EXPECT_EQ(back.heights.heights, dem.heights.heights);
  EXPECT_EQ(back.heights.cell_x, dem.heights.cell_x);
  EXPECT_THAT(back.heights.georeference.crs, HasSubstr("North American Vertical Datum 1988"));
  // A system in metres stays as it is.
  file.system = "EPSG:32633+5773";
  file.write(folder / "c.tif");
  const Dem metric = read_dem(folder / "c.tif");
  EXPECT_THAT(metric.heights.georeference.crs, HasSubstr("EGM96 height"));
  EXPECT_EQ(metric.heights.at(0, 0), 100);
}

TEST(DemPlacement, APlanInFeetLeavesTheUnitOfHeightsInDoubt) {
  const TemporaryFolder folder;
  RasterFile file;
  file.transform = {2000000, 100, 0, 600000, 0, -100};
  file.epsg = 2274;
  file.write(folder / "a.tif");
  EXPECT_THAT(read_dem(folder / "a.tif").notes, Contains(HasSubstr("unit of its heights is not named")));
  EXPECT_THAT(read_dem("dem:" + (folder / "a.tif") + ",unit=m").notes, Not(Contains(HasSubstr("not named"))));
  file.unit = "US survey foot";
  file.write(folder / "a.tif");
  EXPECT_THAT(read_dem(folder / "a.tif").notes, Not(Contains(HasSubstr("not named"))));
}

TEST(DemPlacement, CoarseGridsThatFitTheGlobeAreDoubted) {
  const TemporaryFolder folder;
  const auto grid = [&](const std::string& corner, const std::string& cell) {
    const std::string path =
        folder.write("a.asc", "ncols 6\nnrows 4\n" + corner + "\ncellsize " + cell + "\n" +
                                  "1 2 3 4 5 6\n1 2 3 4 5 6\n1 2 3 4 5 6\n1 2 3 4 5 6\n");
    return read_dem(path).notes;
  };
  EXPECT_THAT(grid("xllcorner -180\nyllcorner -90", "4"), Contains(HasSubstr("could be degrees")));
  EXPECT_THAT(grid("xllcorner 500000\nyllcorner 5000000", "4"), Not(Contains(HasSubstr("degrees"))));
  // A plot measured from its own corner, of cells of any size.
  EXPECT_THAT(grid("xllcorner 0\nyllcorner 0", "4"), Not(Contains(HasSubstr("degrees"))));
  EXPECT_THAT(grid("xllcorner 0\nyllcorner 0", "0.05"), Not(Contains(HasSubstr("degrees"))));
}

}  // namespace
}  // namespace terrabench
