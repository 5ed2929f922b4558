// Range coder and drills as bytes: the output is the input, and other bytes are refused.
#include "representations/drill/drill_codec.h"

#include <functional>

#include "representations/coding/range_coder.h"
#include "representations/drill/extract.h"
#include "representations/drill/pits.h"
#include "representations/drill/quantum.h"
#include "representations/drill/regenerate.h"
#include "terrain/memory.h"
#include "tests/representations/drill_ground.h"
#include "tests/terrain/errors.h"

namespace terrabench::test {
namespace {

std::vector<std::byte> encoded(const Drills& drills) {
  ByteSink sink;
  encode_drills(drills, sink);
  return {sink.bytes().begin(), sink.bytes().end()};
}

Drills decoded(std::span<const std::byte> bytes) {
  ByteSource source(bytes, "memory");
  Drills drills = decode_drills(source);
  EXPECT_EQ(source.left(), 0U);
  return drills;
}

TEST(RangeCoder, GivesBackWhatItWasGiven) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    std::mt19937 random(seed);
    std::vector<std::int32_t> numbers;
    for (int i = 0; i < 20000; ++i) {
      const auto size = random() % (seed * 10);
      const auto magnitude = static_cast<std::int32_t>(random() & ((1U << size) - 1));
      numbers.push_back(random() % 2 == 0 ? magnitude : -magnitude);
    }
    numbers.insert(numbers.end(), {0, 1, -1, 2147483647, -2147483647});
    RangeEncoder encoder;
    NumberModel written, read;
    SymbolModel<7> symbols_written, symbols_read;
    for (const std::int32_t n : numbers) {
      written.code(encoder, n);
      symbols_written.code(encoder, static_cast<std::uint32_t>(n) & 127U);
    }
    const std::vector<std::byte> bytes = encoder.finish();
    const ByteSource source(bytes, "memory");
    RangeDecoder decoder(bytes, source);
    for (const std::int32_t n : numbers) {
      ASSERT_EQ(read.code(decoder, 0), n);
      ASSERT_EQ(symbols_read.code(decoder, 0), static_cast<std::uint32_t>(n) & 127U);
    }
    EXPECT_TRUE(decoder.at_end());
  }
}

// Long runs of sure bits move the carry through many pending bytes.
TEST(RangeCoder, CarriesThroughLongRuns) {
  for (const unsigned rare : {50U, 1000U, 30000U}) {
    std::mt19937 random(rare);
    std::vector<bool> bits;
    for (int i = 0; i < 300000; ++i) bits.push_back(random() % rare == 0);
    RangeEncoder encoder;
    BitModel written, read;
    for (const bool bit : bits) encoder.bit(written, bit);
    const std::vector<std::byte> bytes = encoder.finish();
    EXPECT_LT(bytes.size(), 300000 / 8 / 4);
    const ByteSource source(bytes, "memory");
    RangeDecoder decoder(bytes, source);
    for (const bool bit : bits) ASSERT_EQ(decoder.bit(read), bit);
  }
}

TEST(RangeCoder, CostsAboutTheEntropy) {
  std::mt19937 random(1);
  RangeEncoder encoder;
  BitModel model;
  for (int i = 0; i < 200000; ++i) encoder.bit(model, random() % 10 == 0);
  EXPECT_NEAR(static_cast<double>(encoder.finish().size()) * 8 / 200000, 0.469, 0.469 * 0.04);
}

TEST(RangeCoder, FailsPastTheEnd) {
  const std::vector<std::byte> nothing;
  const ByteSource source(nothing, "memory");
  EXPECT_EQ(failure_of([&] { RangeDecoder(nothing, source); }).code, ExitCode::kBadInput);
  const std::vector<std::byte> few(6);
  const ByteSource other(few, "memory");
  RangeDecoder decoder(few, other);
  EXPECT_FALSE(decoder.at_end());
  EXPECT_EQ(failure_of([&] { decoder.even_bits(32); }).code, ExitCode::kBadInput);
}

TEST(DrillCodec, GivesBackEveryBit) {
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
    const Heightfield field = hills(90, 70, seed, seed % 2 == 0, seed % 3 == 0 ? 4U : 0U);
    for (const std::uint32_t tau : {1U, 10U, 200U, 1000000U}) {
      DrillOptions options;
      options.tau = tau;
      options.fit = seed == 4 ? DrillFit::kPrinted : seed == 3 ? DrillFit::kVertex : DrillFit::kMonotone;
      options.adaptive_k = seed == 5;
      options.interpolate_untouched = seed == 2;
      Drills drills = drill(field, options);
      quantise(drills, seed == 1 ? 0.3F : 0.5F);
      EXPECT_TRUE(decoded(encoded(drills)) == drills) << seed << " tau " << tau;
    }
  }
}

TEST(DrillCodec, OfTheSmallestTerrains) {
  DrillOptions options;
  options.tau = 1;
  options.w = 1;
  for (const Heightfield& field :
       {Heightfield{1, 1, 10, 10, {7}, {}}, Heightfield{1, 4, 10, 10, {3, 1, 4, 1}, {}},
        Heightfield{4, 1, 10, 10, {3, 1, 4, Heightfield::kNoData}, {}}}) {
    Drills drills = drill(field, options);
    quantise(drills, 0.25F);
    EXPECT_TRUE(decoded(encoded(drills)) == drills);
  }
}

TEST(DrillCodec, RoundsWithinTheQuantumAndOnlyOnce) {
  const Heightfield field = hills(60, 60, 3);
  const Drills exact = drill(field, {});
  for (const float quantum : {0.01F, 0.5F, 3.0F}) {
    Drills drills = exact;
    quantise(drills, quantum);
    for (std::size_t i = 0; i < exact.count(); ++i) {
      ASSERT_NEAR(drills.elevation[i], exact.elevation[i], 0.501 * quantum);
      ASSERT_NEAR(drills.slope[i], exact.slope[i], 0.501 * quantum / 8);  // w = 10
      ASSERT_NEAR(drills.curvature[i], exact.curvature[i], 0.501 * quantum / 64);
    }
    Drills twice = drills;
    quantise(twice, quantum);
    EXPECT_TRUE(twice == drills);
  }
}

TEST(DrillCodec, RoundingKeepsProfilesMonotone) {
  const Heightfield field = hills(100, 80, 6);
  DrillOptions options;
  options.tau = 12;
  options.monotone_profiles = true;
  Drills drills = drill(field, options);
  quantise(drills, 5);
  EXPECT_EQ(count_pits(regenerate(drills)), 0U);
}

TEST(DrillCodec, CoarserIsSmallerAndAllAreFarSmallerThanPlainNumbers) {
  DrillOptions options;
  options.tau = 10;
  const Drills drills = drill(hills(200, 200, 5), options);
  std::size_t before = drills.count() * 4 * sizeof(float);
  for (const float quantum : {0.02F, 0.2F, 2.0F, 10.0F}) {
    Drills rounded = drills;
    quantise(rounded, quantum);
    const std::size_t bytes = encoded(rounded).size();
    EXPECT_LT(bytes, before);
    before = bytes;
  }
  EXPECT_LT(before, drills.count() * 2);
}

TEST(DrillCodec, ShapesWithTheirVertexAtThePixelHaveNoSlopeInTheFile) {
  DrillOptions options;
  options.tau = 10;
  const Heightfield field = hills(90, 70, 5);
  Drills full = drill(field, options);
  options.fit = DrillFit::kVertex;
  Drills four = drill(field, options);
  for (Drills* drills : {&full, &four}) quantise(*drills, 0.5F);
  EXPECT_LT(static_cast<double>(encoded(four).size()), 0.85 * static_cast<double>(encoded(full).size()));
  EXPECT_TRUE(decoded(encoded(four)) == four);
  four.slope.back() = full.slope.back() + 1;  // a single slope is kept
  quantise(four, 0.5F);
  EXPECT_TRUE(decoded(encoded(four)) == four);
}

TEST(DrillCodec, RefusesQuantaThatMakeNoSense) {
  const Drills drills = drill(hills(30, 30, 1), {});
  for (const float quantum : {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(), 1e-7F, 1e30F}) {
    Drills copy = drills;
    EXPECT_EQ(failure_of([&] { quantise(copy, quantum); }).code, ExitCode::kUsage) << quantum;
  }
}

TEST(DrillCodec, AutomaticQuantumSuitsTheHeights) {
  Heightfield field = hills(30, 30, 1);
  EXPECT_EQ(automatic_quantum(field), 1);  // a range of about 400 m
  for (float& h : field.heights) h *= 1e-3F;
  EXPECT_LT(automatic_quantum(field), 0.002F);
  for (float& h : field.heights) h = 1e6F;
  Drills flat = drill(field, {});
  quantise(flat, automatic_quantum(field));
  EXPECT_EQ(flat.plateau, 1e6F);
  field.heights.assign(field.heights.size(), 0);
  EXPECT_GT(automatic_quantum(field), 0);
}

TEST(DrillCodec, CutBytesAreRefusedAndAlteredOnesNeverCrash) {
  DrillOptions options;
  options.tau = 10;
  Drills drills = drill(hills(40, 40, 2, false, 3), options);
  quantise(drills, 1);
  const std::vector<std::byte> good = encoded(drills);
  for (std::size_t size = 0; size < good.size(); size += 1 + size / 50) {
    const auto part = std::span(good).first(size);
    ByteSource source(part, "memory");
    EXPECT_EQ(failure_of([&] { decode_drills(source); }).code, ExitCode::kBadInput) << size;
  }
  std::mt19937 random(1);
  std::size_t refused = 0;
  for (int round = 0; round < 3000; ++round) {
    std::vector<std::byte> bad = good;
    for (unsigned n = 1 + random() % 4; n > 0; --n)
      bad[12 + random() % (bad.size() - 12)] = std::byte(random());
    ByteSource source(bad, "memory");
    try {
      const Drills got = decode_drills(source);
      for (std::size_t i = 0; i < got.count(); ++i) {
        ASSERT_LT(got.pixel[i], got.pixels());
        ASSERT_TRUE(std::isfinite(got.elevation[i]) && std::isfinite(got.slope[i]) &&
                    std::isfinite(got.curvature[i]));
        ASSERT_LE(got.influence_of(i), got.k);
      }
      for (const float h : regenerate(got).heights) ASSERT_FALSE(std::isinf(h));
    } catch (const Error& error) {
      ASSERT_EQ(error.code(), ExitCode::kBadInput);
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000U);
}

// A few bytes can stand for millions of drills, and a damaged file may claim the largest terrain.
TEST(DrillCodec, AlteredBytesOfTheLargestTerrainTakeLittleMemory) {
  ByteSink head;
  for (const int size : {1 << 14, 1 << 14}) head.put(size);
  for (const float metres : {30.0F, 30.0F, 1000.0F, 1.0F}) head.put(metres);
  for (const int small : {10, 10, 0, 0}) head.put(static_cast<std::uint8_t>(small));
  head.put(std::uint64_t{1} << 16);
  for (unsigned seed = 0; seed < 12; ++seed) {
    std::mt19937 random(seed);
    std::vector<std::byte> bytes(head.bytes().begin(), head.bytes().end());
    bytes.resize(bytes.size() + (std::size_t{1} << 16));
    // No holes, one outlet or several: leading zeros are small numbers.
    for (std::size_t i = head.bytes().size() + 1 + seed % 3; i < bytes.size(); ++i) {
      bytes[i] = std::byte(random());
    }
    ByteSource source(bytes, "memory");
    HeapCounter::reset_peak();
    const std::int64_t before = HeapCounter::live();
    EXPECT_EQ(failure_of([&] { decode_drills(source); }).code, ExitCode::kBadInput) << seed;
    EXPECT_LT(HeapCounter::peak() - before, 48 << 20) << seed;
  }
}

TEST(DrillCodec, MeasuresThatCannotBeAreRefused) {
  Drills drills = drill(hills(20, 20, 2), {});
  quantise(drills, 1);
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(),
                  kInfinite = std::numeric_limits<float>::infinity();
  for (const auto& change : std::vector<std::function<void(Drills&)>>{
           [](Drills& d) { d.width = 0; }, [](Drills& d) { d.depth = -3; },
           [](Drills& d) { d.width = 1 << 20; }, [](Drills& d) { d.cell_x = kNaN; },
           [](Drills& d) { d.cell_z = 0; }, [](Drills& d) { d.plateau = kInfinite; },
           [](Drills& d) { d.plateau = kNaN; }}) {
    const std::vector<std::byte> good = encoded(drills);
    Drills other = drills;
    change(other);
    ByteSink head;
    head.put(other.width);
    head.put(other.depth);
    for (const float metres : {other.cell_x, other.cell_z, other.plateau}) head.put(metres);
    std::vector<std::byte> bad(head.bytes().begin(), head.bytes().end());
    bad.insert(bad.end(), good.begin() + static_cast<std::ptrdiff_t>(bad.size()), good.end());
    if (other.width == 1 << 20) bad[7] = std::byte{0x10};  // and as many rows
    ByteSource source(bad, "memory");
    EXPECT_EQ(failure_of([&] { decode_drills(source); }).code, ExitCode::kBadInput);
  }
}

}  // namespace
}  // namespace terrabench::test
