// A camera's way over one ground, with all that is the same for every method there: which samples are seen,
// and the pictures of the full terrain.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
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
  float lowest, highest;             // of the ground, metres
  std::vector<View> views;           // every frame of the path
  std::vector<std::size_t> metered;  // of views, ascending, from 1 on
  std::vector<Visibility> seen;      // of the metered ones
  // What tune_to() has found: method with its options, and pixels.
  std::map<std::pair<std::string, double>, Tuned> tuned;
  std::vector<Image> pictures;  // brute force's, of pictured(); empty until they are drawn
};

// Which metered frames are drawn, as indices of Flight::metered.
std::vector<std::size_t> pictured(const Flight&);

// The flight along a route. The last one is kept, since neighbouring cases share it and it takes longer to
// prepare than to use; what it holds depends on the route alone.
Flight& flight_along(const Route&, Progress&);

// A method with its options set: what is measured.
struct Contender {
  const LodType* type;
  Parameters options;

  std::unique_ptr<Lod> build(const Heightfield&, Progress&) const;
  // Brute force has one setting, whatever the error.
  bool tunable() const { return type->knob.finest != type->knob.coarsest; }
};
// `options` is a list such as "geomipmap.patch=32,mrbsp.threshold=area", of which those of the method count.
// Throws unknown_name and usage_error.
Contender contender(std::string_view method, std::string_view options);

// What enters the comparison: every method as it comes, and those with an option worth a comparison of its
// own.
struct Entrant {
  std::string name;  // of its cases
  std::string method, options;
};
std::vector<Entrant> entrants();

// The coarsest setting of the knob whose 99th percentile of screen-space error stays at or below `pixels`
// over every other metered frame. The same whatever was tuned before.
Tuned tune_to(Flight&, const Contender&, double pixels, Progress&);

}  // namespace terrabench::cross
