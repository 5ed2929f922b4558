#include "experiments/cross/lod/flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "experiments/cross/representations/scenes.h"
#include "experiments/ground.h"
#include "experiments/stopwatch.h"
#include "lod/camera/camera_path.h"
#include "lod/meters/screen_error.h"
#include "terrain/error.h"
#include "terrain/memory.h"
#include "terrain/sources/catalogue.h"
#include "terrain/sources/fractal/diamond_square.h"

namespace terrabench::cross {
namespace {

constexpr float kCell = 30;  // metres
constexpr float kHurst = 0.7F;
constexpr double kRoughness = 5.9;  // metres, largest displacement at the last level of fractal ground
// Without a GPU the pictures take most of the time.
constexpr std::size_t kMeteredToPictured = 4, kMostPictures = 4;

// A Gaussian bell whose standard deviation is 0.06 of the extent and whose steepest slope is 45°. More than
// two thirds of the ground are flat.
Heightfield peak(int size) {
  Heightfield field;
  field.width = field.depth = size;
  field.cell_x = field.cell_z = kCell;
  field.heights.reserve(static_cast<std::size_t>(size) * size);
  const double middle = 0.5 * (size - 1), sigma = 0.06 * size;
  const double height = sigma * kCell * std::exp(0.5);
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) {
      const double r = std::hypot(i - middle, j - middle) / sigma;
      // Exactly 0 where the bell is lower than a millimetre.
      const double h = height * std::exp(-0.5 * r * r);
      field.heights.push_back(h < 1e-3 ? 0.0F : static_cast<float>(h));
    }
  }
  return field;
}

// The same roughness from sample to sample at any size, so that smaller ground resembles a piece of larger.
// At 4097 samples per side the first level is displaced by up to 2,000 m, which gives the relief of the Alps
// over 123 km.
float amplitude(int size) {
  return static_cast<float>(kRoughness * std::pow(2.0, kHurst * fractal::levels_of_side(size)));
}

// `count` indices evenly spaced in 1 … last, which is the last of them.
std::vector<std::size_t> evenly(std::size_t count, std::size_t last) {
  count = std::min(count, last);
  std::vector<std::size_t> chosen(count);
  for (std::size_t k = 0; k < count; ++k) chosen[k] = (k + 1) * last / count;
  return chosen;
}

bool any_visible(const SeenSamples& seen) {
  for (int j = 0; j < seen.depth(); ++j) {
    for (int i = 0; i < seen.width(); ++i) {
      if (seen.at(i, j) == Seen::kVisible) return true;
    }
  }
  return false;
}

}  // namespace

TerrainSource open_ground(std::string_view name, int size, std::uint64_t seed) {
  if (name == "peak") return source_of(name, peak(size));
  if (name == kHelensMosaic) return open_helens_mosaic(size);
  if (name == "hills") return source_of(name, noise_hills(size, seed));
  if (name != "fractal") return open_filled_heights(name, seed);
  return source_of(
      name, fractal::diamond_square(
                {.seed = seed, .side = size, .cell = kCell, .amplitude = amplitude(size), .hurst = kHurst}));
}

Flight::Flight(const Route& along, Progress& progress)
    : route(along), source(open_ground(along.terrain, along.size, along.seed)) {
  const HeightRange range = height_range(ground());
  lowest = range.lowest;
  highest = range.highest;
  views = terrabench::views(open_camera_path(route.path), ground());
  if (views.size() < 2) {
    throw usage_error("a path of one frame has no motion to measure", route.path, "choose another path");
  }
  metered = evenly(static_cast<std::size_t>(route.frames), views.size() - 1);
  require_memory(metered.size() * SeenSamples::bytes(ground().width, ground().depth),
                 fmt::format("the visible samples of {} frames on {}", metered.size(), route.terrain),
                 "meter fewer frames (--set frames=…) or choose less ground");
  seen.reserve(metered.size());
  progress.begin(fmt::format("finding visible samples on {}", route.terrain), metered.size());
  for (const std::size_t frame : metered) {
    seen.emplace_back(ground(), views[frame]);
    progress.advance();
  }
  progress.end();
  if (std::none_of(seen.begin(), seen.end(), any_visible)) {
    throw usage_error(fmt::format("no sample of {} is visible in any metered frame", route.terrain),
                      route.path,
                      "choose a path that looks at the ground (docs/paths.md), or meter more frames");
  }
}

std::vector<std::size_t> pictured(const Flight& flight) {
  std::vector<std::size_t> chosen =
      evenly(std::clamp<std::size_t>(flight.metered.size() / kMeteredToPictured, 1, kMostPictures),
             flight.metered.size());
  for (std::size_t& index : chosen) --index;
  return chosen;
}

Flight& flight_along(const Route& route, Progress& progress) {
  static std::unique_ptr<Flight> last;
  if (last == nullptr || last->route != route) {
    last.reset();  // first: memory may not hold two
    last = std::make_unique<Flight>(route, progress);
  }
  return *last;
}

std::unique_ptr<Lod> ConfiguredMethod::build(const Heightfield& ground, Progress& progress) const {
  return unless_refused([&] { return type->build(ground, options, progress); });
}

ConfiguredMethod configured(std::string_view method, std::string_view options) {
  const LodType& type = lod(method);
  ConfiguredMethod built{&type, Parameters(type.parameters)};
  while (!options.empty()) {
    const std::string_view option = options.substr(0, options.find(','));
    options.remove_prefix(std::min(option.size() + 1, options.size()));
    const std::size_t dot = option.find('.');
    if (dot == option.npos) {
      throw usage_error("an option does not name its method", option, "write METHOD.KEY=VALUE");
    }
    if (&lod(option.substr(0, dot)) == &type) {
      built.options.set_from_text(std::string(option.substr(dot + 1)));
    }
  }
  return built;
}

ConfiguredMethod named_method(std::string_view name, const std::string& options) {
  static const std::vector<Entrant> kAll = entrants();
  std::vector<std::string_view> known;
  for (const Entrant& one : kAll) {
    if (one.name == name)
      return configured(one.method, one.options.empty() || options.empty() ? one.options + options
                                                                           : one.options + "," + options);
    known.push_back(one.name);
  }
  throw unknown_name("level-of-detail method", name, known);
}

double figure_of(const Distribution& errors, Criterion criterion) {
  switch (criterion) {
    case Criterion::kRms:
      return errors.rms();
    case Criterion::kLargest:
      return errors.largest();
    default:
      return errors.quantile(0.99);
  }
}

Tuned tune_to(Flight& flight, const ConfiguredMethod& method, double pixels, Progress& progress,
              Criterion criterion) {
  const Knob& knob = method.type->knob;
  if (!method.tunable()) return {knob.fallback, 0, true};
  std::string name(method.type->name);
  for (std::size_t i = 0; i < method.options.specs().size(); ++i) {
    name += " " + to_string(method.options.value(i));
  }
  const std::tuple key(std::move(name), criterion, pixels);
  if (const auto known = flight.tuned.find(key); known != flight.tuned.end()) return known->second;
  const Heightfield& ground = flight.ground();
  const std::unique_ptr<Lod> lod = method.build(ground, progress);
  SurfaceRaster drawn(ground.width, ground.depth);
  const auto error_at = [&](double setting) {
    lod->tune(setting);
    Distribution pool;
    progress.begin(fmt::format("{} on {}: trying {} = {:.4g}", method.type->name, flight.route.terrain,
                               knob.name, setting),
                   (flight.metered.size() + 1) / 2);
    // The other frames judge the setting found here.
    for (std::size_t k = 0; k < flight.metered.size(); k += 2) {
      drawn.draw(lod->update(flight.views[flight.metered[k]]));
      screen_error(drawn, ground, flight.seen[k], &pool);
      progress.advance();
    }
    return figure_of(pool, criterion);
  };
  return flight.tuned[key] = search_knob(knob, pixels, error_at);
}

Distribution errors_along(const Flight& flight, Lod& lod) {
  SurfaceRaster drawn(flight.ground().width, flight.ground().depth);
  Distribution errors;
  for (std::size_t k = 0; k < flight.metered.size(); ++k) {
    drawn.draw(lod.update(flight.views[flight.metered[k]]));
    screen_error(drawn, flight.ground(), flight.seen[k], &errors);
  }
  return errors;
}

PathCost fly(const Flight& flight, const ConfiguredMethod& method, double knob, Progress& progress) {
  PathCost cost;
  cost.times.reserve(flight.views.size());
  cost.triangles.reserve(flight.views.size());
  const HeapScope heap;
  const std::unique_ptr<Lod> lod = method.build(flight.ground(), progress);
  lod->tune(knob);
  cost.first_uploaded = lod->update(flight.views.front()).stats.bytes_sent();
  for (std::size_t i = 1; i < flight.views.size(); ++i) {
    const Stopwatch watch;
    const Frame& frame = lod->update(flight.views[i]);
    cost.times.push_back(watch.seconds());
    cost.triangles.push_back(static_cast<double>(frame.stats.triangles));
    cost.uploaded += static_cast<double>(frame.stats.bytes_sent());
  }
  cost.uploaded /= static_cast<double>(cost.times.size());
  cost.bytes_held = lod->memory().total();  // first: waits for threads that still allocate
  cost.heap_growth = heap.held();
  return cost;
}

}  // namespace terrabench::cross
