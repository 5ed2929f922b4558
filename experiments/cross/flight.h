// A camera's way over one ground, with all that is the same for every method there: which samples are seen,
// and the pictures of the full terrain.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/cross/knob_search.h"
#include "experiments/experiment.h"
#include "lod/lod.h"
#include "lod/meters/visibility.h"
#include "terrain/image.h"
#include "terrain/source.h"

namespace terrabench::cross {

// "fractal" and "peak" are made here, size × size samples: diamond-square mountains, and a smooth peak on
// flat land. Any other name is opened as a terrain. Holes are filled. Throws usage_error for what is no
// height field.
TerrainSource open_ground(std::string_view name, int size, std::uint64_t seed);

// The ground whose figures need no suffix.
inline constexpr std::string_view kMainGround = "jacksboro";

struct Route {
  std::string terrain, path;
  int size = 0;    // samples a side of made ground
  int frames = 0;  // metered
  std::uint64_t seed = 0;
  bool operator==(const Route&) const = default;
};

struct Flight {
  Flight(const Route&, Progress&);

  const Heightfield& ground() const { return *source.heights; }

  Route route;
  TerrainSource source;
  float lowest, highest;  // of the ground, metres
  // Frames of the path in their order: each metered one and the few before it.
  std::vector<View> views;
  std::vector<bool> follows;         // the view before is the path's frame before; false after a leap
  std::vector<std::size_t> metered;  // of views, ascending; each follows another
  std::vector<Visibility> seen;      // of the metered ones
  std::map<std::string, KnobSearch, std::less<>> searches;  // by method: what tuning has tried so far
  std::vector<Image> pictures;  // brute force's, of pictured(); empty until they are drawn
 private:
  void take_frames(const std::vector<View>& path);
};

// Which metered frames are drawn, as indices of Flight::metered.
std::vector<std::size_t> pictured(const Flight&);

// The flight along a route. The last one is kept, since neighbouring cases share it and it takes longer to
// prepare than to use; what it holds depends on the route alone.
Flight& flight_along(const Route&, Progress&);

// The coarsest setting of the knob whose 99th percentile of screen-space error stays at or below `pixels`
// over a share of the metered frames, taken evenly: kTuningFrames of them.
inline constexpr std::size_t kTuningFrames = 24;
// Brute force has one setting, whatever the error.
inline bool tunable(const LodType& type) { return type.knob.finest != type.knob.coarsest; }
Tuned tune_to(Flight&, const LodType&, double pixels, Progress&);

}  // namespace terrabench::cross
