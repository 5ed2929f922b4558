// Saved structures come back whole; anything else is refused.
#include <filesystem>

#include "terrain/error.h"
#include "terrain/files.h"
#include "tests/representations/ground.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench::test {
namespace {

class SavedFile : public testing::Test {
 protected:
  std::string save(std::string_view name, const Representation& structure) {
    const std::size_t bytes = save_representation(path_, representation(name), structure);
    EXPECT_EQ(bytes, std::filesystem::file_size(path_));
    return read_file(path_);
  }
  static Loaded load(const std::string& file) {
    return load_representation(std::as_bytes(std::span(file)), "file");
  }
  static bool refused(const std::string& file) {
    try {
      load(file);
    } catch (const Error& error) {
      return error.code() == ExitCode::kBadInput;
    }
    return false;
  }
  // With a right checksum, so that what lies behind it is tested.
  static std::string resealed(std::string file) {
    file.resize(file.size() - 32);
    return file + checksum(file);
  }

  TemporaryFolder folder_;
  std::string path_ = folder_ / "saved.tb";
};

TEST_F(SavedFile, ComesBack) {
  for (const RepresentationType& type : representations()) {
    const auto built = build(type.name, random_boxes(4, 30, 40, 2), 30);
    save(type.name, *built);
    const Loaded loaded = load_representation(path_);
    EXPECT_EQ(loaded.type, &type);
    const Lattice lattice(built->bounds(), 30, 30);
    EXPECT_TRUE(
        same_spans(spans_of(*loaded.representation, lattice.columns()), spans_of(*built, lattice.columns())));
  }
}

// The tops at the samples of heights between hills, with a hole.
std::vector<float> tops_of(const Representation& built, int width, int depth) {
  std::vector<float> x, z, tops;
  for (int j = 0; j < depth; ++j) {
    for (int i = 0; i < width; ++i) x.push_back(static_cast<float>(i)), z.push_back(static_cast<float>(j));
  }
  SpanSink sink;
  built.spans({x, z}, sink);
  for (std::size_t c = 0; c < x.size(); ++c)
    tops.push_back(sink.column(c).empty() ? Heightfield::kNoData : sink.column(c).back().top);
  return tops;
}

TEST_F(SavedFile, EncodedKeepsHeightsToWithinTheLargestError) {
  constexpr int kWidth = 41, kDepth = 33;
  std::vector<float> heights;
  for (int j = 0; j < kDepth; ++j) {
    for (int i = 0; i < kWidth; ++i) {
      const bool hole = i >= 10 && i < 14 && j >= 5 && j < 9;
      heights.push_back(hole ? Heightfield::kNoData
                             : 500 + 80 * std::sin(0.21F * static_cast<float>(i)) *
                                         std::cos(0.17F * static_cast<float>(j)));
    }
  }
  for (const RepresentationType& type : representations()) {
    ASSERT_NE(type.decode, nullptr) << type.name;
    const auto built = build(type.name, from_heights(kWidth, kDepth, heights));
    const std::vector<float> before = tops_of(*built, kWidth, kDepth);
    std::size_t last = save(type.name, *built).size();
    for (const double error : {0.0, 0.5, 5.0}) {
      const std::size_t bytes = save_representation(path_, type, *built, error);
      EXPECT_LE(bytes, last) << type.name << " within " << error;
      last = bytes;
      const Loaded loaded = load_representation(path_);
      EXPECT_EQ(loaded.type, &type);
      const std::vector<float> after = tops_of(*loaded.representation, kWidth, kDepth);
      for (std::size_t c = 0; c < before.size(); ++c) {
        ASSERT_EQ(std::isnan(before[c]), std::isnan(after[c])) << type.name << " at " << c;
        if (std::isnan(before[c])) continue;
        ASSERT_NEAR(before[c], after[c], error + 0.001) << type.name << " at " << c;
      }
    }
  }
}

TEST_F(SavedFile, EncodedColumnsAndModelsAreExact) {
  for (const RepresentationType& type : representations()) {
    if (!type.traits.overhangs) continue;
    const auto built = build(type.name, random_boxes(4, 30, 40, 2), 30);
    save_representation(path_, type, *built, 0);
    const Lattice lattice(built->bounds(), 30, 30);
    const auto was = spans_of(*built, lattice.columns()),
               is = spans_of(*load_representation(path_).representation, lattice.columns());
    if (built->column_grid() != nullptr) {
      EXPECT_TRUE(same_spans(was, is)) << type.name;
      continue;
    }
    for (std::size_t c = 0; c < lattice.columns().size(); ++c)
      EXPECT_EQ(was.column(c).size(), is.column(c).size()) << type.name;
  }
}

TEST_F(SavedFile, CutOrAlteredAnywhereIsRefused) {
  for (const RepresentationType& type : representations()) {
    const auto built = build(type.name, random_boxes(4, 12, 20, 2), 12);
    save_representation(path_, type, *built, 0.5);
    const std::string encoded = read_file(path_);
    EXPECT_TRUE(refused(encoded.substr(0, encoded.size() / 2)));
    // What the checksum would hide: the structure's own reader takes any damage as bad input, or as other
    // ground.
    ByteSink sink;
    ASSERT_TRUE(built->encode(0.5, sink));
    for (std::size_t at = 0; at < sink.bytes().size(); at += 1 + at / 7) {
      std::vector<std::byte> damaged(sink.bytes().begin(), sink.bytes().end());
      damaged[at] ^= std::byte{0x11};
      ByteSource in(damaged, "damaged");
      try {
        EXPECT_NE(type.decode(in), nullptr);
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::kBadInput) << type.name << " at " << at << ": " << error.what();
      }
    }
    const std::string file = save(type.name, *built);
    for (std::size_t at = 0; at < file.size(); at += 1 + at / 37) {
      EXPECT_TRUE(refused(file.substr(0, at))) << type.name << " cut at " << at;
      std::string altered = file;
      altered[at] = static_cast<char>(altered[at] ^ 0x10);
      EXPECT_TRUE(refused(altered)) << type.name << " altered at " << at;
    }
    EXPECT_TRUE(refused(file + "x"));
  }
}

TEST_F(SavedFile, ForeignFilesAreRefused) {
  EXPECT_TRUE(refused(""));
  EXPECT_TRUE(refused("II*\0 a TIFF, or a text"));
  EXPECT_TRUE(refused(std::string(5000, '\xFF')));
  EXPECT_THROW(load_representation(path_), Error);  // there is none yet
  EXPECT_THROW(load_representation(folder_.path()), Error);
}

TEST_F(SavedFile, ClaimsThatCannotBeAreRefused) {
  const std::string file = save("heightmap", *build("heightmap", from_heights(2, 2, {1, 2, 3, 4})));
  ASSERT_FALSE(refused(resealed(file)));
  const std::size_t sizes = 8 + 4 + 4 + 16 + 1;
  for (const std::uint64_t claim :
       {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
    std::string larger = file;
    std::memcpy(larger.data() + sizes, &claim, sizeof claim);
    EXPECT_TRUE(refused(resealed(larger))) << "unpacked " << claim;
    larger = file;
    std::memcpy(larger.data() + sizes + 8, &claim, sizeof claim);
    EXPECT_TRUE(refused(resealed(larger))) << "packed " << claim;
  }
  std::string other = file;
  other[8] = 99;
  EXPECT_TRUE(refused(resealed(other)));  // format version
  other = file;
  other[16] = 'H';
  EXPECT_TRUE(refused(resealed(other)));  // type
  other = file;
  other[sizes - 1] = 2;
  EXPECT_TRUE(refused(resealed(other)));  // form
}

TEST_F(SavedFile, AnUnwritablePlaceIsAnError) {
  const auto built = build("heightmap", from_heights(2, 2, {1, 2, 3, 4}));
  EXPECT_THROW(save_representation("/proc/none/file.tb", representation("heightmap"), *built), Error);
}

// Damage that the structure's own reader must detect: checksums only detect accidents.
TEST(SavedStructure, OfImpossibleContentIsRefused) {
  for (const RepresentationType& type : representations()) {
    const auto built = build(type.name, random_boxes(8, 12, 20, 3), 12);
    const std::vector<std::byte> good = saved(*built);
    for (std::size_t at = 0; at < 12; at += 4) {
      for (const std::int32_t size : {0, -1, 1 << 30, 40000}) {
        std::vector<std::byte> bad = good;
        if (at == 8 && (type.name == "heightmap" || type.name == "drill" || type.name == "ght" ||
                        type.name == "tin" || type.name == "procedural_mesh")) {
          continue;  // a position, a cell's size or a number of levels
        }
        std::memcpy(bad.data() + at, &size, sizeof size);
        ByteSource in(bad, "memory");
        bool refused = false;
        try {
          type.load(in);
          refused = in.left() > 0;
        } catch (const Error& error) {
          refused = error.code() == ExitCode::kBadInput;
        }
        // A sparse tree is no longer for a wider grid, nor a stack for a higher one: 40000 is possible there.
        if (size != 40000 || type.name == "dense_voxel" || (at != 8 && type.name != "voxel")) {
          EXPECT_TRUE(refused) << type.name << ' ' << at << ' ' << size;
        }
      }
    }
    for (std::size_t length = 0; length < good.size(); length += 1 + good.size() / 50) {
      ByteSource in(std::span<const std::byte>(good).first(length), "memory");
      EXPECT_THROW(type.load(in), Error) << type.name << ' ' << length;
    }
  }
}

}  // namespace
}  // namespace terrabench::test
