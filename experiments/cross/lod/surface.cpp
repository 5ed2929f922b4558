// Where the drawn ground stands against the true ground: above and below it, through water, and under what
// collides with it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "experiments/cross/lod/tuned_cases.h"
#include "experiments/stopwatch.h"
#include "lod/meters/drawn_surface.h"
#include "lod/meters/signed_error.h"

namespace terrabench::cross {
namespace {

constexpr double kWater = 0.25;        // height of the water, as a share of the ground's relief
constexpr std::size_t kPoints = 4096;  // per metered frame, in view; and as many again near the eye
constexpr double kNear = 32;           // cells from the eye

struct Point {
  double x, z;  // samples
};

// Cells in view whose corners all are visible, as the number of their low corner; those within `reach` cells
// of the eye.
std::vector<std::size_t> visible_cells(const SeenSamples& seen, double reach) {
  const double eye_x = static_cast<double>(seen.view().eye.x) / static_cast<double>(seen.cell_x()),
               eye_z = static_cast<double>(seen.view().eye.z) / static_cast<double>(seen.cell_z());
  std::vector<std::size_t> cells;
  for (int j = 0; j + 1 < seen.depth(); ++j) {
    for (int i = 0; i + 1 < seen.width(); ++i) {
      if (std::hypot(i + 0.5 - eye_x, j + 0.5 - eye_z) > reach) continue;
      const bool all = seen.at(i, j) == Seen::kVisible && seen.at(i + 1, j) == Seen::kVisible &&
                       seen.at(i, j + 1) == Seen::kVisible && seen.at(i + 1, j + 1) == Seen::kVisible;
      if (all)
        cells.push_back(static_cast<std::size_t>(j) * static_cast<std::size_t>(seen.width()) +
                        static_cast<std::size_t>(i));
    }
  }
  return cells;
}

// Random points on the cells; the same for every method and standard library.
std::vector<Point> points_on(const std::vector<std::size_t>& cells, int width, std::mt19937_64& random) {
  std::vector<Point> points;
  if (cells.empty()) return points;
  points.reserve(kPoints);
  const auto share = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
  for (std::size_t k = 0; k < kPoints; ++k) {
    const std::size_t cell = cells[random() % cells.size()], across = static_cast<std::size_t>(width);
    const double x = static_cast<double>(cell % across) + share();
    points.push_back({x, static_cast<double>(cell / across) + share()});
  }
  return points;
}

// Of the drawn surface's height over points, against the true height; metres.
struct Collisions {
  std::size_t points = 0, missed = 0;  // missed: nothing is drawn there
  double largest = 0, squares = 0;

  void add(double drawn, double real) {
    if (std::isnan(drawn)) {
      ++missed;
      return;
    }
    ++points;
    largest = std::max(largest, std::abs(drawn - real));
    squares += (drawn - real) * (drawn - real);
  }
  void record(const std::string& prefix, Recorder& recorder) const {
    recorder.add(prefix + "points", "", points);
    recorder.add(prefix + "missed", "", missed);
    if (points == 0) return;
    recorder.add(prefix + "largest", "m", largest);
    recorder.add(prefix + "rms", "m", std::sqrt(squares / static_cast<double>(points)));
  }
};

void collide(const DrawnSurface& surface, const Heightfield& ground, const std::vector<Point>& points,
             Collisions& collisions, Recorder& recorder) {
  if (points.empty()) return;
  std::vector<float> heights(points.size());
  const double time = processor_seconds([&] {
    for (std::size_t k = 0; k < points.size(); ++k) heights[k] = surface.height(points[k].x, points[k].z);
  });
  recorder.add_frame("queries", "1/s", static_cast<double>(points.size()) / time);
  for (std::size_t k = 0; k < points.size(); ++k)
    collisions.add(static_cast<double>(heights[k]), height_on_cells(ground, points[k].x, points[k].z));
}

void record(const SignedError& error, Recorder& recorder) {
  recorder.add("samples", "", error.samples());
  recorder.add("above_largest", "m", error.above_largest());
  recorder.add("above_rms", "m", error.above_rms());
  recorder.add("below_largest", "m", error.below_largest());
  recorder.add("below_rms", "m", error.below_rms());
  recorder.add("under_water", "", error.under_water());
  recorder.add("over_water", "", error.over_water());
  recorder.add("poking", "", error.poking());
  recorder.add("flooded", "", error.flooded());
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TunedMethod tuned = tune_case(at, options, recorder, progress);
  const Flight& flight = tuned.flight;
  const Heightfield& ground = flight.ground();
  const double water = flight.lowest + kWater * (flight.highest - flight.lowest);
  const std::unique_ptr<Lod> lod = tuned.build(progress);
  SignedError error(water);
  Collisions in_view, near;
  std::mt19937_64 random(options.seed);
  progress.begin("colliding with what is drawn", flight.metered.size());
  for (std::size_t k = 0; k < flight.metered.size(); ++k) {
    const Frame& frame = lod->update(flight.views[flight.metered[k]]);
    error.add(SurfaceRaster(frame, ground.width, ground.depth), ground, flight.seen[k]);
    const Stopwatch watch;
    const DrawnSurface surface(frame, ground.width, ground.depth);
    recorder.add_frame("index_time", "s", watch.seconds());
    recorder.add_frame("index_bytes", "B", surface.bytes());
    for (const auto& [reach, collisions] :
         {std::pair{std::numeric_limits<double>::infinity(), &in_view}, std::pair{kNear, &near}}) {
      collide(surface, ground, points_on(visible_cells(flight.seen[k], reach), ground.width, random),
              *collisions, recorder);
    }
    progress.advance();
  }
  progress.end();
  record(error, recorder);
  in_view.record("collision_", recorder);
  near.record("near_", recorder);
}

}  // namespace

extern const Experiment kLodSurface{
    "cross.lod-surface", "The drawn ground against the true ground", kTunedSpecs, tuned_cases, measure,
    Experiment::kTimed};

}  // namespace terrabench::cross
