// The figures of §2 of "ght", one function each.
#pragma once

#include "experiments/recorder.h"
#include "renderers/context.h"

namespace terrabench::ght {

// Drawn flat: stage_drawings.cpp.
void draw_midpoints(std::uint64_t seed, Recorder&);             // figure 3
void draw_neighbourhoods(Recorder&);                            // figure 4
void draw_diamond_square_steps(std::uint64_t seed, Recorder&);  // figure 5
void draw_straddling_diamond(std::uint64_t seed, Recorder&);    // figure 6
void draw_first_fault(std::uint64_t seed, Recorder&);           // figure 8
void draw_fault_maps(std::uint64_t seed, Recorder&);            // figure 9

// Drawn in space: stage_views.cpp.
void draw_heightmap_and_wireframe(GlContext&, std::uint64_t seed, Recorder&);  // figure 1
void draw_diamond_square_terrains(GlContext&, std::uint64_t seed, Recorder&);  // figure 7
void draw_hills_one_and_many(GlContext&, std::uint64_t seed, Recorder&);       // figure 10

}  // namespace terrabench::ght
