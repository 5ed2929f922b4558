#include "representations/ght/ght.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "representations/column_grid.h"
#include "representations/ght/ght_rays.h"
#include "representations/ght/invariants.h"
#include "representations/heightmap/heightmap.h"
#include "representations/line_grid.h"
#include "terrain/error.h"
#include "terrain/separators.h"

namespace terrabench {
namespace {

using namespace ght;

void check_room(std::size_t samples, const Parameters& parameters) {
  if (samples > static_cast<std::uint64_t>(parameters.integer("most_cells"))) {
    throw environment_error("the ground has more samples than most_cells", "grounded heightmap tree",
                            "lower resolution, or raise most_cells");
  }
}

std::unique_ptr<Ght> from_field(const Heightfield& field, const TerrainSource& source,
                                const Parameters& parameters) {
  check_heights(field, source.name);
  const auto resampled = at_resolution(field, parameters.integer("resolution"));
  const Heightfield& ground = resampled ? *resampled : field;
  require_cells(ground.width, ground.depth, source.name);
  check_room(static_cast<std::size_t>(ground.width) * static_cast<std::size_t>(ground.depth), parameters);
  const float cell = std::max(ground.cell_x, ground.cell_z);
  // The floor of the solid that the same events make, so that both contain the same ground.
  const float lowest = height_range(ground).lowest;
  const bool solid_is_deeper = source.solid && source.solid->bounds.low.y < lowest;
  const float floor = solid_is_deeper ? source.solid->bounds.low.y : lowest - cell;
  const SampleGrid grid = {ground.width, ground.depth, ground.cell_x, ground.cell_z, 0, 0};
  return std::make_unique<Ght>(grid, ground.heights, floor);
}

std::unique_ptr<Ght> from_solid(const TerrainSource& source, const Parameters& parameters,
                                Progress& progress) {
  const auto sampled = Heightmap::build(source, parameters, progress);
  const auto& map = static_cast<const Heightmap&>(*sampled);
  const HeightGrid& from = map.grid();
  require_cells(from.width, from.depth, source.name);
  check_room(map.heights().size(), parameters);
  const glm::vec2 spacing(from.cell_x, from.cell_z);
  const SampleGrid grid = {from.width, from.depth, spacing.x, spacing.y, from.origin_x, from.origin_z};
  return std::make_unique<Ght>(grid, std::vector<float>(map.heights().begin(), map.heights().end()),
                               from.bounds.low.y);
}

// Adds the solid spans between crossings, which are sorted from the top down.
void add_spans(std::span<const Crossing> crossings, float floor, std::vector<Span>& found, SpanSink& out) {
  found.clear();  // from the top
  const auto add = [&](float bottom, float top) {
    if (bottom >= top) return;
    if (!found.empty() && found.back().bottom <= top) {
      found.back().bottom = std::min(found.back().bottom, bottom);
    } else {
      found.push_back({bottom, top, Material::kBedrock});
    }
  };
  int depth = 0;
  float top = 0;
  for (const Crossing& c : crossings) {
    if (depth <= 0 && depth + c.weight > 0) top = c.y;
    if (depth > 0 && depth + c.weight <= 0) add(c.y, top);
    depth += c.weight;
  }
  if (depth > 0) add(floor, top);
  for (std::size_t i = found.size(); i > 0; --i) out.add(found[i - 1]);
}

constexpr std::size_t kAhead = 16;  // columns whose reads from memory overlap

// The squares of the columns from `first` on, with i = -1 outside the terrain, and their data on the way from
// memory.
void find_squares(const Model& model, Columns where, std::size_t first, std::array<Square, kAhead>& squares) {
  const std::size_t count = std::min(kAhead, where.size() - first);
  for (std::size_t k = 0; k < count; ++k) {
    if (!model.surface.find(where.x[first + k], where.z[first + k], squares[k])) squares[k] = {-1, -1};
  }
  for (const int step : {0, 1, 2}) {
    for (std::size_t k = 0; k < count; ++k) {
      if (squares[k].i < 0) continue;
      model.surface.prefetch(squares[k], step);
      if (step == 0) model.tree.prefetch(model.tree.root_cell(squares[k].i, squares[k].j));
    }
  }
}

}  // namespace

std::span<const ParameterSpec> Ght::parameters() {
  static const std::vector<ParameterSpec> kSpecs = column_parameters_and({
      {"events", true, "", "apply the terrain's events; if false, build its ground only"},
      {"most_cells", static_cast<std::int64_t>(Tree::kMostCells), "cells", "at most in the tree", 1,
       static_cast<double>(Tree::kMostCells)},
  });
  return kSpecs;
}

Ght::Ght(const SampleGrid& grid, std::vector<float> heights, float floor) {
  float highest = floor;
  for (const float h : heights) highest = std::fmax(highest, h);
  model_ = Model(Tree(grid, std::move(heights)), floor, highest);
}

std::unique_ptr<Representation> Ght::build(const TerrainSource& source, const Parameters& parameters,
                                           Progress& progress) {
  std::unique_ptr<Ght> built = source.events    ? from_field(source.events->ground, source, parameters)
                               : source.heights ? from_field(*source.heights, source, parameters)
                                                : from_solid(source, parameters, progress);
  built->limit_cells(static_cast<std::uint32_t>(parameters.integer("most_cells")));
  if (source.events && parameters.flag("events")) {
    progress.begin("ght", source.events->events.size());
    for (const events::Event& event : source.events->events) {
      built->apply(event);
      progress.advance();
    }
  }
  return built;
}

void Ght::spans(Columns where, SpanSink& out) const {
  const Tree& tree = model_.tree;
  const ComposedSurface& surface = model_.surface;
  std::vector<Crossing> crossings;
  std::vector<Span> found;
  std::array<Square, kAhead> squares;
  for (std::size_t c = 0; c < where.size(); ++c) {
    if (c % kAhead == 0) find_squares(model_, where, c, squares);
    const float x = where.x[c], z = where.z[c];
    const Square s = squares[c % kAhead];
    if (s.i >= 0) {
      if (surface.simple(s)) {
        if (!ComposedSurface::hole(tree, s)) {
          const float top = ComposedSurface::plain_height(tree, x, z, s);
          if (top > model_.floor) out.add({model_.floor, top, Material::kBedrock});
        }
      } else {
        crossings.clear();
        surface.crossings(tree, x, z, s, crossings);
        std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
          return a.y > b.y || (a.y == b.y && a.weight > b.weight);
        });
        add_spans(crossings, model_.floor, found, out);
      }
    }
    out.end_column();
  }
}

Memory Ght::memory() const {
  Memory memory = model_.tree.memory();
  memory += model_.surface.memory();
  memory += model_.links.memory();
  memory += model_.index.memory();
  memory.index += heap_bytes(this);
  return memory;
}

Bounds Ght::bounds() const {
  const SampleGrid& grid = model_.tree.grid();
  return {{grid.x(0), model_.floor, grid.z(0)},
          {grid.x(grid.width - 1), model_.ceiling, grid.z(grid.depth - 1)}};
}

LineGrid Ght::lines() const {
  const ght::SampleGrid& grid = model_.tree.grid();
  return {grid.width, grid.depth, grid.origin_x, grid.origin_z, grid.spacing_x, grid.spacing_z, {}};
}

std::unique_ptr<RayCaster> Ght::ray_caster() const { return ght_ray_caster(*this); }

std::vector<std::pair<std::string, std::string>> Ght::facts() const {
  const ght::Census census = ght::census(model_);
  std::vector<std::pair<std::string, std::string>> facts = {
      {"heightmaps",
       fmt::format("{} after {} events, the deepest {} below the root", with_separators(census.nodes),
                   with_separators(model_.tree.events().size()), census.deepest)},
      {"cells", fmt::format("{} heights, {} links, {} void", with_separators(census.heights),
                            with_separators(census.links), with_separators(census.voids))},
      {"surface", fmt::format("{} faces, {} boundary links", with_separators(census.faces),
                              with_separators(census.boundary_links))}};
  const std::vector<std::string> broken = ght::broken_invariants(model_);
  if (broken.empty()) facts.emplace_back("invariants", "all hold");
  for (const std::string& what : broken) facts.emplace_back("invariants", "broken: " + what);
  return facts;
}

}  // namespace terrabench
