// Where the tree is measured: the mountains of the catalogue's "diamond-square", the paper's own generator,
// at any number of samples, with each of the paper's events at the same place in metres. Opposite borders of
// that ground are equal, so larger terrains repeat it, and an event finds the same ground on all of them.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/recorder.h"
#include "representations/ght/ght.h"
#include "terrain/events/event.h"
#include "terrain/heightfield.h"

namespace terrabench::ght {

inline constexpr int kEventsAlong = 4;  // length of one repetition of the mountains, in events

struct Site {
  Heightfield ground;
  std::uint64_t seed = 0;
  double size = 0;       // metres, about the length of an event
  glm::dvec2 corner{0};  // of the repetition that has the events, in the middle of the terrain
  glm::dvec2 middle{0};  // of the geotectonic event
  double extent() const { return kEventsAlong * size; }  // metres, of a repetition
};

// `side` squares along the terrain, events about `size` squares long. Both are powers of two, size ≥ 8 and
// side ≥ kEventsAlong · size. O(side²).
Site make_site(int side, int size, std::uint64_t seed);

// The first of the sites of `seed`, seed + 1, … that fits: not all mountains have a place for what is to be
// measured. Throws environment_error if none of 100 does.
Site first_site(int side, int size, std::uint64_t seed, const std::function<bool(const Site&)>& fits);

// The first of the sites of `seed`, seed + 1, … whose mountains have a place for every event alone, for two
// tunnels and for the whole planned sequence, so that all experiments of one seed share their mountains.
// Searches once per seed. Thread-safe. Throws as first_site() does.
Site event_site(int side, int size, std::uint64_t seed);
// The record's ground, and as "site_seed" the seed of the mountains where `asked` had no place for all
// events.
void record_site(const Site&, std::uint64_t asked, Recorder&);
// event_site(), recorded.
Site recorded_site(int side, int size, std::uint64_t seed, Recorder&);

// The ground as a tree of one node.
Ght plain_tree(const Heightfield& ground);

// A geotectonic event around `centre`, `length` metres long.
events::Event geotectonic_event(const Site&, events::Kind, glm::dvec2 centre, double length);
// Applies to the tree, and returns, the first tunnel or cave with a section of `sides` sides for which the
// mountains have a place. Nothing if there is none. The section must be more than 2 cells wide, so the site's
// size must be 32 or more. About a second at most.
std::optional<events::Event> carve(Ght& tree, const Site&, bool cave, int sides);
// The event of that kind, alone on the site; carvings have eight sides. The same for all sites of a seed, in
// metres from the corner. Throws environment_error if the mountains have no place for it.
events::Event single_event(const Site&, events::Kind);

// Height of the ground at a place in plan; NaN outside the terrain and over holes.
using HeightAt = std::function<double(glm::dvec2)>;

// Whether the carving leaves the ground only once beyond its end at u: after its roof has first come out, the
// ground must not rise half a cell above the roof again before the whole section is out. If it did, the exact
// shape would have another piece of roof, but the tree's walls end at the first exit. `cell` in metres.
bool comes_out_once(const HeightAt& height, double cell, const events::Carving& carving, double u,
                    double outwards);

// Two tunnels (figure 21).
std::vector<events::Event> two_tunnels(const Site&);

// Numbers in a range, the same on every machine.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(static_cast<std::mt19937::result_type>(seed)) {}
  std::uint32_t next() { return static_cast<std::uint32_t>(random_()); }
  double between(double low, double high) { return low + (high - low) * 0x1p-32 * next(); }

 private:
  std::mt19937 random_;
};

// Particles that crash into the ground (§4.2, figure 24). Each leaves a crater of 1.5 to 4 cells' radius, a
// third as deep, in the surface of the tree as it is then.
class Rain {
 public:
  Rain(const Heightfield& ground, std::uint64_t seed)
      : dice_(seed), extent_(ground.extent_x(), ground.extent_z()), cell_(ground.cell_x) {}
  events::Event next(const Ght& tree);

 private:
  Dice dice_;
  glm::dvec2 extent_;
  double cell_;
};

// Overlapping events of all kinds (§4.2, figure 22), over a site of one repetition: those of the
// kPlannedEvents that the tree accepts on these mountains.
inline constexpr std::size_t kPlannedEvents = 12;
std::vector<events::Event> overlapping_events(const Site&);

// The names of all kinds of event, in the order of events::Kind: the values of a parameter "event".
std::span<const std::string_view> event_names();
// "METRIC_linear_erosion": a metric of one kind of event.
std::string metric_of(std::string_view metric, events::Kind);

}  // namespace terrabench::ght
