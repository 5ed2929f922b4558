#include "experiments/cross/flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "lod/camera/camera_path.h"
#include "lod/meters/screen_error.h"
#include "terrain/error.h"
#include "terrain/sources/fractal/diamond_square.h"

namespace terrabench::cross {
namespace {

constexpr float kCell = 30;  // metres
constexpr float kHurst = 0.7F;
constexpr double kRoughness = 5.9;  // metres, the most that fractal ground is displaced at its last level
// Frames before a metered one: after the first, methods that keep a mesh are back in step.
constexpr std::size_t kLead = 2;
// Pictures are what takes longest where there is no GPU.
constexpr std::size_t kMeteredToPictured = 12, kMostPictures = 6;

// A bell of 0.06 of the extent, so high that its steepest slope is one in one: less than a third of the
// ground is not flat.
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
      // Flat to the bit where the bell is lower than a millimetre.
      const double h = height * std::exp(-0.5 * r * r);
      field.heights.push_back(h < 1e-3 ? 0.0F : static_cast<float>(h));
    }
  }
  return field;
}

// As rough from sample to sample whatever the size: smaller ground is like a piece of larger. At 4097 samples
// a side the first level moves by 2,000 m, which gives the relief of the Alps over their 123 km.
float amplitude(int size) {
  return static_cast<float>(kRoughness * std::pow(2.0, kHurst * fractal::levels_of_side(size)));
}

// `count` indices of 1 … last, evenly, the last among them.
std::vector<std::size_t> evenly(std::size_t count, std::size_t last) {
  count = std::min(count, last);
  std::vector<std::size_t> chosen(count);
  for (std::size_t k = 0; k < count; ++k) chosen[k] = (k + 1) * last / count;
  return chosen;
}

}  // namespace

TerrainSource open_ground(std::string_view name, int size, std::uint64_t seed) {
  TerrainSource source;
  if (name == "fractal") {
    source.heights = fractal::diamond_square(
        {.seed = seed, .side = size, .cell = kCell, .amplitude = amplitude(size), .hurst = kHurst});
  } else if (name == "peak") {
    source.heights = peak(size);
  } else {
    source = open_terrain(name, seed);
    if (!source.heights) {
      throw usage_error("level of detail needs a height field, not a solid", name,
                        "name a terrain of heights");
    }
    source.heights = fill_no_data(*source.heights);
    return source;
  }
  source.name = name;
  source.checksum = checksum(*source.heights);
  return source;
}

Flight::Flight(const Route& along, Progress& progress)
    : route(along), source(open_ground(along.terrain, along.size, along.seed)) {
  const HeightRange range = height_range(ground());
  lowest = range.lowest;
  highest = range.highest;
  take_frames(terrabench::views(open_camera_path(route.path), ground()));
  seen.reserve(metered.size());
  progress.begin(fmt::format("finding what is seen on {}", route.terrain), metered.size());
  for (const std::size_t frame : metered) {
    seen.emplace_back(ground(), views[frame]);
    progress.advance();
  }
  progress.end();
}

void Flight::take_frames(const std::vector<View>& path) {
  if (path.size() < 2) {
    throw usage_error("a path of one frame has nothing that moves", route.path, "choose another path");
  }
  std::size_t next = 0;  // frame of the path that none has been taken after
  for (const std::size_t frame : evenly(static_cast<std::size_t>(route.frames), path.size() - 1)) {
    for (std::size_t i = std::max(next, frame - std::min(frame, kLead)); i <= frame; ++i) {
      follows.push_back(i > 0 && i == next && !views.empty());
      views.push_back(path[i]);
      next = i + 1;
    }
    metered.push_back(views.size() - 1);
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
    last.reset();  // first: two may not fit
    last = std::make_unique<Flight>(route, progress);
  }
  return *last;
}

Tuned tune_to(Flight& flight, const LodType& type, double pixels, Progress& progress) {
  if (!tunable(type)) return {type.knob.fallback, 0, true};
  const Heightfield& ground = flight.ground();
  std::vector<std::size_t> chosen = evenly(kTuningFrames, flight.metered.size());
  std::unique_ptr<Lod> lod;  // built when something must be tried
  SurfaceRaster drawn(ground.width, ground.depth);
  const auto error_at = [&](double knob) {
    if (lod == nullptr) lod = type.build(ground, Parameters(type.parameters), progress);
    lod->tune(knob);
    Distribution pool;
    progress.begin(
        fmt::format("{} on {}: trying {} = {:.4g}", type.name, flight.route.terrain, type.knob.name, knob),
        chosen.size());
    for (const std::size_t k : chosen) {
      drawn.draw(lod->update(flight.views[flight.metered[k - 1]]));
      screen_error(drawn, ground, flight.seen[k - 1], &pool);
      progress.advance();
    }
    return pool.quantile(0.99);
  };
  return flight.searches.try_emplace(std::string(type.name), type.knob).first->second.find(pixels, error_at);
}

}  // namespace terrabench::cross
