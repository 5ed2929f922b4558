#include "lod/hybrid/chunk_layout.h"

#include <fmt/format.h>

#include <cmath>

#include "terrain/error.h"

namespace terrabench::hybrid {
namespace {

// Chunks and heights compute the same places with different roundings.
constexpr double kRounding = 1e-3;  // samples

int whole_samples(double metres, double cell, const char* what) {
  const double samples = metres / cell, whole = std::round(samples);
  if (std::isfinite(samples) && std::abs(whole) < 1e9 && std::abs(samples - whole) <= kRounding) {
    return static_cast<int>(whole);
  }
  throw usage_error(fmt::format("{} is {} m, which is not a whole number of the heights' cells of {} m", what,
                                metres, cell),
                    "near surface", "choose heights whose samples lie at the corners of all chunks");
}

}  // namespace

ChunkLayout layout_of(const MeshChunks& surface, const Heightfield& heights) {
  const Bounds bounds = surface.bounds();
  const double side = static_cast<double>(surface.cell()) * surface.cells();
  ChunkLayout layout;
  layout.side = whole_samples(side, heights.cell_x, "a chunk's side");
  if (layout.side < 1 || layout.side != whole_samples(side, heights.cell_z, "a chunk's side")) {
    throw usage_error(fmt::format("a chunk's side is {} m and the heights' cells are {} × {} m", side,
                                  heights.cell_x, heights.cell_z),
                      "near surface", "choose square cells that are no larger than a chunk");
  }
  layout.first = {whole_samples(bounds.low.x, heights.cell_x, "the surface's western border"),
                  whole_samples(bounds.low.z, heights.cell_z, "the surface's northern border")};
  const auto along = [&](int axis, double extent, double cell, int samples, int chunks) {
    const auto inside = static_cast<int>(std::floor(extent / cell + kRounding)) / layout.side;
    const int on_ground = (samples - 1 - layout.first[axis]) / layout.side;
    return layout.first[axis] < 0 ? 0 : std::min({inside, on_ground, chunks});
  };
  const glm::vec3 size = bounds.size();
  layout.chunks = {along(0, size.x, heights.cell_x, heights.width, surface.chunks().x),
                   along(1, size.z, heights.cell_z, heights.depth, surface.chunks().y)};
  if (layout.chunks.x < 1 || layout.chunks.y < 1) {
    throw usage_error(
        fmt::format("no chunk of {} × {} samples from sample ({}, {}) on lies on a ground of {} × {}",
                    layout.side, layout.side, layout.first.x, layout.first.y, heights.width, heights.depth),
        "near surface", "choose heights that reach beyond the near surface, or smaller chunks");
  }
  layout.last = layout.first + layout.side * layout.chunks;
  return layout;
}

}  // namespace terrabench::hybrid
