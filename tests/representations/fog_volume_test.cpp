// The OpenVDB files as OpenVDB reads them.
#include "representations/export/fog_volume.h"

#include <gmock/gmock.h>
#include <openvdb/openvdb.h>

#include "representations/voxel/voxel.h"
#include "tests/representations/export_ground.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/ground.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench::test {
namespace {

struct Volume {
  openvdb::FloatGrid::Ptr density;
  openvdb::Int32Grid::Ptr material;  // null: all is bedrock
};

class FogVolume : public testing::Test {
 protected:
  Volume written(const Representation& built, const LineGrid& lines) {
    write_fog(path_, built, lines, progress_);
    openvdb::initialize();
    openvdb::io::File file(path_);
    file.open();
    Volume volume{openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("density")), nullptr};
    if (file.hasGrid("material")) {
      volume.material = openvdb::gridPtrCast<openvdb::Int32Grid>(file.readGrid("material"));
    }
    EXPECT_EQ(folder_.names().size(), 1U);
    return volume;
  }

  TemporaryFolder folder_;
  std::string path_ = folder_ / "a.vdb";
  Progress progress_;
};

// Every cell's middle, asked of the file by its place in metres.
TEST_F(FogVolume, VoxelsOfSeveralMaterialsAreWrittenAsTheyAre) {
  for (const std::string_view type : types([](const Traits& traits) { return traits.materials; })) {
    SCOPED_TRACE(type);
    const auto built = build(type, random_cells(5, 19, 26, 23, 3, 55), 26);
    const ColumnGrid grid = *built->column_grid();
    const Volume volume = written(*built, own_lines(*built));
    ASSERT_NE(volume.material, nullptr);
    std::uint64_t solid = 0;
    for (int j = 0; j < grid.depth; ++j) {
      for (int i = 0; i < grid.width; ++i) {
        for (int level = 0; level < grid.levels; ++level) {
          const std::vector<float> x{grid.centre_x(i)}, y{grid.centre_y(level)}, z{grid.centre_z(j)};
          Material expected{};
          built->materials({x, y, z}, {&expected, 1});
          const openvdb::Vec3d cell = volume.density->worldToIndex({x[0], y[0], z[0]});
          const openvdb::Coord at(static_cast<int>(std::lround(cell.x())),
                                  static_cast<int>(std::lround(cell.y())),
                                  static_cast<int>(std::lround(cell.z())));
          ASSERT_EQ(at, openvdb::Coord(i, level, j));
          ASSERT_EQ(volume.density->tree().getValue(at), expected == Material::kAir ? 0.0F : 1.0F);
          const int other = expected == Material::kBedrock ? 0 : static_cast<int>(expected);
          ASSERT_EQ(volume.material->tree().getValue(at), other);
          solid += expected != Material::kAir ? 1 : 0;
        }
      }
    }
    EXPECT_EQ(volume.density->activeVoxelCount(), solid);
    EXPECT_GT(solid, 3000U);
    EXPECT_EQ(volume.density->getGridClass(), openvdb::GRID_FOG_VOLUME);
  }
}

// The volume of the spans, and not more leaves than a surface needs.
TEST_F(FogVolume, OtherTypesAreSampledByTheShareOfEachCell) {
  const Heightfield ground = waves(90, 64, 40, 10, 10);
  for (const char* const type : {"ght", "implicit", "procedural_mesh"}) {
    SCOPED_TRACE(type);
    const auto built = build(type, source_of("ground", ground));
    const LineGrid lines = lines_of(ground);
    const Volume volume = written(*built, lines);
    EXPECT_EQ(volume.material, nullptr);
    double metres = 0, expected = 0;
    for (auto value = volume.density->cbeginValueOn(); value; ++value) {
      metres += 10 * static_cast<double>(*value) * static_cast<double>(value.getVoxelCount());
    }
    for (int j = 0; j < lines.depth; ++j) {
      for (int i = 0; i < lines.width; ++i) {
        const std::vector<float> x{lines.x(i)}, z{lines.z(j)};
        const SpanSink sink = spans_of(*built, {x, z});
        for (const Span& span : sink.all()) {
          expected += span.top - span.bottom;
        }
      }
    }
    EXPECT_NEAR(metres / expected, 1, 1e-5);
  }
}

TEST_F(FogVolume, KeepsHeightsPlaceAndHoles) {
  Heightfield ground = random_ground(37, 21, 3, -50, 900, 30, 28);
  ground.at(36, 20) = ground.at(0, 7) = Heightfield::kNoData;
  ground.georeference = {"LOCAL_CS[\"here\"]", {7, 30, 0, 9, 0, -28}};
  const auto tree = build("ght", source_of("ground", ground));
  write_fog(path_, *tree, lines_of(ground), progress_);
  const Heightfield kept = read_fog_heights(path_);
  EXPECT_EQ(kept.georeference, ground.georeference);
  ASSERT_EQ(kept.width, 37);
  ASSERT_EQ(kept.depth, 21);
  EXPECT_NEAR(kept.cell_z, 28, 1e-5);
  const std::vector<float> expected = tops(*tree, lines_of(ground));
  int holes = 0;
  for (std::size_t c = 0; c < expected.size(); ++c) {
    ASSERT_EQ(Heightfield::is_no_data(kept.heights[c]), Heightfield::is_no_data(expected[c])) << c;
    if (Heightfield::is_no_data(expected[c])) {
      ++holes;
    } else {
      ASSERT_NEAR(kept.heights[c], expected[c], 1e-4) << c;
    }
  }
  EXPECT_GE(holes, 2);
}

// A coarser lattice than the ground's samples is placed over the same ground.
TEST_F(FogVolume, ACoarserLatticeIsPlacedOverTheSameGround) {
  Heightfield ground = waves(64, 64, 20, 10, 10);
  ground.georeference.transform = {1000, 10, 0, 5000, 0, -10};
  const auto voxels = build("voxel", source_of("ground", ground), 32);
  write_fog(path_, *voxels, lines_of(ground), progress_);
  const std::array<double, 6> t = read_fog_heights(path_).georeference.transform;
  EXPECT_NEAR(t[0], 1000, 11);  // half a cell of the coarser lattice more or less
  EXPECT_NEAR(t[0] + 32 * t[1], 1640, 11);
  EXPECT_NEAR(t[3] + 32 * t[5], 5000 - 640, 11);
}

TEST_F(FogVolume, OtherFilesAreNotHeights) {
  EXPECT_EQ(failure_of([&] { read_fog_heights(folder_.write("b.vdb", "nothing")); }).code,
            ExitCode::kBadInput);
  EXPECT_EQ(failure_of([&] { read_fog_heights(folder_ / "missing.vdb"); }).code, ExitCode::kBadInput);
}

}  // namespace
}  // namespace terrabench::test
