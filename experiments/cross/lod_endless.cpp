#include <fmt/format.h>

#include <array>
#include <climits>
#include <cmath>
#include <memory>

#include "experiments/cross/strips.h"
#include "experiments/experiment.h"
#include "experiments/figures/sheet.h"
#include "experiments/stopwatch.h"
#include "lod/clipmap/clipmap.h"
#include "lod/clipmap/endless_heights.h"
#include "lod/meters/cracks.h"
#include "renderers/frame_renderer.h"
#include "results/format.h"
#include "terrain/files.h"

namespace terrabench::cross {
namespace {

const std::array kSpecs{
    ParameterSpec{"window", std::int64_t{255}, "samples", "of each clipmap level", 15, 4095},
    ParameterSpec{"distance", 200.0, "km", "of the flight, and of the way back", 1, 5000},
    ParameterSpec{"step", 100.0, "m", "between frames", 10, 100000},
    ParameterSpec{"far", 150.0, "km", "to the far plane", 1, 10000},
    ParameterSpec{"home", 0.0, "km", "south-east of sample 0, where the flight begins", 0, 10000000},
};
constexpr double kEyeHeight = 400;       // metres above the ground
constexpr double kPictureHeight = 2500;  // over the peaks around, so that the horizon is seen
constexpr double kHeading = 0.3;         // radians south of east
constexpr double kKeepWithin = 30000;    // metres from what stands at x = z = 0, as long as no meter looks
constexpr int kMetered = 8;              // frames on the way out
constexpr double kGap = 14, kPanel = 700, kLabel = 30;  // units of the sheet

// Where the eye is, in samples of the ground.
glm::dvec2 along(glm::dvec2 home, double metres, double cell) {
  return home + glm::dvec2(std::cos(kHeading), std::sin(kHeading)) * (metres / cell);
}

class Flight {
 public:
  Flight(const Case& at, const RunOptions& options, Recorder& recorder)
      : far_(static_cast<float>(1000 * at.parameters.number("far"))),
        step_(at.parameters.number("step")),
        steps_(std::max(1, static_cast<int>(std::lround(1000 * at.parameters.number("distance") / step_)))),
        window_(static_cast<int>(at.parameters.integer("window"))),
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

  // The view from home, as it is and with its wires.
  void draw(const std::string& renderer, const std::string& suffix) {
    const View view = seen_from(home_, kPictureHeight);
    const auto context = open_context(renderer, view.width, view.height);
    figures::Sheet sheet(kPanel + 2 * kGap, 2 * (kPanel * view.height / view.width + kLabel) + kGap);
    double y = 0;
    for (const float wires : {0.0F, 1.0F}) {
      const Frame& frame = clipmap_->update(view);
      FrameRenderer shown(*context);
      shown.draw(frame, view,
                 {.lowest = -0.33F * ground_.relief,
                  .highest = 0.33F * ground_.relief,
                  .background = {205, 220, 235},
                  .wire_width = wires,
                  .wire_opacity = 0.3F});
      shown.finish();
      sheet.text(kGap, y + kLabel - 8,
                 wires == 0 ? fmt::format("Ground to {:g} km, {} levels", far_ / 1000, clipmap_->levels())
                            : fmt::format("Its {} triangles",
                                          format_number(static_cast<double>(frame.stats.triangles))),
                 16);
      const double height = kPanel * view.height / view.width;
      sheet.picture(kGap, y + kLabel, kPanel, height, shown.image());
      y += kLabel + height;
    }
    sheet.write(recorder_.figure(
        "cross.lod-endless" + suffix, "png",
        fmt::format("Endless ground under a clipmap of {} samples a window, from {:g} m above it; the hybrid "
                    "paper's endless terrain (§3.2). Colours by height from {:.0f} to {:.0f} m.",
                    clipmap_->window(), kPictureHeight, -0.33 * ground_.relief, 0.33 * ground_.relief)));
  }

 private:
  void fly_out(Progress& progress) {
    progress.begin("flying over endless ground", static_cast<std::uint64_t>(steps_));
    const Stopwatch watch;
    const Frame& first = clipmap_->update(from(home_));
    recorder_.add("first_time", "s", watch.seconds());
    recorder_.add("first_bytes", "B", first.stats.bytes_uploaded);
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

  // Home again, the windows are held against ones that never left: as many heights as differ.
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
    for (std::size_t l = 0; l < back.levels.size(); ++l) {
      const ClipLevel &a = back.levels[l], &b = never_left.levels[l];
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

  // Metres are counted from near the eye, so that the view's floats keep millimetres.
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
    recorder_.add("update_time", "s", watch.seconds());
    recorder_.add("frame_bytes", "B", frame.stats.bytes_uploaded);
    recorder_.add("triangles", "", frame.stats.triangles);
    uploaded_ += frame.stats.bytes_uploaded;
    strips_ += expected_.follow(at(k), finest_, clipmap_->levels());
  }

  // Of the same windows, counted from a sample north-west of them all: the meter takes coordinates of 0 and
  // less for a border. An edge of the ground within the far plane would show as bare.
  void meter(glm::dvec2 eye) {
    const glm::ivec2 before = clipmap_->origin();
    const int span = clipmap_->window() << (clipmap_->levels() - 1);
    clipmap_->move_origin(glm::ivec2(glm::floor(eye)) - span);
    const View view = seen_from(eye, kEyeHeight);
    const Frame& frame = clipmap_->update(view);
    uploaded_ += frame.stats.bytes_uploaded;  // none: another origin changes no window
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
    cases.push_back({name, {kSpecs, {{"home", home}}}, ""});
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

extern const Experiment kLodEndless{"cross.lod-endless", "A clipmap over ground without bounds", kSpecs,
                                    cases, measure};

}  // namespace terrabench::cross
