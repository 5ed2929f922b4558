// What methods draw with the joins between triangles of different detail left out, where a method can leave
// them out: the pixels that show through, and the triangles that the joins cost.
#include <fmt/format.h>

#include <algorithm>

#include "experiments/cross/lod/tuned_cases.h"
#include "lod/meters/bare_pixels.h"
#include "lod/meters/cracks.h"

namespace terrabench::cross {
namespace {

// Of the metered frames; cross.lod-equal-error looks for cracks in all of them.
constexpr std::size_t kEvery = 3;

struct Seams {
  std::size_t frames = 0, pixels = 0, covered = 0, pixels_of = 0, gaps = 0, t_junctions = 0, triangles = 0;
  double largest_gap = 0;  // pixels
};

Seams seams_along(const Flight& flight, const ConfiguredMethod& method, double knob, Progress& progress) {
  const std::unique_ptr<Lod> lod = method.build(flight.ground(), progress);
  lod->tune(knob);
  Seams seams;
  progress.begin("looking through seams", (flight.metered.size() + kEvery - 1) / kEvery);
  for (std::size_t k = 0; k < flight.metered.size(); k += kEvery) {
    const View& view = flight.views[flight.metered[k]];
    const Frame& frame = lod->update(view);
    const CrackReport cracks = find_cracks(frame, flight.ground().width, flight.ground().depth, view);
    const BarePixels openings = find_bare_pixels(frame, flight.ground(), view);
    seams.pixels += openings.bare;
    seams.covered += openings.covered;
    seams.pixels_of += static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height);
    seams.gaps += cracks.gaps;
    seams.t_junctions += cracks.t_junctions;
    seams.largest_gap = std::max(seams.largest_gap, cracks.largest_gap_px);
    seams.triangles += frame.stats.triangles;
    ++seams.frames;
    progress.advance();
  }
  progress.end();
  return seams;
}

void record(const Seams& seams, const std::string& prefix, Recorder& recorder) {
  recorder.add(prefix + "crack_pixels", "", seams.pixels);
  recorder.add(prefix + "gaps", "", seams.gaps);
  recorder.add(prefix + "t_junctions", "", seams.t_junctions);
  recorder.add(prefix + "triangles", "",
               static_cast<double>(seams.triangles) / static_cast<double>(seams.frames));
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TunedMethod tuned = tune_case(at, options, recorder, progress);
  const Flight& flight = tuned.flight;
  const Seams joined = seams_along(flight, tuned.method, tuned.tuned.knob, progress);
  record(joined, "", recorder);
  recorder.add("frames", "", joined.frames);
  recorder.add("covered_pixels", "", joined.covered);
  const LodType& type = *tuned.method.type;
  if (type.unstitched.empty()) return;
  ConfiguredMethod unjoined = tuned.method;
  unjoined.options.set_from_text(std::string(type.unstitched));
  const Seams open = seams_along(flight, unjoined, tuned.tuned.knob, progress);
  record(open, "open_", recorder);
  recorder.add("open_crack_share", "",
               static_cast<double>(open.pixels) / static_cast<double>(open.pixels_of));
  recorder.add("open_largest_gap", "px", open.largest_gap);
}

}  // namespace

extern const Experiment kLodSeams{"cross.lod-seams", "Level of detail with its seams left open", kTunedSpecs,
                                  tuned_cases, measure};

}  // namespace terrabench::cross
