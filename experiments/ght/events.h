// The figures of §3.2 and §4 of "ght", one function each.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/figures/sheet.h"
#include "experiments/ght/event_views.h"
#include "experiments/recorder.h"

namespace terrabench::ght {

// event_figures.cpp
void draw_geotectonic_events(GlContext&, Recorder&);  // figure 13
void draw_erosions(GlContext&, Recorder&);            // figure 17
void draw_faults(GlContext&, Recorder&);              // figure 18
void draw_sequence(GlContext&, Recorder&);            // figure 22
// carving_figures.cpp
void draw_carving_shapes(GlContext&, Recorder&);  // figure 15
void draw_tunnel(GlContext&, Recorder&);          // figure 19
void draw_cave(GlContext&, Recorder&);            // figure 20
void draw_two_tunnels(GlContext&, Recorder&);     // figure 21
// tree_figure.cpp
void draw_tree(Recorder&);  // figure 23
// rain_figure.cpp
void draw_rain(GlContext&, std::uint64_t seed, Recorder&);  // figure 24

// The terrain of terrain/events/scripts of that name, as a tree; without its events if they are not wanted.
Ght open_tree(std::string_view script, bool events = true);

// Rows of pictures of one size, with words under each.
struct Panel {
  Image image;
  std::string words;
};
void write_panels(const std::vector<std::vector<Panel>>& rows, const std::filesystem::path& png);

}  // namespace terrabench::ght
