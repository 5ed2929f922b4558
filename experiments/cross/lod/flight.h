// A camera path over one ground, with everything that is the same for all methods: which samples are visible,
// and the pictures of the full terrain.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "experiments/experiment.h"
#include "lod/lod.h"
#include "lod/meters/knob_search.h"
#include "lod/meters/screen_error.h"
#include "lod/meters/seen_samples.h"
#include "terrain/image.h"
#include "terrain/source.h"

namespace terrabench::cross {

// "fractal", "peak", "hills" and "helens-mosaic" have size × size samples: diamond-square mountains, a smooth
// peak on flat land, hills of noise, and measured ground repeated by reflection. Any other name is opened as
// a terrain, and its holes are filled. Throws usage_error for a solid.
TerrainSource open_ground(std::string_view name, int size, std::uint64_t seed);

// The ground whose figures have no suffix.
inline constexpr std::string_view kMainGround = "jacksboro";

struct Route {
  std::string terrain, path;
  int size = 0;    // samples per side of generated ground
  int frames = 0;  // metered
  std::uint64_t seed = 0;
  bool operator==(const Route&) const = default;
};

// Which figure of the visible samples' screen-space errors is made equal.
enum class Criterion { kP99, kRms, kLargest };
double figure_of(const Distribution&, Criterion);

struct Flight {
  Flight(const Route&, Progress&);

  const Heightfield& ground() const { return *source.heights; }

  Route route;
  TerrainSource source;
  float lowest, highest;             // of the ground, metres
  std::vector<View> views;           // every frame of the path
  std::vector<std::size_t> metered;  // indices of views, ascending, from 1
  std::vector<SeenSamples> seen;     // per metered view
  // Results of tune_to() by method with its options, criterion and pixels.
  std::map<std::tuple<std::string, Criterion, double>, Tuned> tuned;
  std::vector<Image> pictures;  // of the full terrain, in the frames pictured(); see draw_reference()
};

// The metered frames that are drawn, as indices of Flight::metered.
std::vector<std::size_t> pictured(const Flight&);

// The flight along a route. The last one is kept: consecutive cases share it, and preparing it takes longer
// than using it. Its content depends on the route alone.
Flight& flight_along(const Route&, Progress&);

// A method with its options set.
struct ConfiguredMethod {
  const LodType* type;
  Parameters options;

  std::unique_ptr<Lod> build(const Heightfield&, Progress&) const;
  // Brute force has a single setting.
  bool tunable() const { return type->tunable(); }
};
// `options` is a list such as "geomipmap.patch=32,mrbsp.threshold=area"; those of other methods are ignored.
// Throws unknown_name and usage_error.
ConfiguredMethod configured(std::string_view method, std::string_view options);

// The method or variant of this name, with the user's `options` after its own, which they override. Throws
// like configured().
ConfiguredMethod named_method(std::string_view name, const std::string& options);

// The coarsest setting of the knob with which the criterion's figure of the screen-space error stays at or
// below `pixels` over every other metered frame. Does not depend on what was tuned before.
Tuned tune_to(Flight&, const ConfiguredMethod&, double pixels, Progress&, Criterion = Criterion::kP99);

// The visible samples' screen-space errors over all metered frames, drawn one after another.
Distribution errors_along(const Flight&, Lod&);

// Over every frame of a path, with nothing between two updates. The first update, which builds what later
// ones keep, is reported separately.
struct PathCost {
  std::size_t first_uploaded = 0;        // bytes
  double uploaded = 0;                   // bytes per frame, mean
  std::vector<double> times, triangles;  // per frame: seconds, triangles drawn
  std::size_t bytes_held = 0;            // by the method's own count, after the path
  std::int64_t heap_growth = 0;          // by the count of operator new
};

// Builds the method, sets its knob and updates it for every view of the flight.
PathCost fly(const Flight&, const ConfiguredMethod&, double knob, Progress&);

}  // namespace terrabench::cross
