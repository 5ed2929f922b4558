// What the experiments of "ght" (Alonso, Joan-Arinyo & Solano) share.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace terrabench::ght {

// The names of all kinds of event, in the order of events::Kind: the values of a parameter "event".
std::span<const std::string_view> event_names();

struct Model;

// What a sound tree does not have; broken_invariants() counts other things.
struct Breaks {
  std::size_t dangling = 0;    // links that end in no cell of the surface
  std::size_t voids_seen = 0;  // corners of the surface that hold no height
};
// O(cells + faces)
Breaks count_breaks(const Model&);

}  // namespace terrabench::ght
