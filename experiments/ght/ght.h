// What the experiments of "ght" (Alonso, Joan-Arinyo & Solano) share.
#pragma once

#include <cstddef>
#include <string_view>

#include "terrain/events/event.h"

namespace terrabench::ght {

events::Kind kind_named(std::string_view name);  // throws usage_error

struct Model;

// What must not be: counted here apart from broken_invariants().
struct Breaks {
  std::size_t dangling = 0;    // links that end in no cell of the surface
  std::size_t voids_seen = 0;  // corners of the surface that hold no height
  Breaks& operator+=(const Breaks&);
};
// O(cells + faces).
Breaks count_breaks(const Model&);

}  // namespace terrabench::ght
