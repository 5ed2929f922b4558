// A crater is dug into the ground in front of the eye, and filled again: what a method uploads, computes and
// draws anew, and whether it then draws what one draws that is built on that ground.
#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/cross/lod/tuned_cases.h"
#include "experiments/stopwatch.h"
#include "lod/meters/triangle_set.h"

namespace terrabench::cross {
namespace {

constexpr int kSide = 64;         // samples along the edited square's side
constexpr double kAway = 48;      // cells from the eye to the crater's middle, at least
constexpr double kDepth = 4;      // cells
constexpr int kRepetitions = 8;   // each digs and fills
constexpr std::size_t kLead = 3;  // frames of the path before, for methods that keep a mesh

// Around the visible sample that is the nearest of those at least kAway cells from the eye.
SampleRect crater_before(const SeenSamples& seen) {
  const double eye_x = static_cast<double>(seen.view().eye.x) / static_cast<double>(seen.cell_x()),
               eye_z = static_cast<double>(seen.view().eye.z) / static_cast<double>(seen.cell_z());
  double nearest = std::numeric_limits<double>::infinity();
  glm::ivec2 middle(seen.width() / 2, seen.depth() / 2);
  for (int j = 0; j < seen.depth(); ++j) {
    for (int i = 0; i < seen.width(); ++i) {
      const double away = std::hypot(i - eye_x, j - eye_z);
      if (seen.at(i, j) != Seen::kVisible || away < kAway || away >= nearest) continue;
      nearest = away;
      middle = {i, j};
    }
  }
  const glm::ivec2 side = glm::min(glm::ivec2(kSide), glm::ivec2(seen.width(), seen.depth()));
  const glm::ivec2 low =
      glm::clamp(middle - side / 2, glm::ivec2(0), glm::ivec2(seen.width(), seen.depth()) - side);
  return {low, low + side - 1};
}

// Smooth, and 0 outside the square's inscribed ellipse.
void dig(Heightfield& field, const SampleRect& rect) {
  const glm::dvec2 middle = 0.5 * glm::dvec2(rect.low + rect.high),
                   half = 0.5 * glm::dvec2(rect.high - rect.low + 1);
  const double deep = kDepth * static_cast<double>(std::max(field.cell_x, field.cell_z));
  for (int j = rect.low.y; j <= rect.high.y; ++j) {
    for (int i = rect.low.x; i <= rect.high.x; ++i) {
      const glm::dvec2 at = (glm::dvec2(i, j) - middle) / half;
      const double inside = std::max(0.0, 1 - at.x * at.x - at.y * at.y);
      field.at(i, j) -= static_cast<float>(deep * inside * inside);
    }
  }
}

void fill(Heightfield& field, const Heightfield& original, const SampleRect& rect) {
  for (int j = rect.low.y; j <= rect.high.y; ++j) {
    for (int i = rect.low.x; i <= rect.high.x; ++i) field.at(i, j) = original.at(i, j);
  }
}

struct Edited {
  Lod& lod;
  TriangleSet drawn;  // before the edit
};

// To be called when the ground has changed. Returns how many triangles only one of the method and a fresh one
// draws.
std::size_t take_edit(Edited& edited, const SampleRect& rect, const View& view, const TunedMethod& tuned,
                      const Heightfield& ground, Recorder& recorder, Progress& progress) {
  Stopwatch watch;
  edited.lod.edited(rect);
  const Frame& frame = edited.lod.update(view);
  recorder.add("edit_time", "s", watch.seconds());
  recorder.add("uploaded", "B", frame.stats.bytes_uploaded);
  const TriangleSet now(frame);
  recorder.add("triangles", "", now.size());
  recorder.add("triangles_changed", "", now.missing_in(edited.drawn));
  edited.drawn = now;
  watch = {};
  const std::unique_ptr<Lod> fresh = tuned.build(ground, progress);
  const Frame& anew = fresh->update(view);
  recorder.add("rebuild_time", "s", watch.seconds());
  recorder.add("rebuild_uploaded", "B", anew.stats.bytes_uploaded);
  const TriangleSet built(anew);
  return now.missing_in(built) + built.missing_in(now);
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TunedMethod tuned = tune_case(at, options, recorder, progress);
  recorder.add("reached", "", tuned.tuned.reached ? 1 : 0);
  const Flight& flight = tuned.flight;
  const std::size_t k = flight.metered.size() / 2, last = flight.metered[k];
  const View& view = flight.views[last];
  const SampleRect rect = crater_before(flight.seen[k]);
  Heightfield ground = flight.ground();
  const std::unique_ptr<Lod> lod = tuned.build(ground, progress);
  for (std::size_t i = last - std::min(last, kLead); i < last; ++i) lod->update(flight.views[i]);
  Edited edited{*lod, TriangleSet(lod->update(view))};
  std::size_t most_differing = 0;
  for (int k = 0; k < kRepetitions; ++k) {
    for (const bool digs : {true, false}) {
      const Stopwatch watch;
      lod->update(view);
      recorder.add("rest_time", "s", watch.seconds());
      (void)lod->memory();  // waits for threads that read the ground
      digs ? dig(ground, rect) : fill(ground, flight.ground(), rect);
      most_differing =
          std::max(most_differing, take_edit(edited, rect, view, tuned, ground, recorder, progress));
    }
  }
  recorder.add("triangles_differing_most", "", most_differing);
}

}  // namespace

extern const Experiment kLodEdit{"cross.lod-edit", "Level of detail after an edit of the ground",
                                 kTunedSpecs,      tuned_cases,
                                 measure,          Experiment::kTimed};

}  // namespace terrabench::cross
