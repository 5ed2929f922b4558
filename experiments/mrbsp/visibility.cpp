// §4: whether the stored sets over-estimate visibility, checked against pictures whose pixels hold the number
// of the triangle they show; and the bytes saved by storing only changes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <random>
#include <unordered_set>

#include "experiments/experiment.h"
#include "experiments/mrbsp/extruded_profile.h"
#include "experiments/mrbsp/lost_pixels.h"
#include "experiments/mrbsp/methods.h"
#include "experiments/stopwatch.h"
#include "lod/mrbsp/visibility/coarse_squares.h"
#include "lod/mrbsp/visibility/codec.h"
#include "renderers/frame_renderer.h"

namespace terrabench::mrbsp {
namespace {

constexpr std::int64_t kCoarseness = 6;  // of most cases
const std::array kSpecs{
    choice("sets", visibility::kModeNames, "how the visible sets are computed"),
    ParameterSpec{"cells", std::int64_t{16}, "cells", "largest number along the longer side", 1, 256},
    ParameterSpec{"coarseness", kCoarseness, "levels", "between the finest triangles and those of visibility",
                  0, 14},
};
constexpr int kPixels = 512, kViews = 240;

struct Misses {
  std::size_t seen = 0, missed = 0, pixels = 0, missed_pixels = 0, eyes = 0;
  double worst_eye = 0;  // largest share of missed pixels of one eye
};

// The coarse triangle that contains the middle of a triangle of the frame.
std::uint32_t element_of(const Frame& frame, std::uint32_t triangle,
                         const visibility::CoarseSquares& squares) {
  glm::vec2 middle(0);
  for (std::uint32_t c = 0; c < 3; ++c) {
    const std::uint32_t vertex = frame.indices[3 * triangle + c];
    middle += glm::vec2(vertex % static_cast<std::uint32_t>(frame.grid.width),
                        vertex / static_cast<std::uint32_t>(frame.grid.width)) /
              3.0F;
  }
  const auto side = static_cast<float>(squares.side());
  const glm::ivec2 square(middle / side);
  const glm::vec2 in = middle - glm::vec2(square) * side;
  const bool high = visibility::CoarseSquares::rising(square) ? in.x > in.y : in.x + in.y > side;
  return squares.element(square, high ? 1 : 0);
}

// Adds the triangles that an eye sees in all directions but its cell's set lacks.
void look_around(const Heightfield& ground, const glm::vec3& eye, Mrbsp& full, FrameRenderer& renderer,
                 const visibility::Sets& sets, const visibility::CoarseSquares& squares, Misses& misses) {
  const glm::ivec2 cell = cell_below(sets.cells, ground, eye);
  const int cell_number = cell.y * sets.cells.columns + cell.x;
  std::unordered_set<std::uint64_t> seen, missed;  // a triangle may show in two pictures
  std::size_t pixels = 0, missed_pixels = 0;
  for (const glm::vec3 heading : {glm::vec3(1, 0, 0), {0, 0, 1}, {-1, 0, 0}, {0, 0, -1}}) {
    const View view{.eye = eye,
                    .target = eye + heading,
                    .vertical_fov = 1.5708F,
                    .width = kPixels,
                    .height = kPixels,
                    .near = kWalkersNear,
                    .far = 2 * (ground.extent_x() + ground.extent_z())};
    const Frame& frame = full.update(view);
    for (const std::uint32_t number : renderer.triangle_numbers(frame, view)) {
      if (number == 0) continue;
      const std::uint32_t triangle = number - 1;
      const std::uint64_t key = triangle_key(frame, triangle);
      ++pixels;
      const bool known = missed.contains(key);
      if (known ||
          (seen.insert(key).second && !sets.sees(cell_number, element_of(frame, triangle, squares)))) {
        missed.insert(key);
        ++missed_pixels;
      }
    }
  }
  misses.seen += seen.size();
  misses.missed += missed.size();
  misses.pixels += pixels;
  misses.missed_pixels += missed_pixels;
  misses.worst_eye = std::max(misses.worst_eye, share(missed_pixels, pixels));
  ++misses.eyes;
}

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  const bool paper = options.profile == Profile::kPaper;
  const auto add = [&](const std::string& ground, visibility::Mode sets, std::int64_t cells,
                       std::int64_t coarseness) {
    std::string name = fmt::format("{}/{}/cells={}", ground, name_of(sets), cells);
    if (coarseness != kCoarseness) name += fmt::format("/coarseness={}", coarseness);
    cases.push_back(
        {std::move(name),
         {kSpecs, {{"sets", std::string(name_of(sets))}, {"cells", cells}, {"coarseness", coarseness}}},
         ground});
  };
  using visibility::Mode;
  for (const std::string& ground : grounds(options, paper)) {
    for (const Mode sets : {Mode::kSampled, Mode::kConservative}) {
      for (const int cells : {16, 32, 64}) {
        if (cells == 16 || sets == Mode::kSampled || paper) add(ground, sets, cells, kCoarseness);
      }
    }
    for (const Mode sets : {Mode::kVertices, Mode::kFacing, Mode::kInterior}) {
      add(ground, sets, 16, kCoarseness);
    }
    // At the paper's depth of 16, an even coarseness gives squares that are one level coarser.
    for (const int coarseness : {4, 8}) add(ground, Mode::kSampled, 16, coarseness);
  }
  return cases;
}

// What tables 1 and 2 become with these sets.
void record_tables(const Heightfield& ground, const visibility::ChangeTable& changes, Recorder& recorder,
                   Progress& progress) {
  const Heightfield strip = extrude(table1_profile());
  recorder.add(
      "table1_lines_that_differ", "",
      lines_unlike_table1(profile_steps(strip, find_changes(strip, changes.mode, progress), progress)));
  const std::vector<View> views = walk(ground, kViews);
  Methods methods(ground, changes, progress);
  methods.tune(fitted_size(methods, views));
  const double brute = mean_triangles(methods.lods[kBrute], views);
  recorder.add("table2_share_vis", "", mean_triangles(methods.lods[kVis], views) / brute);
  recorder.add("table2_share_both", "", mean_triangles(methods.lods[kBoth], views) / brute);
}

// Pictures from random eyes against the sets.
void record_misses(const Heightfield& ground, Mrbsp& full, const visibility::Sets& sets,
                   const RunOptions& options, Recorder& recorder, Progress& progress) {
  const auto context = open_context(options.renderer, kPixels, kPixels);
  FrameRenderer renderer(*context);
  const visibility::CoarseSquares squares(full.tree(), sets.depth);
  std::mt19937_64 random(options.seed);
  const auto random_share = [&] { return static_cast<float>(random() >> 40) / 16777216.0F; };
  const int eyes = options.profile == Profile::kPaper ? 100 : 10;
  Misses misses;
  progress.begin("looking around", static_cast<std::uint64_t>(eyes));
  for (int e = 0; e < eyes; ++e) {
    glm::vec3 eye(random_share() * ground.extent_x(), 0, random_share() * ground.extent_z());
    eye.y = eye_height(ground, eye.x, eye.z);
    look_around(ground, eye, full, renderer, sets, squares, misses);
    progress.advance();
  }
  progress.end();
  recorder.add("eyes", "", misses.eyes);
  recorder.add("seen", "", misses.seen);
  recorder.add("missed", "", misses.missed);
  recorder.add("missed_share", "", share(misses.missed, misses.seen));
  recorder.add("missed_pixel_share", "", share(misses.missed_pixels, misses.pixels));
  recorder.add("missed_pixel_share_most", "", misses.worst_eye);
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const Heightfield& ground = *source.heights;
  Mrbsp full(ground, {.depth = depth_over(ground)}, progress);
  full.tune(kFinest);
  const visibility::Options how{.mode = static_cast<visibility::Mode>(at.parameters.choice("sets")),
                                .cells = at.integer("cells"),
                                .coarseness = at.integer("coarseness")};
  const Stopwatch watch;
  const visibility::Sets sets = find_sets(grid_of(ground), full.tree(), how, progress);
  recorder.add("preprocessing_time", "s", watch.seconds());
  std::size_t visible = 0;
  for (int cell = 0; cell < sets.cells.count(); ++cell) visible += sets.count(cell);
  recorder.add("cells", "", sets.cells.count());
  recorder.add("visible_share", "",
               static_cast<double>(visible) / sets.cells.count() / std::exp2(sets.depth));
  const visibility::ChangeTable changes = changes_of(sets);
  const visibility::EncodedSizes bytes = encoded_sizes(changes);
  recorder.add("bytes_changes", "B", bytes.changes);
  recorder.add("bytes_lists", "B", bytes.lists);
  recorder.add("bytes_bits", "B", bytes.bits);
  recorder.add("changes_to_lists", "", static_cast<double>(bytes.changes) / static_cast<double>(bytes.lists));
  record_tables(ground, changes, recorder, progress);
  record_misses(ground, full, sets, options, recorder, progress);
}

}  // namespace

extern const Experiment kVisibility{
    "mrbsp.visibility", "§4: what the stored sets miss, and their bytes", kSpecs, cases, measure,
    Experiment::kTimed};

}  // namespace terrabench::mrbsp
