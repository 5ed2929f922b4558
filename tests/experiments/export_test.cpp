// `terrabench represent --save` and `export`: the file's form follows from its name.
#include <gmock/gmock.h>

#include "representations/export/span_table.h"
#include "representations/procedural_mesh/mesh_files.h"
#include "terrain/source.h"
#include "terrain/sources/dem/dem.h"
#include "tests/experiments/command_line.h"

namespace terrabench {
namespace {

using ::testing::HasSubstr;

class Export : public CommandLine {
 protected:
  Heightfield ground_ = crop(*open_terrain("jacksboro").heights, 20, 30, 64, 48);
  const std::string crop_ = "jacksboro --crop 20 30 64 48 ";
};

TEST_F(Export, AHeightmapComesBackAsTheDemThatItWas) {
  const Outcome outcome = call("$T represent " + crop_ + "--as heightmap --save new/a.tif");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("GeoTIFF"));
  const Heightfield kept = read_dem(folder_ / "new/a.tif").heights;
  EXPECT_EQ(kept.heights, ground_.heights);
  EXPECT_EQ(kept.georeference.transform, ground_.georeference.transform);
  EXPECT_TRUE(same_reference_system(kept.georeference.crs, ground_.georeference.crs));
  EXPECT_FALSE(same_reference_system(kept.georeference.crs, ""));
  EXPECT_THAT(kept.georeference.crs, HasSubstr("4326"));
  EXPECT_EQ(temporary_files(), 0U);
}

TEST_F(Export, ASavedRepresentationIsWrittenInOtherForms) {
  write_geotiff(folder_ / "dem.tif", ground_);
  ASSERT_EQ(call("$T represent dem.tif --as layered_stack --set step=1 --save a.tb").code, 0);
  for (const char* const name : {"a.tif", "a.csv", "a.ply", "a.obj", "a.vdb"}) {
    const Outcome outcome = call("$T export a.tb " + std::string(name) + " --like dem.tif");
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr(name));
  }
  const Heightfield kept = read_dem(folder_ / "a.tif").heights;
  EXPECT_EQ(kept.heights, ground_.heights);  // whole metres in steps of a metre
  EXPECT_EQ(kept.georeference.transform, ground_.georeference.transform);
  EXPECT_EQ(read_spans(folder_ / "a.csv").spans.size(), ground_.heights.size());
  EXPECT_GT(read_mesh(folder_ / "a.ply").faces(), ground_.heights.size());
  EXPECT_EQ(temporary_files(), 0U);
  ASSERT_EQ(call("$T export a.tb b.tif").code, 0);
  EXPECT_EQ(read_dem(folder_ / "b.tif").heights.heights, ground_.heights);
}

TEST_F(Export, SolidsLieWhereTheirBoundsSay) {
  ASSERT_EQ(call("$T represent canyon --as heightmap --set resolution=32 --save a.tif").code, 0);
  ASSERT_EQ(call("$T represent canyon --as heightmap --set resolution=32 --save a.csv").code, 0);
  const Bounds bounds = open_terrain("canyon").bounds();
  const Heightfield kept = read_dem(folder_ / "a.tif").heights;
  const std::array<double, 6>& t = kept.georeference.transform;
  EXPECT_NEAR(t[0], bounds.low.x, 1e-3);
  EXPECT_NEAR(t[0] + kept.width * t[1], bounds.high.x, 1e-2);
  EXPECT_NEAR(t[3], -bounds.low.z, 1e-3);
  EXPECT_NEAR(t[3] + kept.depth * t[5], -bounds.high.z, 1e-2);
  const SpanTable table = read_spans(folder_ / "a.csv");
  ASSERT_EQ(table.spans.size(), kept.heights.size());
  EXPECT_NEAR(table.x[0], t[0] + 0.5 * t[1], 1e-3);
}

TEST_F(Export, WhatCannotBeWrittenIsRefusedBeforeItIsBuilt) {
  for (const char* const name : {"a.vdb", "a.stl", "a"}) {
    const Outcome outcome =
        call("$T represent " + crop_ + "--as heightmap --save " + name + " --render r.png");
    EXPECT_EQ(outcome.code, 2) << name;
    EXPECT_THAT(outcome.text, HasSubstr(".tb, .tif, .ply, .obj or .csv"));
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "r.png"));
  ASSERT_EQ(call("$T represent " + crop_ + "--as heightmap --save a.tb").code, 0);
  EXPECT_EQ(call("$T export a.tb a.vdb").code, 2);
  const Outcome other = call("$T export a.tb a.tif --like jacksboro.tif");
  EXPECT_EQ(other.code, 3) << other.text;
  write_geotiff(folder_ / "dem.tif", crop(ground_, 0, 0, 60, 48));
  const Outcome smaller = call("$T export a.tb a.tif --like dem.tif");
  EXPECT_EQ(smaller.code, 2) << smaller.text;
  EXPECT_THAT(smaller.text, HasSubstr("name the DEM that it was built from"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.tif"));
}

TEST_F(Export, TheSurfaceAloneWithZUp) {
  ASSERT_EQ(call("$T represent " + crop_ + "--as heightmap --save a.tb").code, 0);
  ASSERT_EQ(call("$T export a.tb closed.ply").code, 0);
  ASSERT_EQ(call("$T export a.tb open.obj --surface-only --up z").code, 0);
  const FaceMesh closed = read_mesh(folder_ / "closed.ply"), open = read_mesh(folder_ / "open.obj");
  EXPECT_GT(closed.faces(), 2U * 63 * 47);
  EXPECT_EQ(open.faces(), 2U * 63 * 47);
  ASSERT_EQ(open.positions.size(), ground_.heights.size());
  const auto [low, high] = std::ranges::minmax(ground_.heights);
  for (const glm::vec3& p : open.positions) {
    EXPECT_LE(p.y, 0);
    EXPECT_GE(p.z, low);
    EXPECT_LE(p.z, high);
  }
  EXPECT_EQ(call("$T export a.tb b.tif --up z").code, 2);
  EXPECT_EQ(call("$T export a.tb b.ply --up x").code, 2);
  EXPECT_EQ(call("$T export a.tb b.ply --up z --like dem.tif").code, 2);
}

TEST_F(Export, TheSurfaceOfASolidKeepsItsOverhangs) {
  ASSERT_EQ(call("$T represent caves --as implicit --set resolution=32 --save a.tb").code, 0);
  ASSERT_EQ(call("$T export a.tb closed.ply").code, 0);
  ASSERT_EQ(call("$T export a.tb open.ply --surface-only").code, 0);
  const auto looking_down = [&](const char* name) {
    const FaceMesh mesh = read_mesh(folder_ / name);
    std::size_t down = 0;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
      const auto face = mesh.face(f);
      const glm::vec3 a = mesh.positions[face[0]], b = mesh.positions[face[1]], c = mesh.positions[face[2]];
      down += glm::cross(b - a, c - a).y < 0 ? 1 : 0;
    }
    return down;
  };
  EXPECT_GT(looking_down("open.ply"), 100U);  // ceilings of the caves
  EXPECT_LT(looking_down("open.ply"), looking_down("closed.ply"));
}

TEST_F(Export, AFullDiskLeavesNothingHalf) {
  ASSERT_EQ(call("$T represent " + crop_ + "--as layered_stack --set step=7 --save a.tb").code, 0);
  for (const char* const name : {"b.tif", "b.csv", "b.ply", "b.obj", "b.vdb", "b.tb"}) {
    // One block of 512 bytes a file.
    const Outcome full = call("ulimit -f 1; $T export a.tb " + std::string(name));
    EXPECT_EQ(full.code, 4) << full.text;
    EXPECT_FALSE(std::filesystem::exists(folder_ / name)) << name;
  }
  EXPECT_EQ(temporary_files(), 0U);
}

}  // namespace
}  // namespace terrabench
