// Level-of-detail methods of cross.scale: each cost against the size of the ground, along one path at one
// error on the screen. The theory is that of the registry (LodGrowth).
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "experiments/cross/lod/flight.h"
#include "experiments/cross/scale/run.h"
#include "experiments/ground.h"
#include "lod/camera/camera_path.h"

namespace terrabench::cross {
namespace {

constexpr std::string_view kPath = "low";
constexpr int kTunedSide = 257, kTunedFrames = 6;
constexpr int kFrames = 100, kFramesPerSample = 10;
constexpr float kMiddle = 3840;  // metres from two sides of every ground to the middle of the path
// Side of the smallest ground that is walked on. On less, much of what is in view lies beyond the ground's
// edge, so that the share of the ground in view, which in theory is the same at any size, grows with it.
constexpr int kSmallestWalk = 513;

// The path `low`, turned by a quarter around a place that has the same ground at any size, so that it looks
// towards the ground that larger sizes add.
std::vector<View> same_flight(const Heightfield& ground) {
  CameraPath path = camera_path(kPath);
  path.origin = {kMiddle / ground.extent_x(), kMiddle / ground.extent_z()};
  for (Keyframe& key : path.keyframes) {
    key.at = {-key.at.y, key.at.x};
    key.look_at = {-key.look_at.y, key.look_at.x};
  }
  std::vector<View> all = views(path, ground);
  all.resize(std::min<std::size_t>(all.size(), kFrames + 1));
  return all;
}

struct LodCosts {
  explicit LodCosts(const std::optional<LodGrowth>& theory)
      : build("build", "s", of(theory, &LodGrowth::build)),
        bytes("bytes", "B", of(theory, &LodGrowth::memory), theory && theory->windows),
        update("update", "s", of(theory, &LodGrowth::update), theory && theory->update == 0),
        uploaded("uploaded", "B", of(theory, &LodGrowth::update), theory && theory->update == 0),
        triangles("triangles", "", of(theory, &LodGrowth::update), theory && theory->update == 0) {}

  static std::optional<double> of(const std::optional<LodGrowth>& theory, double LodGrowth::*cost) {
    return theory ? std::optional((*theory).*cost) : std::nullopt;
  }

  Cost build, bytes, update, uploaded, triangles;
};

// Updates along the path, the mean of kFramesPerSample frames at a time: reading the clock takes a good part
// of a microsecond.
void follow(Lod& method, const std::vector<View>& path, double columns, LodCosts& costs) {
  const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
  double sent = 0, drawn = 0;
  for (std::size_t i = 1; i + kFramesPerSample <= path.size(); i += kFramesPerSample) {
    const double begin = thread_seconds();
    for (std::size_t k = i; k < i + kFramesPerSample; ++k) {
      const FrameStats& stats = method.update(path[k]).stats;
      sent += static_cast<double>(stats.bytes_sent());
      drawn += static_cast<double>(stats.triangles);
    }
    costs.update.add(columns, (thread_seconds() - begin) / kFramesPerSample);
  }
  const auto frames = static_cast<double>(path.size() - 1);
  costs.uploaded.add(columns, sent / frames);
  costs.triangles.add(columns, drawn / frames);
}

}  // namespace

void measure_lod(const Run& run, std::string_view name) {
  ConfiguredMethod method = configured(name, "");
  const std::optional<LodGrowth>& theory = method.type->growth;
  if (theory && !theory->option.empty()) method.options.set_from_text(std::string(theory->option));
  const Tuned tuned = tune_to(
      flight_along({"hills", std::string(kPath), kTunedSide, kTunedFrames, run.seed()}, run.progress()),
      method, run.at().parameters.number("pixels"), run.progress());
  SizePlan plan = run.plan("update", 1, {1, 1});
  LodCosts costs(theory);
  Progress silent;
  run.at_each_side(fmt::format("{} on growing ground", name), false, [&](int side) {
    const double columns = squared(side);
    run.measured(plan, columns, [&] {
      const Heightfield ground = noise_hills(side, run.seed());
      std::unique_ptr<Lod> built;
      run.add_samples(
          costs.build, columns, [&] { built.reset(); }, [&] { built = method.build(ground, silent); });
      if (side < kSmallestWalk) return;
      const std::vector<View> path = same_flight(ground);
      built->tune(tuned.knob);
      built->update(path.front());
      follow(*built, path, columns, costs);
      costs.bytes.add(columns, static_cast<double>(built->memory().total()));
    });
  });
  plan.record(run.recorder());
  for (const Cost* const cost :
       {&costs.build, &costs.bytes, &costs.update, &costs.uploaded, &costs.triangles}) {
    cost->record(run.recorder());
  }
}

}  // namespace terrabench::cross
