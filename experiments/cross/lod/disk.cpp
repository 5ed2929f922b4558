// A clipmap over ground that stays on disk: steps of one sample, then a walk across. The case has a process
// of its own, whose peak memory is that of the walk.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/cross/files/temporary_folder.h"
#include "experiments/cross/lod/ground_on_disk.h"
#include "experiments/cross/lod/strips.h"
#include "experiments/experiment.h"
#include "experiments/stopwatch.h"
#include "lod/camera/camera_path.h"
#include "lod/clipmap/clipmap.h"
#include "terrain/error.h"

namespace terrabench::cross {
namespace {

namespace fs = std::filesystem;

const std::array kSpecs{
    kMountainsSide,
    ParameterSpec{"window", std::int64_t{255}, "samples", "side of each clipmap level", 15, 4095},
    ParameterSpec{"steps", std::int64_t{1000}, "frames", "steps of one sample before the long walk", 1,
                  1000000},
};
constexpr int kPlanSamples = 1025;  // largest side of the thinned copy of the ground that camera paths use
constexpr float kEyeHeight = 1.8F;  // metres

std::uintmax_t bytes_of(const fs::path& folder) {
  std::uintmax_t bytes = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) bytes += entry.file_size();
  return bytes;
}

// Position after k steps of a walk back and forth between samples 0 and last, from `start`.
int to_and_fro(std::int64_t start, std::int64_t k, std::int64_t last) {
  if (last == 0) return 0;
  const std::int64_t at = (start + k) % (2 * last);
  return static_cast<int>(at <= last ? at : 2 * last - at);
}

// Views along the built-in path "cross", laid over a thinned copy of the ground.
std::vector<View> walk_across(HeightPyramid& pyramid) {
  int level = 0;
  while (((std::max(pyramid.width(), pyramid.depth()) - 1) >> level) + 1 > kPlanSamples) ++level;
  Heightfield plan;
  plan.width = ((pyramid.width() - 1) >> level) + 1;
  plan.depth = ((pyramid.depth() - 1) >> level) + 1;
  plan.cell_x = pyramid.cell_x() * static_cast<float>(1 << level);
  plan.cell_z = pyramid.cell_z() * static_cast<float>(1 << level);
  plan.heights.resize(static_cast<std::size_t>(plan.width) * plan.depth);
  pyramid.read(level, 0, 0, plan.width, plan.depth, plan.heights.data(), plan.width);
  return views(camera_path("cross"), plan);
}

// The view from 1.8 m above the sample below the eye.
View on_the_ground(View view, HeightPyramid& pyramid) {
  const glm::vec3 sight = view.target - view.eye;
  float height = 0;
  pyramid.read(0, static_cast<int>(view.eye.x / static_cast<double>(pyramid.cell_x())),
               static_cast<int>(view.eye.z / static_cast<double>(pyramid.cell_z())), 1, 1, &height, 1);
  view.eye.y = height + kEyeHeight;
  view.target = view.eye + sight;
  return view;
}

class Walk {
 public:
  Walk(const fs::path& folder, int window) {
    auto pyramid = HeightPyramid::open(folder);
    pyramid_ = pyramid.get();
    clipmap_ = std::make_unique<Clipmap>(heights_on_disk(std::move(pyramid)), window);
    expected_ = Strips(clipmap_->window());
    finest_ = finest_level(kEyeHeight, clipmap_->window(), std::max(pyramid_->cell_x(), pyramid_->cell_z()),
                           clipmap_->levels());
  }

  void measure(int steps, Recorder& recorder, Progress& progress) {
    const std::vector<View> across = walk_across(*pyramid_);
    if (across.empty()) throw usage_error("the ground has a single sample", "", "choose a larger terrain");
    begin(across.front(), recorder);
    View view = across.front();
    const auto start = static_cast<int>(view.eye.x / pyramid_->cell_x());
    progress.begin("stepping over the ground", static_cast<std::uint64_t>(steps));
    for (int k = 1; k <= steps; ++k) {
      // Stays on ground one sample wide; turns back at the border of ground shorter than the steps.
      const float x = pyramid_->cell_x() * static_cast<float>(to_and_fro(start, k, pyramid_->width() - 1));
      view.target.x += x - view.eye.x;
      view.eye.x = x;
      update(view, "step_time", recorder);
      progress.advance();
    }
    finish("step", recorder);
    progress.begin("walking across the ground", across.size());
    for (const View& next : across) {
      update(next, "walk_time", recorder);
      progress.advance();
    }
    finish("walk", recorder);
    recorder.add("clipmap_bytes", "B", clipmap_->memory().total());
  }

 private:
  // Fills all windows.
  void begin(const View& view, Recorder& recorder) {
    update(view, "first_time", recorder);
    uploaded_ = strips_ = 0;
  }
  void update(const View& view, std::string_view metric, Recorder& recorder) {
    const View at = on_the_ground(view, *pyramid_);
    const std::uint64_t tiles = pyramid_->tiles_read();
    const Stopwatch watch;
    const Frame& frame = clipmap_->update(at);
    recorder.add_frame(metric, "s", watch.seconds());
    uploaded_ += frame.stats.bytes_uploaded;
    strips_ += expected_.follow({at.eye.x / static_cast<double>(pyramid_->cell_x()),
                                 at.eye.z / static_cast<double>(pyramid_->cell_z())},
                                finest_, clipmap_->levels());
    tiles_ += pyramid_->tiles_read() - tiles;
  }
  void finish(const std::string& what, Recorder& recorder) {
    recorder.add(what + "_bytes", "B", uploaded_);
    recorder.add(what + "_strip_bytes", "B", strips_);
    recorder.add(what + "_tiles", "", tiles_);
    uploaded_ = strips_ = tiles_ = 0;
  }

  HeightPyramid* pyramid_ = nullptr;  // of the clipmap
  std::unique_ptr<Clipmap> clipmap_;
  Strips expected_{0};
  int finest_ = 0;
  std::size_t uploaded_ = 0, strips_ = 0, tiles_ = 0;
};

void walk(const fs::path& pyramid, const Case& at, Recorder& recorder, Progress& progress) {
  forget_peak();
  Walk(pyramid, at.integer("window")).measure(at.integer("steps"), recorder, progress);
  recorder.add_varying("peak_resident", "B", static_cast<double>(peak_resident_bytes()));
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TemporaryFolder folder;
  const fs::path pyramid = pyramid_of(at, options, folder.path(), recorder, progress);
  if (pyramid != at.terrain) {
    recorder.add("pyramid_bytes", "B", bytes_of(pyramid));
    const auto tiles = HeightPyramid::open(pyramid);
    recorder.add("ground_bytes", "B", 4.0 * tiles->width() * tiles->depth());
  }
  walk(pyramid, at, recorder, progress);
}

std::vector<Case> cases(const RunOptions& options) { return cases_on_disk(kSpecs, options); }

}  // namespace

extern const Experiment kLodDisk{"cross.lod-disk", "A clipmap over ground that stays on disk",
                                 kSpecs,           cases,
                                 measure,          Experiment::kOwnProcess};

}  // namespace terrabench::cross
