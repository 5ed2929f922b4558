#include "representations/coding/column_codec.h"

#include "representations/layered_stack/layered_stack.h"
#include "tests/representations/ground.h"

namespace terrabench::test {
namespace {

TEST(ColumnCodec, KeepsColumnsWithCavesOfManyMaterials) {
  for (const TerrainSource& source :
       {random_boxes(21, 60, 40, 3), caves(), from_heights(3, 2, {1, 2, 3, 4, 5, 9})}) {
    const auto built = build("layered_stack", source, 60);
    const ColumnGrid& grid = *built->column_grid();
    const ColumnsOfRuns columns = columns_of(*built, grid);
    ByteSink out;
    encode_columns(grid, columns, out);
    ByteSource in(out.bytes(), "test");
    ColumnGrid again;
    EXPECT_EQ(decode_columns(in, again), columns);
    EXPECT_EQ(again, grid);
    EXPECT_EQ(in.left(), 0U);
  }
}

TEST(ColumnCodec, StacksAndVoxelsHaveTheSameFile) {
  const auto bytes = [](std::string_view type) {
    const auto built = build(type, caves(), 40);
    ByteSink out;
    encode_columns(*built->column_grid(), columns_of(*built, *built->column_grid()), out);
    return std::vector(out.bytes().begin(), out.bytes().end());
  };
  EXPECT_EQ(bytes("layered_stack"), bytes("voxel"));
  EXPECT_EQ(bytes("layered_stack"), bytes("dense_voxel"));
}

TEST(ColumnCodec, RefusesDamagedBytes) {
  const auto built = build("layered_stack", caves(), 20);
  ByteSink out;
  encode_columns(*built->column_grid(), columns_of(*built, *built->column_grid()), out);
  const std::vector<std::byte> good(out.bytes().begin(), out.bytes().end());
  std::mt19937 random(3);
  for (int k = 0; k < 500; ++k) {
    std::vector<std::byte> bad = good;
    bad[random() % bad.size()] ^= static_cast<std::byte>(1 + random() % 255);
    ByteSource in(bad, "test");
    ColumnGrid grid;
    try {
      decode_columns(in, grid);
    } catch (const Error&) {
    }
  }
  for (std::size_t length = 0; length < good.size(); ++length) {
    ByteSource in(std::span<const std::byte>(good).first(length), "test");
    ColumnGrid grid;
    EXPECT_ANY_THROW(decode_columns(in, grid)) << length;
  }
}

}  // namespace
}  // namespace terrabench::test
