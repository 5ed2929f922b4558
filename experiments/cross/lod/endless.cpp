// A clipmap over endless ground of noise, out and back: bytes uploaded, cracks, and identical heights on
// return.
#include <fmt/format.h>

#include <array>
#include <climits>
#include <cmath>
#include <memory>

#include "experiments/cross/lod/strips.h"
#include "experiments/experiment.h"
#include "experiments/figures/maps.h"
#include "experiments/stopwatch.h"
#include "lod/clipmap/clipmap.h"
#include "lod/clipmap/height_source.h"
#include "lod/meters/cracks.h"
#include "renderers/frame_renderer.h"
#include "results/store/format.h"
#include "terrain/files.h"

namespace terrabench::cross {
namespace {

const std::array kSpecs{
    ParameterSpec{"window", std::int64_t{255}, "samples", "side of each clipmap level", 15, 4095},
    ParameterSpec{"distance", 200.0, "km", "length of the outward flight, and of the return", 1, 5000},
    ParameterSpec{"step", 100.0, "m", "distance between frames", 10, 100000},
    ParameterSpec{"far", 150.0, "km", "distance of the far plane", 1, 10000},
    ParameterSpec{"home", 0.0, "km", "distance of the start south-east of sample 0", 0, 10000000},
};
constexpr double kEyeHeight = 400;       // metres above the ground
constexpr double kPictureHeight = 2500;  // above the surrounding peaks, so that the horizon shows
constexpr double kHeading = 0.3;         // radians south of east
constexpr double kKeepWithin =
    30000;  // largest distance from the eye to the origin, metres; exceeded while cracks are metered
constexpr int kMetered = 8;     // frames on the way out
constexpr double kPanel = 700;  // units of the sheet

// Position in samples of the ground after that many metres of flight.
glm::dvec2 along(glm::dvec2 home, double metres, double cell) {
  return home + glm::dvec2(std::cos(kHeading), std::sin(kHeading)) * (metres / cell);
}

class Flight {
 public:
  Flight(const Case& at, const RunOptions& options, Recorder& recorder)
      : far_(static_cast<float>(1000 * at.parameters.number("far"))),
        step_(at.parameters.number("step")),
        steps_(std::max(1, static_cast<int>(std::lround(1000 * at.parameters.number("distance") / step_)))),
        window_(at.integer("window")),
        recorder_(recorder) {
    ground_.seed = options.seed;
    heights_ = endless_heights(ground_);
    home_ = glm::dvec2(std::round(1000 * at.parameters.number("home") / std::sqrt(2) / ground_.cell));
    clipmap_ = std::make_unique<Clipmap>(endless_heights(ground_), window_);
    expected_ = Strips(clipmap_->window());
  }

  std::string describe() const {
    return fmt::format("endless {} {} {} {} {}", ground_.seed, ground_.cell, ground_.relief,
                       ground_.cell_bits, ground_.octaves);
  }

  void measure(Progress& progress) {
    fly_out(progress);
    recorder_.add("held_far", "B", clipmap_->memory().total());
    come_home(progress);
    recorder_.add("held_home", "B", clipmap_->memory().total());
    recorder_.add("flight_bytes", "B", uploaded_);
    recorder_.add("flight_strip_bytes", "B", strips_);
    recorder_.add("levels", "", clipmap_->levels());
  }

  // The view from home, without and with wires.
  void draw(const std::string& renderer, const std::string& suffix) {
    const View view = seen_from(home_, kPictureHeight);
    const auto context = open_context(renderer, view.width, view.height);
    std::vector<figures::Panel> panels;
    for (const bool wires : {false, true}) {
      const Frame& frame = clipmap_->update(view);
      FrameRenderer shown(*context);
      shown.draw(frame, view,
                 {.lowest = -0.33F * ground_.relief,
                  .highest = 0.33F * ground_.relief,
                  .background = {205, 220, 235},
                  .wire_width = wires ? 1.0F : 0.0F,
                  .wire_opacity = 0.3F});
      shown.finish();
      const std::string triangles = format_number(static_cast<double>(frame.stats.triangles));
      panels.push_back({shown.image(), wires ? fmt::format("{} triangles", triangles)
                                             : fmt::format("Ground to {:g} km, {} levels", far_ / 1000,
                                                           clipmap_->levels())});
    }
    figures::titled_sheet(1, kPanel, 0, panels)
        .write(recorder_.figure(
            "cross.lod-endless" + suffix,
            fmt::format("Endless ground under a clipmap of {} samples per window, from {:g} m above it; the "
                        "hybrid paper's endless terrain (§3.2). Colours by height from {:.0f} to {:.0f} m.",
                        clipmap_->window(), kPictureHeight, -0.33 * ground_.relief, 0.33 * ground_.relief)));
  }

 private:
  void fly_out(Progress& progress) {
    progress.begin("flying over endless ground", static_cast<std::uint64_t>(steps_));
    const Stopwatch watch;
    clipmap_->update(from(home_));
    recorder_.add("first_time", "s", watch.seconds());
    recorder_.add("held_first", "B", clipmap_->memory().total());
    finest_ = finest_level(kEyeHeight, clipmap_->window(), ground_.cell, clipmap_->levels());
    expected_.follow(home_, finest_, clipmap_->levels());
    const int every = std::max(1, steps_ / kMetered);
    for (int k = 1; k <= steps_; ++k) {
      go_to(k);
      if (k % every == 0) meter(at(k));
      progress.advance();
    }
    recorder_.add("gaps", "", gaps_);
    recorder_.add("edges_in_view", "", edges_);
    recorder_.add("metered_frames", "", metered_);
  }

  // Compares the windows after the return with those of a clipmap that has not moved, height by height.
  void come_home(Progress& progress) {
    progress.begin("flying home", static_cast<std::uint64_t>(steps_));
    for (int k = steps_ - 1; k >= 0; --k) {
      go_to(k);
      progress.advance();
    }
    const Frame& back = clipmap_->update(from(home_));
    Clipmap fresh(endless_heights(ground_), window_);
    fresh.move_origin(clipmap_->origin());
    const Frame& never_left = fresh.update(from(home_));
    std::size_t different = 0, compared = 0;
    for (std::size_t l = 0; l < back.clip_levels.size(); ++l) {
      const ClipLevel &a = back.clip_levels[l], &b = never_left.clip_levels[l];
      different += a.corner != b.corner ? 1 : 0;
      const int mask = a.side - 1, n = clipmap_->window();
      for (int z = a.corner.y; z < a.corner.y + n; ++z) {
        for (int x = a.corner.x; x < a.corner.x + n; ++x, ++compared) {
          const std::size_t sample = static_cast<std::size_t>(z & mask) * a.side + (x & mask);
          different += a.heights[sample] != b.heights[sample] ? 1 : 0;
        }
      }
    }
    recorder_.add("heights_compared", "", compared);
    recorder_.add("heights_differing", "", different);
  }

  glm::dvec2 at(int k) const { return along(home_, k * step_, ground_.cell); }

  // Keeps the origin near the eye, so that the view's floats resolve millimetres.
  View from(glm::dvec2 eye) {
    const glm::dvec2 away = (eye - glm::dvec2(clipmap_->origin())) * static_cast<double>(ground_.cell);
    if (std::max(std::abs(away.x), std::abs(away.y)) > kKeepWithin)
      clipmap_->move_origin(glm::ivec2(glm::floor(eye)));
    return seen_from(eye, kEyeHeight);
  }

  View seen_from(glm::dvec2 eye, double above) {
    const glm::dvec2 metres = (eye - glm::dvec2(clipmap_->origin())) * static_cast<double>(ground_.cell);
    float ground = 0;
    const glm::ivec2 sample(glm::floor(eye));
    heights_->read(0, sample.x, sample.y, 1, 1, &ground, 1);
    View view;
    view.width = 1400;
    view.height = 520;
    view.vertical_fov = 0.6F;
    view.near = 10;
    view.far = far_;
    view.eye = {metres.x, ground + above, metres.y};
    view.target = view.eye + glm::vec3(std::cos(kHeading), -0.13, std::sin(kHeading));
    return view;
  }

  void go_to(int k) {
    const View view = from(at(k));
    const Stopwatch watch;
    const Frame& frame = clipmap_->update(view);
    recorder_.add_frame("update_time", "s", watch.seconds());
    recorder_.add_frame("frame_bytes", "B", frame.stats.bytes_uploaded);
    recorder_.add_frame("triangles", "", frame.stats.triangles);
    uploaded_ += frame.stats.bytes_uploaded;
    strips_ += expected_.follow(at(k), finest_, clipmap_->levels());
  }

  // Looks for cracks with the origin moved north-west of all windows: find_cracks() takes coordinates ≤ 0 for
  // a border of the ground. An edge of the ground nearer than the far plane would count as a bare edge.
  void meter(glm::dvec2 eye) {
    const glm::ivec2 before = clipmap_->origin();
    const int span = clipmap_->window() << (clipmap_->levels() - 1);
    clipmap_->move_origin(glm::ivec2(glm::floor(eye)) - span);
    const View view = seen_from(eye, kEyeHeight);
    const Frame& frame = clipmap_->update(view);
    uploaded_ += frame.stats.bytes_uploaded;  // 0: moving the origin changes no window
    const CrackReport cracks = find_cracks(frame, INT_MAX, INT_MAX, view);
    gaps_ += cracks.gaps + cracks.overlaps + cracks.flipped + cracks.t_junctions;
    edges_ += cracks.bare_edges;
    ++metered_;
    clipmap_->move_origin(before);
  }

  EndlessGround ground_;
  float far_;
  double step_;
  int steps_, window_, finest_ = 0;
  Recorder& recorder_;
  glm::dvec2 home_{0};
  std::unique_ptr<HeightSource> heights_;
  std::unique_ptr<Clipmap> clipmap_;
  Strips expected_{0};
  std::size_t uploaded_ = 0, strips_ = 0;
  std::size_t gaps_ = 0, edges_ = 0, metered_ = 0;
};

std::vector<Case> cases(const RunOptions&) {
  std::vector<Case> cases;
  for (const auto& [name, home] : {std::pair{"home", 0.0}, std::pair{"far", 5000000.0}}) {
    cases.push_back({name, {kSpecs, {{"home", home}}}});
  }
  return cases;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  Flight flight(at, options, recorder);
  recorder.terrain("endless noise", checksum(flight.describe()));
  flight.measure(progress);
  flight.draw(options.renderer, at.parameters.number("home") == 0 ? "" : ".far");
}

}  // namespace

extern const Experiment kLodEndless{
    "cross.lod-endless", "A clipmap over ground without bounds", kSpecs, cases, measure, Experiment::kTimed};

}  // namespace terrabench::cross
