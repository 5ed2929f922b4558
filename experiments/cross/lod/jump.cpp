// The camera jumps from one place of the path to another half a path away, and rests there: how many frames a
// method needs until it draws what one that is built there draws, and what its first frame lacks.
#include <algorithm>
#include <optional>

#include "experiments/cross/lod/tuned_cases.h"
#include "experiments/stopwatch.h"
#include "lod/meters/screen_error.h"
#include "lod/meters/triangle_set.h"

namespace terrabench::cross {
namespace {

constexpr std::size_t kJumps = 8, kMostFrames = 32;
constexpr std::size_t kLead = 3;  // frames of the path before a jump, for methods that keep a mesh

struct Shown {
  TriangleSet triangles;
  Deviation error;  // of visible samples
};

Shown shown(const Frame& frame, const Flight& flight, std::size_t metered) {
  const SurfaceRaster drawn(frame, flight.ground().width, flight.ground().depth);
  return {TriangleSet(frame), screen_error(drawn, flight.ground(), flight.seen[metered]).visible};
}

bool no_worse(const Deviation& error, const Deviation& than) {
  return error.p99 <= than.p99 && error.largest <= than.largest && error.undrawn <= than.undrawn;
}

// Until the triangles are those of a fresh method, and until the error is no larger. A method that never
// becomes equal, or as good, counts with one frame more than it was given.
struct Frames {
  std::size_t to_equal = 0, to_error = 0;
};

// From one metered frame to another.
Frames jump(const TunedMethod& tuned, std::size_t from, std::size_t to, Recorder& recorder,
            Progress& progress) {
  const Flight& flight = tuned.flight;
  const View& there = flight.views[flight.metered[to]];
  const std::unique_ptr<Lod> fresh = tuned.build(progress), lod = tuned.build(progress);
  const Shown goal = shown(fresh->update(there), flight, to);
  const std::size_t last = flight.metered[from];
  for (std::size_t i = last - std::min(last, kLead); i < last; ++i) lod->update(flight.views[i]);
  Stopwatch watch;
  const std::size_t usual_bytes = lod->update(flight.views[last]).stats.bytes_sent();
  recorder.add("usual_time", "s", watch.seconds());
  recorder.add("usual_uploaded", "B", usual_bytes);
  std::optional<std::size_t> equal, as_good;
  Deviation first;
  std::size_t differing = 0;
  for (std::size_t k = 1; k <= kMostFrames && !(equal && as_good); ++k) {
    watch = {};
    const Frame& frame = lod->update(there);
    if (k == 1) {
      recorder.add("jump_time", "s", watch.seconds());
      recorder.add("jump_uploaded", "B", frame.stats.bytes_sent());
    }
    const Shown now = shown(frame, flight, to);
    if (k == 1) first = now.error;
    differing = now.triangles.missing_in(goal.triangles);
    if (!equal && now.triangles == goal.triangles) equal = k;
    if (!as_good && no_worse(now.error, goal.error)) as_good = k;
  }
  const Frames needed{equal.value_or(kMostFrames + 1), as_good.value_or(kMostFrames + 1)};
  recorder.add("triangles_differing", "", differing);
  recorder.add("first_error_p99", "px", first.p99);
  recorder.add("first_error_largest", "px", first.largest);
  recorder.add("fresh_error_p99", "px", goal.error.p99);
  recorder.add("fresh_error_largest", "px", goal.error.largest);
  recorder.add("fresh_triangles", "", goal.triangles.size());
  return needed;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TunedMethod tuned = tune_case(at, options, recorder, progress);
  const std::size_t frames = tuned.flight.metered.size(), jumps = std::min(kJumps, frames);
  Frames most;
  progress.begin("jumping", jumps);
  for (std::size_t k = 0; k < jumps; ++k) {
    const std::size_t from = k * frames / jumps;
    const Frames needed = jump(tuned, from, (from + frames / 2) % frames, recorder, progress);
    most = {std::max(most.to_equal, needed.to_equal), std::max(most.to_error, needed.to_error)};
    progress.advance();
  }
  progress.end();
  recorder.add("jumps", "", jumps);
  recorder.add("frames_to_equal_most", "", most.to_equal);
  recorder.add("frames_to_error_most", "", most.to_error);
}

}  // namespace

extern const Experiment kLodJump{"cross.lod-jump", "Level of detail after a jump of the camera",
                                 kTunedSpecs,      tuned_cases,
                                 measure,          Experiment::kTimed};

}  // namespace terrabench::cross
