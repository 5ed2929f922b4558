// What every type writes for other programs is what it answers: rasters and tables to the bit.
#include "representations/export/export.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include "representations/export/span_table.h"
#include "representations/procedural_mesh/mesh_files.h"
#include "terrain/sources/dem/dem.h"
#include "tests/representations/export_ground.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/ground.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench::test {
namespace {

using testing::HasSubstr;
using testing::Not;

Heightfield small_ground() {
  Heightfield field = hilly(40, 31, 3, 5, 29.7F, 31.3F);
  field.at(3, 4) = field.at(39, 30) = Heightfield::kNoData;
  field.georeference.transform = {500000, 29.7, 0, 4000000, 0, -31.3};
  return field;
}

// Not a number equals itself here.
bool same(const std::vector<float>& a, const std::vector<float>& b) {
  return std::ranges::equal(a, b,
                            [](float p, float q) { return p == q || (std::isnan(p) && std::isnan(q)); });
}

struct Written {
  const TemporaryFolder folder;
  Progress progress;
  std::string operator()(const char* name, std::string_view type, const Representation& built,
                         const LineGrid& lines) {
    export_representation(folder / name, representation(type), built, lines, progress);
    return folder / name;
  }
};

TEST(Export, RastersAndTablesHoldTheSurfaceToTheBit) {
  Written write;
  const Heightfield ground = small_ground();
  const TerrainSource source = source_of("ground", ground);
  for (const std::string_view type : types()) {
    SCOPED_TRACE(type);
    const auto built = build(type, source, 0, 0.75);
    const LineGrid lines = lines_of(ground);
    const std::vector<float> expected = tops(*built, lines);
    const Heightfield raster = read_dem(write("a.tif", type, *built, lines)).heights;
    EXPECT_TRUE(same(raster.heights, expected));
    EXPECT_EQ(raster.georeference.transform, ground.georeference.transform);
    EXPECT_EQ(raster.cell_x, ground.cell_x);
    EXPECT_TRUE(same(heights_of(read_spans(write("a.csv", type, *built, lines)), lines).heights, expected));
    const auto loaded = load_representation(write("a.TB", type, *built, lines));
    EXPECT_TRUE(same(tops(*loaded.representation, lines), expected));
    EXPECT_EQ(loaded.type->name, type);
    EXPECT_EQ(own_lines(*built).width, type == "procedural_mesh" ? 128 : ground.width);
  }
  EXPECT_EQ(write.folder.names().size(), 3U);  // no temporary file is left
}

TEST(Export, TablesHoldEverySpanAndMaterial) {
  Written write;
  for (const std::string_view type : types()) {
    SCOPED_TRACE(type);
    const auto built = build(type, random_boxes(4, 23, 30, 3), 23);
    const LineGrid lines = own_lines(*built);
    const SpanTable table = read_spans(write("a.csv", type, *built, lines));
    std::size_t row = 0;
    for (int j = 0; j < lines.depth; ++j) {
      for (int i = 0; i < lines.width; ++i) {
        const std::vector<float> x{lines.x(i)}, z{lines.z(j)};
        const SpanSink sink = spans_of(*built, {x, z});
        for (const Span& span : sink.all()) {
          ASSERT_LT(row, table.spans.size());
          ASSERT_EQ(table.spans[row], span);
          ASSERT_EQ(table.x[row], x[0]);
          ASSERT_EQ(table.z[row], z[0]);
          ++row;
        }
      }
    }
    EXPECT_EQ(row, table.spans.size());
    EXPECT_GT(row, 100U);
  }
}

TEST(Export, PolygonsAreThoseOfTheMesh) {
  Written write;
  const TerrainSource source = source_of("ground", small_ground());
  for (const std::string_view type : types()) {
    SCOPED_TRACE(type);
    const auto built = build(type, source, 0, 4);
    const FaceMesh ply = read_mesh(write("a.ply", type, *built, {})),
                   obj = read_mesh(write("a.obj", type, *built, {}));
    EXPECT_EQ(ply.positions, obj.positions);
    EXPECT_EQ(ply.corners, obj.corners);
    if (type == "procedural_mesh") {
      EXPECT_EQ(ply.faces(), 39U * 30 - 5);  // quadrilaterals, without those at a hole
    } else {
      const TriangleMesh mesh = built->mesh({});
      EXPECT_EQ(ply.positions, mesh.positions);
      EXPECT_EQ(ply.corners, mesh.indices);
    }
  }
}

TEST(Export, FilesOfOneThreadAreThoseOfMany) {
  Written many, one;
  const auto built = build("layered_stack", random_boxes(8, 70, 40, 2), 70);
  const LineGrid lines = own_lines(*built);
  for (const char* const name : {"a.csv", "a.tif"}) {
    const std::string expected = read_file(many(name, "layered_stack", *built, lines));
    const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(read_file(one(name, "layered_stack", *built, lines)), expected) << name;
  }
}

TEST(Export, AnExtensionThatATypeCannotWriteIsRefusedWithThoseItCan) {
  Written write;
  const auto built = build("heightmap", source_of("ground", small_ground()));
  for (const char* const name : {"a.vdb", "a.stl", "a", ".tif"}) {
    const Failure failure = failure_of([&] { write(name, "heightmap", *built, {}); });
    EXPECT_EQ(failure.code, ExitCode::kUsage) << name;
    EXPECT_THAT(failure.advice, HasSubstr(".tb, .tif, .ply, .obj or .csv")) << name;
  }
  EXPECT_THAT(failure_of([&] { write("a.stl", "voxel", *built, {}); }).advice, HasSubstr(".vdb"));
  EXPECT_TRUE(write.folder.names().empty());
  const auto row = build("heightmap", from_heights(3, 1, {1, 2, 3}));
  EXPECT_THAT(failure_of([&] { write("a.ply", "heightmap", *row, {}); }).what, HasSubstr("no faces"));
}

TEST(Export, PlacesCoarserLinesOnTheSameGround) {
  const LineGrid fine = lines_of(small_ground());
  EXPECT_EQ(place(fine, fine), fine.georeference);
  LineGrid coarse = fine;
  coarse.cell_x *= 3;
  coarse.origin_x = 29.7F;  // the second sample: its pixel spans the first three of `fine`
  const std::array<double, 6> t = place(coarse, fine).transform;
  EXPECT_NEAR(t[0], 500000, 1e-6);
  EXPECT_NEAR(t[1], 3 * 29.7, 1e-9);
  EXPECT_EQ(t[3], 4000000);
  EXPECT_EQ(place(coarse, LineGrid{}).transform, (std::array<double, 6>{}));
}

TEST(SpanTable, OtherFilesAreRefused) {
  const TemporaryFolder folder;
  const auto what = [&](const std::string& text) {
    return failure_of([&] { read_spans(folder.write("a.csv", text)); }).what;
  };
  const std::string head = fmt::format("{}\n", kSpanHeader);
  for (const std::string& text :
       {std::string("x,y\n"), head + "1,2,3,4,1\n1,2,3\n", head + "1,zwei,3,4,1\n"}) {
    EXPECT_THAT(what(text), HasSubstr("no table of spans")) << text;
  }
}

TEST(SpanTable, HeightsAreTheHighestEndsOnTheLines) {
  const LineGrid lines{2, 1, 10, 20, 5, 5, {}};
  const SpanTable table{{15, 15, 10.1F, 40},
                        {20, 20, 20, 20},
                        {{0, 7, Material::kBedrock},
                         {-2, -1, Material::kBedrock},
                         {0, 1, Material::kBedrock},
                         {0, 1, Material::kBedrock}}};
  const Heightfield field = heights_of(table, lines);
  EXPECT_TRUE(Heightfield::is_no_data(field.at(0, 0)));  // 10.1 is not on a line
  EXPECT_EQ(field.at(1, 0), 7);
}

}  // namespace
}  // namespace terrabench::test
