// Numbers that a reader can take from the figures of "ght", measured on the pictures and trees that are
// drawn.
#pragma once

#include <span>

#include "experiments/figures/figure.h"
#include "representations/ght/ght.h"
#include "terrain/events/event.h"
#include "terrain/image.h"

namespace terrabench::ght {

// The share of the pixels that show wires of the heightmaps of events; of particles. O(pixels)
double blue_share(const Image&);
double yellow_share(const Image&);

// The ground planes drawn, without the root's. O(cells)
double planes_of_events(const Ght&);

// What events make of the ground, on a grid of columns, four along each side of a cell.
struct Change {
  double removed = 0, added = 0;    // m³ of solid
  double deepest = 0, highest = 0;  // metres by which ground has sunk and the top has risen the most
  double overhang = 0;              // m² in plan with air under ground
};
// `before` is the fresh terrain of `after`. O(columns)
Change change(const Ght& before, const Ght& after);

// Records, as metrics that end in the event's name, what a geotectonic event makes of the ground beside its
// definition, and what the pictures show of its heightmaps. `wires` is the wireframe of `after`. O(columns)
void record_event(figures::Drawing&, const events::Event&, const Ght& before, const Ght& after,
                  const Image& wires);
// The same of a carving: how many metres its axis runs through rock, before and after.
void record_carving(figures::Drawing&, const events::Carving&, const Ght& before, const Ght& after);

// How many of the carvings of `after` lead through their hill.
int open_tunnels(const Ght& before, const Ght& after, std::span<const events::Event> carvings);

// Two pictures of one view, wires on white and textured ground under a sky: the shares of pixels, above the
// wires and from their uppermost on, that are bluer than red.
struct Blueness {
  double sky = 0, ground = 0;
};
Blueness blueness(const Image& wires, const Image& textured);

}  // namespace terrabench::ght
