// Experiments of "ght" (Alonso, Joan-Arinyo & Solano): the grounded heightmap tree. Here: the generators of
// its base terrains (§2.3), what they promise, and figures 1 and 3 to 10 step by step; what the tree's
// events add, keep whole, hold and cost (§3.2, §4), and their figures.
#pragma once

#include <span>
#include <vector>

#include "experiments/experiment.h"
#include "terrain/events/event.h"

namespace terrabench::ght {

extern const std::span<const ParameterSpec> kGeneratorParameters;
std::vector<Case> generator_cases(const RunOptions&);
// How many samples of each generator break what §2.3 says of it, and how its result depends on the seed.
void measure_generator(const Case&, const RunOptions&, Recorder&, Progress&);

extern const std::span<const ParameterSpec> kStageParameters;
std::vector<Case> stage_cases(const RunOptions&);
// One figure of §2 each, in the paper's layout, from the generators' own stages.
void draw_stage(const Case&, const RunOptions&, Recorder&, Progress&);

extern const std::span<const ParameterSpec> kEventFigureParameters;
std::vector<Case> event_figure_cases(const RunOptions&);
// One figure of §3.2 or §4 each: what events make of a terrain, and the tree that holds it.
void draw_event_figure(const Case&, const RunOptions&, Recorder&, Progress&);

events::Kind kind_named(std::string_view name);  // throws usage_error

extern const std::span<const ParameterSpec> kCountParameters;
std::vector<Case> count_cases(const RunOptions&);
// Heightmaps that each kind of event adds, on the root and on another node; of carvings by sides.
void measure_count(const Case&, const RunOptions&, Recorder&, Progress&);

struct Model;

// What must not be: counted here apart from broken_invariants().
struct Breaks {
  std::size_t dangling = 0;    // links that end in no cell of the surface
  std::size_t voids_seen = 0;  // corners of the surface that hold no height
  Breaks& operator+=(const Breaks&);
};
// O(cells + faces).
Breaks count_breaks(const Model&);

extern const std::span<const ParameterSpec> kContinuityParameters;
std::vector<Case> continuity_cases(const RunOptions&);
// What breaks, after every event: of single events, two tunnels, the sequence of §4.2, rain, random
// sequences.
void measure_continuity(const Case&, const RunOptions&, Recorder&, Progress&);

extern const std::span<const ParameterSpec> kOverhangParameters;
std::vector<Case> overhang_cases(const RunOptions&);
// Columns with several solid intervals and the air between them, by the tree and by evaluation of the events.
void measure_overhang(const Case&, const RunOptions&, Recorder&, Progress&);

extern const std::span<const ParameterSpec> kEditParameters;
std::vector<Case> edit_cases(const RunOptions&);
// Time and bytes of one event on ever larger terrains, beside stacks and voxels doing the same edit.
void measure_edit(const Case&, const RunOptions&, Recorder&, Progress&);

extern const std::span<const ParameterSpec> kReachParameters;
std::vector<Case> reach_cases(const RunOptions&);
// The same of ever larger events on one terrain.
void measure_reach(const Case&, const RunOptions&, Recorder&, Progress&);

extern const std::span<const ParameterSpec> kComplexParameters;
std::vector<Case> complex_cases(const RunOptions&);
// The sequence of §4.2 and the rain of particles: time, bytes, as a text of events, and columns a second.
void measure_complex(const Case&, const RunOptions&, Recorder&, Progress&);

}  // namespace terrabench::ght
