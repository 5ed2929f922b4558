// Figure 2 of "ght": a triangulated irregular network of real mountains.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/figures/views.h"
#include "experiments/ght/figures.h"
#include "terrain/tin/greedy_insertion.h"
#include "terrain/tin/triangle_plane.h"

namespace terrabench::ght {
namespace {

using namespace figures;

// How closely the network keeps the samples, and whether its vertices lie where the ground is rough: their
// share in the rougher half of 8 × 8 blocks.
void record_network(const Heightfield& field, const tin::Approximation& network, float error,
                    Drawing& drawing) {
  constexpr int kBlocks = 8;
  std::array<std::pair<double, int>, kBlocks * kBlocks> blocks{};  // roughness, vertices
  const auto block = [&](int i, int j) -> std::pair<double, int>& {
    return blocks[static_cast<std::size_t>(j * kBlocks / field.depth * kBlocks + i * kBlocks / field.width)];
  };
  for (int j = 1; j + 1 < field.depth; ++j) {
    for (int i = 1; i + 1 < field.width; ++i) {
      block(i, j).first += std::abs(field.at(i - 1, j) + field.at(i + 1, j) + field.at(i, j - 1) +
                                    field.at(i, j + 1) - 4 * field.at(i, j));
    }
  }
  for (const tin::Sample s : network.surface.vertices()) ++block(s.i, s.j).second;
  std::ranges::sort(blocks);
  double rougher = 0, all = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    all += blocks[b].second;
    rougher += b >= blocks.size() / 2 ? blocks[b].second : 0;
  }
  double largest = 0;
  for (int j = 0; j < field.depth; ++j) {
    std::uint32_t near = 0;
    for (int i = 0; i < field.width; ++i) {
      const tin::Sample s{static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j)};
      near = network.surface.locate(s, near);
      const tin::Triangle& t = network.surface.triangles()[near];
      const tin::Plane plane(
          {network.surface.vertex(t, 0), network.surface.vertex(t, 1), network.surface.vertex(t, 2)},
          {network.heights[t.vertex[0]], network.heights[t.vertex[1]], network.heights[t.vertex[2]]});
      largest = std::max(largest, std::abs(plane(i, j) - field.at(i, j)));
    }
  }
  drawing.record("vertices", all);
  drawing.record("error_of_allowed", largest / error);
  drawing.record("in_rougher_half", rougher / all);
}

}  // namespace

Sheet draw_network(Drawing& drawing) {
  const TerrainSource source =
      open_terrain("jacksboro");  // plains, slopes and valleys; a fractal is rough all over
  const Heightfield& field = *source.heights;
  const HeightRange range = height_range(field);
  const float error = 0.03F * (range.highest - range.lowest);
  Progress silent;
  const tin::Approximation network = tin::greedy_insertion(field, error, silent);
  TriangleMesh mesh;
  for (std::size_t v = 0; v < network.heights.size(); ++v) {
    const tin::Sample at = network.surface.vertices()[v];
    mesh.positions.emplace_back(static_cast<float>(at.i) * field.cell_x, network.heights[v],
                                static_cast<float>(at.j) * field.cell_z);
  }
  for (const tin::Triangle& t : network.surface.triangles())
    mesh.indices.insert(mesh.indices.end(), {t.vertex[0], t.vertex[2], t.vertex[1]});
  record_network(field, network, error, drawing);
  Scene scene;
  scene.meshes.push_back(wired(mesh, {}, 1.2F));
  const auto seen = [&](const Look& look) {
    return render_scene(drawing.gl(), scene, look.at(bounds_of(mesh)));
  };
  const Image above = seen({.from = {0, 1, 1e-3F}, .width = 774, .height = 774}),
              beside = seen({.width = 1120, .height = 774});
  return panel_sheet(
      {{{above, fmt::format("{} of {} samples, in plan", network.heights.size(), field.heights.size())},
        {beside, "seen from the south-east"}}},
      kSpaceStyle);
}

}  // namespace terrabench::ght
