#include "representations/drill/drill_terrain.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "representations/column_grid.h"
#include "representations/drill/choose_parameters.h"
#include "representations/drill/drill_codec.h"
#include "representations/drill/extract.h"
#include "representations/drill/quantum.h"
#include "representations/drill/regenerate.h"
#include "representations/line_grid.h"
#include "representations/ray_cast.h"
#include "terrain/error.h"
#include "terrain/separators.h"

namespace terrabench {
namespace {

constexpr std::array<std::string_view, 3> kFitNames{"monotone", "printed", "vertex"};
constexpr std::array kFits{DrillFit::kMonotone, DrillFit::kPrinted, DrillFit::kVertex};
constexpr float kMostHeight = 1e9F;  // CrossSections treats heights far below as no data

DrillOptions options_from(const Parameters& parameters) {
  DrillOptions options;
  options.tau = static_cast<std::uint32_t>(parameters.integer("tau"));
  options.w = static_cast<int>(parameters.integer("w"));
  options.k = static_cast<int>(parameters.integer("k"));
  options.fit = kFits[parameters.choice("fit")];
  options.monotone_profiles = parameters.flag("monotone_profiles");
  options.adaptive_k = parameters.flag("adaptive_k");
  options.interpolate_untouched = parameters.flag("interpolate_untouched");
  return options;
}

Heightfield as_field(const Heightmap& map) {
  const HeightGrid& grid = map.grid();
  return {grid.width,
          grid.depth,
          static_cast<float>(grid.cell_x),
          static_cast<float>(grid.cell_z),
          {map.heights().begin(), map.heights().end()},
          {}};
}

}  // namespace

std::span<const ParameterSpec> DrillTerrain::parameters() {
  static const std::vector<ParameterSpec> kSpecs = column_parameters_and({
      {"tau", std::int64_t{25}, "pixels", "least flow of a channel", 1, 4294967295.0},
      {"w", std::int64_t{10}, "samples", "length of the cross-sections", 1, Drills::kMaxInfluence},
      {"k", std::int64_t{10}, "samples", "influence: a drill's window is 2k + 1 wide", 0,
       Drills::kMaxInfluence},
      choice(
          "fit", kFitNames,
          "shapes: never falling from the centre outward, as printed in §2.2 (free but for the centre), or "
          "parabolas with their vertex at the centre"),
      {"monotone_profiles", false, "", "elevations never rise downstream, so that no pit is left"},
      {"adaptive_k", false, "", "an influence per drill, up to k"},
      {"interpolate_untouched", false, "", "interpolate pixels that no drill touches"},
      {"quantum", 0.0, "m",
       "elevations are rounded to multiples of it; 0: about 1/256 of the range of heights", 0, 1e6},
      {"budget_bytes", std::int64_t{0}, "B",
       "choose tau, w, k and quantum for at most so many bytes of drills; 0: no budget", 0, 1e15},
      {"max_rmse", 0.0, "m", "choose tau, w, k and quantum for at most this error; 0: no budget", 0, 1e9},
  });
  return kSpecs;
}

DrillTerrain::DrillTerrain(Drills drills, HeightGrid grid) : drills_(std::move(drills)) {
  const std::size_t copies = drills_.interpolated ? 4 : 2;  // interpolate_untouched() works on copies
  require_memory(drills_.pixels() * copies * sizeof(float), "terrain from drills");
  Heightfield field = regenerate(drills_);
  // Shapes that may fall outward can cut through the floor.
  const HeightRange range = height_range(field);
  const bool empty = range.no_data == field.heights.size();
  if (!empty && range.lowest <= grid.bounds.low.y) {
    grid.bounds.low.y = range.lowest - static_cast<float>(std::max(grid.cell_x, grid.cell_z));
  }
  if (!empty) grid.bounds.high.y = std::max(grid.bounds.high.y, range.highest);
  surface_ = std::make_unique<Heightmap>(grid, std::move(field.heights));
}

std::unique_ptr<Representation> DrillTerrain::build(const TerrainSource& source, const Parameters& parameters,
                                                    Progress& progress) {
  const auto sampled = Heightmap::build(source, parameters, progress);
  const auto& map = static_cast<const Heightmap&>(*sampled);
  const Heightfield field = as_field(map);
  DrillOptions options = options_from(parameters);
  check_options(options, field.width, field.depth);
  if (std::any_of(field.heights.begin(), field.heights.end(),
                  [](float h) { return std::abs(h) > kMostHeight; })) {
    throw bad_input("heights exceed 10⁹ m", source.name, "check the file's units and its no-data value");
  }
  const FlowNetwork network = route_flow(field, &progress);
  auto quantum = static_cast<float>(parameters.number("quantum"));
  DrillBudget budget;
  budget.bytes = static_cast<std::size_t>(parameters.integer("budget_bytes"));
  budget.rmse = parameters.number("max_rmse");
  if (budget.bytes > 0 || budget.rmse > 0) {
    const DrillChoice choice = choose_parameters(field, network, budget, options, &progress);
    if (!choice.within_budget) {
      throw usage_error(
          fmt::format("no drills within the budget: the nearest take {} bytes with an error of {:.4g} m",
                      choice.bytes, choice.rmse),
          "drill", "allow more bytes, or a larger error");
    }
    options = choice.options;
    quantum = choice.quantum;
  }
  Drills drills = extract_drills(field, network, options, &progress);
  quantise(drills, quantum > 0 ? quantum : automatic_quantum(field));
  std::unique_ptr<DrillTerrain> built(new DrillTerrain(std::move(drills), map.grid()));
  built->tau_ = parameters.integer("tau");
  return built;
}

Memory DrillTerrain::memory() const {
  Memory memory = surface_->memory();
  for (const auto* numbers : {&drills_.elevation, &drills_.slope, &drills_.curvature}) {
    memory += payload_memory(*numbers);
  }
  memory += payload_memory(drills_.influence);
  memory += index_memory(drills_.pixel, drills_.direction, drills_.holes);
  memory.index += heap_bytes(this);
  return memory;
}

void DrillTerrain::save(ByteSink& out) const {
  surface_->grid().save(out);
  encode_drills(drills_, out);
}

std::unique_ptr<Representation> DrillTerrain::load(ByteSource& in) {
  const HeightGrid grid = HeightGrid::load(in);
  Drills drills = decode_drills(in);
  if (grid.width != drills.width || grid.depth != drills.depth)
    in.fail("the drills do not match the grid's size");
  return std::unique_ptr<Representation>(new DrillTerrain(std::move(drills), grid));
}

bool DrillTerrain::encode(double, ByteSink& out) const {
  save(out);
  return true;
}

std::unique_ptr<Representation> DrillTerrain::decode(ByteSource& in) { return load(in); }

LineGrid DrillTerrain::lines() const { return surface_->lines(); }

std::unique_ptr<RayCaster> DrillTerrain::ray_caster() const { return surface_->ray_caster(); }

std::vector<std::pair<std::string, std::string>> DrillTerrain::facts() const {
  ByteSink encoded;
  encode_drills(drills_, encoded);
  std::vector<std::pair<std::string, std::string>> facts = {
      {"drills",
       fmt::format("{}, w = {}, k = {}, rounded to {} m: {} B encoded", with_separators(drills_.count()),
                   drills_.w, drills_.k, drills_.quantum, with_separators(encoded.bytes().size()))}};
  if (drills_.count() == 0) {
    facts.emplace_back("warning",
                       fmt::format("no channels: no pixel's flow reaches tau{}, so the terrain is a "
                                   "plateau at {} m; choose a smaller tau",
                                   tau_ > 0 ? fmt::format(" = {}", tau_) : "", drills_.plateau));
  }
  return facts;
}

}  // namespace terrabench
