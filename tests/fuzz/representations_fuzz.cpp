// Saved structures: the container, and each type's own reader, which mutations rarely reach behind the
// container's checksum. Any bytes are refused, or load to a structure that can be queried, inspected, meshed
// and edited, and that saves to bytes that load to the same.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <span>

#include "representations/ght/ght.h"
#include "representations/ght/invariants.h"
#include "representations/line_grid.h"
#include "representations/procedural_mesh/model_terrain.h"
#include "representations/representation.h"
#include "terrain/error.h"
#include "terrain/events/evaluate.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace terrabench;

// The first byte of an input: a type's own reader, that of its encoded form, or the container.
constexpr std::uint8_t kEncoded = 128, kContainer = 255;

std::vector<std::byte> saved(const Representation& structure) {
  ByteSink sink;
  structure.save(sink);
  return {sink.bytes().begin(), sink.bytes().end()};
}

void use(const RepresentationType& type, Representation& structure) {
  const Bounds bounds = structure.bounds();
  const std::array x{bounds.low.x, bounds.high.x, 0.5F * (bounds.low.x + bounds.high.x)};
  const std::array y{bounds.low.y, bounds.high.y, 0.5F * (bounds.low.y + bounds.high.y)};
  const std::array z{bounds.low.z, bounds.high.z, 0.5F * (bounds.low.z + bounds.high.z)};
  SpanSink sink;
  structure.spans({x, z}, sink);
  std::array<Material, 3> materials;
  structure.materials({x, y, z}, materials);
  if (sink.columns() != x.size() || structure.memory().total() == 0) std::abort();
  for (const Span& span : sink.all()) {
    if (std::isinf(span.top)) std::abort();
  }
  (void)structure.mesh({});
  if (const auto* const tree = dynamic_cast<const Ght*>(&structure)) {
    (void)ght::broken_invariants(tree->model());  // a file may break any of them
  }
  // An edit of a TIN looks at all samples of the triangles it changes, of which two may have billions.
  const LineGrid lines = structure.lines();
  if (type.traits.editable && y[0] < y[1] && std::int64_t{lines.width} * lines.depth < 1 << 22) {
    structure.edit({std::span(x).first(1), std::span(z).first(1)},
                   std::array{Span{y[0], y[1], Material::kBedrock}});
  }
  const std::vector<std::byte> first = saved(structure);
  ByteSource again(first, "saved again");
  if (saved(*type.load(again)) != first || again.left() != 0) std::abort();
}

// A ridge under faults and a tunnel.
TerrainSource sculpted() {
  using namespace events;
  constexpr int kSide = 33;
  Heightfield field = Heightfield::zeros(kSide, kSide);
  for (int k = 0; k < kSide * kSide; ++k) {
    field.heights[static_cast<std::size_t>(k)] =
        20 - 2 * std::max(0.0F, std::abs(static_cast<float>(k % kSide) - 16) - 4);
  }
  Carving tunnel;
  tunnel.from = {11, 12, 16};
  tunnel.to = {21, 12, 16};
  tunnel.section = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};
  TerrainSource source = source_of("sculpted", field);
  source.events = std::make_shared<const Sculpture>(
      Sculpture{field,
                {DipFault{false, {12, 25}, {20, 25}, 4, 1, 60}, tunnel, LateralFault{{13, 6}, {18, 8}, 3, 2},
                 DipFault{true, {13, 10}, {18, 10}, 2, 1, 50}}});
  return source;
}

// A plain under both kinds of erosion.
TerrainSource eroded() {
  using namespace events;
  const Heightfield field{18, 18, 1, 1, std::vector<float>(18 * 18, 10), {}};
  TerrainSource source = source_of("eroded", field);
  source.events = std::make_shared<const Sculpture>(
      Sculpture{field, {LinearErosion{{7, 7}, {10, 9}, 1, 40}, RadialErosion{{9, 10, 9}, {4, 3, 3}}}});
  return source;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto bytes = std::as_bytes(std::span(data + 1, size - 1));
  Loaded loaded;
  try {
    if (data[0] == kContainer) {
      loaded = load_representation(bytes, "fuzz");
    } else {
      loaded.type = &representations()[data[0] % kEncoded % representations().size()];
      ByteSource in(bytes, "fuzz");
      loaded.representation = data[0] < kEncoded ? loaded.type->load(in) : loaded.type->decode(in);
    }
  } catch (const Error& error) {
    if (error.code() != ExitCode::kBadInput) throw;
    return 0;
  }
  use(*loaded.type, *loaded.representation);
  return 0;
}

FuzzSeeds fuzz_seeds() {
  TerrainSource boxes, heights;
  boxes.name = heights.name = "seed";
  boxes.solid = Solid{{{0, 0, 0}, {20, 40, 20}}, "", [](const ColumnSamples& at, std::span<Material> out) {
                        for (std::size_t i = 0; i < out.size(); ++i) {
                          const auto layer = static_cast<int>(i) / (2 + static_cast<int>(at.x + at.z) / 4);
                          out[i] = static_cast<Material>(layer < 6 ? layer % 3 : 0);
                        }
                      }};
  heights.heights = Heightfield{3, 2, 10, 20, {1, 2, 3, 4, Heightfield::kNoData, 6}, {}};
  // A saved model holds its text, which is expanded while loading: a small one, so that most damage stays
  // small.
  TerrainSource model =
      model_on_ground("[limits]\nfaces = 500\n[base]\nshape = \"cube\"\n[[step]]\nsubdivide = 1\n", "model",
                      source_of("ground", Heightfield::zeros(3, 3, 2, 2)), std::nullopt);
  TerrainSource holes = heights;
  holes.heights = Heightfield{24, 26, 30, 20, {}, {}};
  for (int i = 0; i < 24 * 26; ++i) {
    holes.heights->heights.push_back(i % 41 == 17 ? Heightfield::kNoData : static_cast<float>(i * 7919 % 97));
  }
  TerrainSource events = sculpted(), erosions = eroded();
  FuzzSeeds seeds;
  Progress progress;
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  for (std::size_t t = 0; t < representations().size(); ++t) {
    const RepresentationType& type = representations()[t];
    for (const TerrainSource* source : {&boxes, &heights, &holes, &events, &erosions, &model}) {
      Parameters parameters(type.parameters);
      parameters.set("resolution", std::int64_t{source == &boxes ? 40 : source == &model ? 8 : 0});
      for (const char* name : {"w", "tau"}) {
        if (parameters.has(name)) parameters.set(name, std::int64_t{1});
      }
      for (const char* name : {"adaptive_k", "interpolate_untouched"}) {
        if (source == &holes && parameters.has(name)) parameters.set(name, true);
      }
      const auto built = type.build(*source, parameters, progress);
      for (const std::uint8_t form : {std::uint8_t{0}, kEncoded}) {
        ByteSink sink;
        if (form == 0)
          built->save(sink);
        else
          built->encode(0.5, sink);
        const auto* own = reinterpret_cast<const std::uint8_t*>(sink.bytes().data());
        seeds.emplace_back(1, static_cast<std::uint8_t>(t + form))
            .insert(seeds.back().end(), own, own + sink.bytes().size());
      }
      const std::filesystem::path path = folder / ("terrabench_fuzz_seed_" + std::to_string(getpid()));
      save_representation(path, type, *built);
      const std::string file = read_file(path);
      std::filesystem::remove(path);
      seeds.emplace_back(1, kContainer).insert(seeds.back().end(), file.begin(), file.end());
    }
  }
  return seeds;
}
