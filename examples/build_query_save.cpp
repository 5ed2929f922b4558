// Builds a representation, asks it for spans, prints its memory and saves it: build_query_save [TERRAIN
// [METHOD]]. TERRAIN is a catalogue name or the path of any DEM that GDAL opens, METHOD a name of `terrabench
// list representations`.
#include <fmt/core.h>

#include <filesystem>

#include "representations/representation.h"
#include "terrain/error.h"

using namespace terrabench;

namespace {

// All spans along the line from west to east through the middle of the ground, at n columns.
SpanSink cross_section(const Representation& ground, int n) {
  const Bounds bounds = ground.bounds();
  std::vector<float> x, z(static_cast<std::size_t>(n), 0.5F * (bounds.low.z + bounds.high.z));
  for (int i = 0; i < n; ++i) {
    x.push_back(bounds.low.x + bounds.size().x * (static_cast<float>(i) + 0.5F) / static_cast<float>(n));
  }
  SpanSink sink;
  ground.spans({x, z}, sink);
  return sink;
}

}  // namespace

int main(int argc, char** argv) try {
  const TerrainSource source = open_terrain(argc > 1 ? argv[1] : "caves");
  const RepresentationType& type = representation(argc > 2 ? argv[2] : "layered_stack");
  Progress progress;
  const auto ground = type.build(source, Parameters(type.parameters), progress);

  const SpanSink section = cross_section(*ground, 400);
  fmt::print("column 200 of {} as {}:\n", source.name, type.name);
  for (const Span& span : section.column(200)) {
    fmt::print("  {:8.2f} m to {:8.2f} m, material {}\n", span.bottom, span.top,
               static_cast<int>(span.material));
  }
  const Memory memory = ground->memory();
  fmt::print("memory: {} bytes of payload, {} of index, {} of slack\n", memory.payload, memory.index,
             memory.slack);

  const std::filesystem::path file = "ground.tb";
  fmt::print("{}: {} bytes\n", file.string(), save_representation(file, type, *ground));
  const Loaded loaded = load_representation(file);
  const SpanSink again = cross_section(*loaded.representation, 400);
  const bool equal = std::ranges::equal(again.all(), section.all());
  fmt::print("loaded again: {} spans, {}\n", again.all().size(), equal ? "equal" : "NOT equal");
  return equal ? 0 : 1;
} catch (const Error& error) {
  fmt::print(stderr, "{}\n  {}\n", error.what(), error.advice());
  return static_cast<int>(error.code());
}
