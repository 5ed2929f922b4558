// The figures of "ght".
#pragma once

#include <string_view>

#include "experiments/figures/figure.h"
#include "representations/ght/ght.h"

namespace terrabench::ght {

figures::Sheet draw_network(figures::Drawing&);  // 2: network_figure.cpp
figures::Sheet draw_tree(figures::Drawing&);     // 23: tree_figure.cpp

// Of figures 1, 2, 7 and 10, in space.
inline constexpr figures::PanelStyle kSpaceStyle{.margin = 20, .words = 28, .baseline = 20, .text_size = 15};

// The terrain of that name in terrain/events/scripts as a tree, with or without its events.
Ght open_tree(std::string_view script, bool with_events = true);

// Without white rows of pixels that all panels of a row share, and white columns that all panels of all rows
// with as many panels share: pictures of the same size stay so, and what they show stays in the same place.
// A margin of some pixels remains. O(pixels): trimmed.cpp
figures::PanelRows trimmed(figures::PanelRows);

// The terrain of figures 22 and 23: the overlapping events that ght.complex measures (site.h).
Ght sequence_tree(std::uint64_t seed);

}  // namespace terrabench::ght
