// Loads saved grounded heightmap trees without the container's checksum: any bytes are refused, or load to a
// tree that can be queried, inspected and meshed, and that saves to bytes that load to the same tree.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>

#include "representations/ght/ght.h"
#include "representations/ght/invariants.h"
#include "terrain/error.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace terrabench;

Heightfield ground(int n) {
  Heightfield field{n, n, 1, 1, {}, {}};
  for (int k = 0; k < n * n; ++k) {
    field.heights.push_back(10 + 3 * std::sin(0.4F * static_cast<float>(k % n)) +
                            0.1F * static_cast<float>(k * 7919 % 7));
  }
  return field;
}

// A ridge for a tunnel.
Heightfield ridge() {
  constexpr int kSide = 33;
  Heightfield field{kSide, kSide, 1, 1, {}, {}};
  for (int k = 0; k < kSide * kSide; ++k) {
    field.heights.push_back(20 - 2 * std::max(0.0F, std::abs(static_cast<float>(k % kSide) - 16) - 4));
  }
  return field;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ByteSource in(std::as_bytes(std::span(data, size)), "fuzz");
  std::unique_ptr<Representation> loaded;
  try {
    loaded = Ght::load(in);
  } catch (const Error& error) {
    if (error.code() != ExitCode::kBadInput) throw;
    return 0;
  }
  const auto& tree = dynamic_cast<const Ght&>(*loaded);
  (void)ght::broken_invariants(tree.model());  // a file may break any of them
  if (ght::census(tree.model()).nodes == 0 || tree.memory().total() == 0) std::abort();
  const Bounds bounds = tree.bounds();
  std::vector<float> x, z;
  for (int k = 0; k < 64; ++k) {
    x.push_back(std::lerp(bounds.low.x, bounds.high.x, static_cast<float>(k % 8) / 7));
    z.push_back(std::lerp(bounds.low.z, bounds.high.z, static_cast<float>(k / 8) / 7));
  }
  SpanSink sink;
  tree.spans({x, z}, sink);
  if (sink.columns() != x.size()) std::abort();
  (void)tree.mesh({});
  ByteSink saved, twice;
  tree.save(saved);
  ByteSource again(saved.bytes(), "saved again");
  Ght::load(again)->save(twice);
  if (again.left() != 0 || !std::ranges::equal(saved.bytes(), twice.bytes())) std::abort();
  return 0;
}

FuzzSeeds fuzz_seeds() {
  using namespace terrabench::events;
  const std::vector<std::vector<Event>> sequences = {
      {},
      {RadialErosion{{8, 10, 8}, {3, 2, 3}}},
      {LinearErosion{{7, 7}, {10, 9}, 1, 40}, RadialErosion{{9, 10, 9}, {4, 3, 3}}},
      {DipFault{true, {6, 7}, {11, 9}, 3, 1, 50}},
      {LateralFault{{6, 7}, {11, 9}, 3, 2}, DipFault{false, {5, 8}, {11, 8}, 3, 1, 60}}};
  FuzzSeeds seeds;
  const auto add = [&](const Heightfield& field, std::span<const Event> sequence) {
    Ght tree(ght::SampleGrid{field.width, field.depth, 1, 1, 0, 0}, field.heights, -10);
    for (const Event& event : sequence) tree.apply(event);
    ByteSink sink;
    tree.save(sink);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(sink.bytes().data());
    seeds.emplace_back(bytes, bytes + sink.bytes().size());
  };
  for (const std::vector<Event>& sequence : sequences) add(ground(18), sequence);
  Carving tunnel;
  tunnel.from = {11, 12, 16};
  tunnel.to = {21, 12, 16};
  tunnel.section = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};
  add(ridge(), std::vector<Event>{DipFault{false, {12, 25}, {20, 25}, 4, 1, 60}, tunnel});
  return seeds;
}
