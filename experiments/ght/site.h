// Where the tree is measured: the mountains of the catalogue's "diamond-square", the paper's own generator,
// at any number of samples, and on them each of its events at the same places in metres. That ground closes
// on itself, so larger terrains are it again and again, and an event finds the same ground on all of them.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <random>
#include <vector>

#include "representations/ght/ght.h"
#include "terrain/events/event.h"
#include "terrain/heightfield.h"

namespace terrabench::ght {

inline constexpr int kEventsAlong = 4;  // a repetition of the mountains is so many events long

struct Site {
  Heightfield ground;
  std::uint64_t seed = 0;
  double size = 0;       // metres: events are about so long
  glm::dvec2 corner{0};  // of the repetition where events are, in the middle of the terrain
  glm::dvec2 middle{0};  // of geotectonic events
  double extent() const { return kEventsAlong * size; }  // of a repetition, metres
};

// `side` squares along the terrain, events about `size` squares long. Both are powers of two, size ≥ 8 and
// side ≥ kEventsAlong · size. O(side²).
Site make_site(int side, int size, std::uint64_t seed);

// The ground as a tree of one node.
Ght plain_tree(const Heightfield& ground);

// A geotectonic event around `centre`, `length` metres long.
events::Event geotectonic_event(const Site&, events::Kind, glm::dvec2 centre, double length);
// The first place in the mountains where the tree takes a tunnel or a cave of so many sides; the tree has it
// then. Nothing when none is found: the section must be more than 2 cells wide, so sites of size 32 upward.
std::optional<events::Event> carve(Ght& tree, const Site&, bool cave, int sides);
// Of either family, alone on the site: carvings with eight sides. The same in metres for all sites of a seed,
// but for where the terrain's middle is. Throws environment_error when the mountains have no place for it.
events::Event single_event(const Site&, events::Kind);

// Two tunnels (figure 21).
std::vector<events::Event> two_tunnels(const Site&);
// Particles that crash into the ground (§4.2, figure 24), each as it is then, by one law: a crater of one and
// a half to four cells' radius, a third as deep.
class Rain {
 public:
  Rain(const Heightfield& ground, std::uint64_t seed)
      : random_(static_cast<std::mt19937::result_type>(seed)),
        extent_(ground.extent_x(), ground.extent_z()),
        cell_(ground.cell_x) {}
  events::Event next(const Ght& tree);

 private:
  double between(double low, double high) {
    return low + (high - low) * 0x1p-32 * static_cast<double>(random_());
  }
  std::mt19937 random_;
  glm::dvec2 extent_;
  double cell_;
};

// Overlapping events of all kinds (§4.2, figure 22), over a site of one repetition: those of them that the
// tree takes on these mountains.
std::vector<events::Event> overlapping_events(const Site&);

}  // namespace terrabench::ght
