// Coded drills, which have no checksum of their own: any bytes are refused or decode to drills that
// regenerate and that encode to bytes that decode to the same.
#include <cmath>
#include <cstdlib>
#include <span>

#include "representations/drill/drill_codec.h"
#include "representations/drill/extract.h"
#include "representations/drill/quantum.h"
#include "representations/drill/regenerate.h"
#include "terrain/error.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace terrabench;

constexpr std::size_t kMostPixels = 1 << 20;  // larger terrains take long and show nothing new

bool same(const Drills& a, const Drills& b) {
  return a.pixel == b.pixel && a.elevation == b.elevation && a.slope == b.slope &&
         a.curvature == b.curvature && a.influence == b.influence && a.holes == b.holes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  ByteSource in(bytes, "fuzz");
  Drills drills;
  try {
    drills = decode_drills(in);
  } catch (const Error& error) {
    if (error.code() != ExitCode::kBadInput) throw;
    return 0;
  }
  ByteSink sink;
  encode_drills(drills, sink);
  ByteSource again(sink.bytes(), "encoded again");
  if (!same(decode_drills(again), drills)) std::abort();
  if (drills.pixels() > kMostPixels) return 0;
  for (const float h : regenerate(drills).heights) {
    if (std::isinf(h)) std::abort();
  }
  return 0;
}

FuzzSeeds fuzz_seeds() {
  FuzzSeeds seeds;
  for (const int size : {1, 5, 24}) {
    Heightfield field{size, size + 2, 30, 20, {}, {}};
    for (int i = 0; i < size * (size + 2); ++i) {
      field.heights.push_back(i % 41 == 17 ? Heightfield::kNoData : static_cast<float>(i * 7919 % 97));
    }
    for (const bool all : {false, true}) {
      DrillOptions options;
      options.tau = 2;
      options.w = 1;
      options.k = 3;
      options.fit = all ? DrillFit::kPrinted : DrillFit::kVertex;
      options.adaptive_k = options.interpolate_untouched = all;
      Drills drills = extract_drills(field, route_flow(field), options);
      quantise(drills, 0.5F);
      ByteSink sink;
      encode_drills(drills, sink);
      const auto* bytes = reinterpret_cast<const std::uint8_t*>(sink.bytes().data());
      seeds.emplace_back(bytes, bytes + sink.bytes().size());
    }
  }
  return seeds;
}
