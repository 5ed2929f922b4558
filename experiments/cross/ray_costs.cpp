// Rays on a representation, its own way and through its mesh.
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "experiments/cross/representation_costs.h"
#include "experiments/stopwatch.h"
#include "renderers/raytrace/ray_index.h"
#include "representations/ray_cast.h"
#include "terrain/memory.h"

namespace terrabench::cross {
namespace {

constexpr std::size_t kSamples = 9;

class Numbers {
 public:
  float between(float low, float high) {
    return low + (high - low) * 0x1p-24F * static_cast<float>(random_() >> 8);
  }
  std::size_t below(std::size_t n) { return random_() % n; }

 private:
  std::mt19937 random_{2};
};

glm::vec3 towards(float azimuth, float elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
          std::cos(elevation) * std::sin(azimuth)};
}

// From a plane above the ground, 15° to 90° down.
std::vector<Ray> rays_from_above(const GroundLines& lines, std::size_t n) {
  constexpr float kTurn = 2 * std::numbers::pi_v<float>;
  const Bounds& bounds = lines.bounds;
  const float height = bounds.high.y + 0.1F * bounds.size().y;
  Numbers numbers;
  std::vector<Ray> rays(n);
  for (Ray& ray : rays) {
    ray.origin = {numbers.between(bounds.low.x, bounds.high.x), height,
                  numbers.between(bounds.low.z, bounds.high.z)};
    const float azimuth = numbers.between(0, kTurn);
    ray.direction = towards(azimuth, -numbers.between(kTurn / 24, kTurn / 4));
  }
  return rays;
}

// From a little above random lines of the ground, nearly level.
std::vector<Ray> rays_along_ground(const GroundLines& lines, std::size_t n) {
  constexpr float kTurn = 2 * std::numbers::pi_v<float>, kSteepest = kTurn / 60;
  const float lift = 0.02F * lines.bounds.size().y;
  Numbers numbers;
  std::vector<Ray> rays;
  rays.reserve(n);
  while (rays.size() < n) {
    const std::size_t c = numbers.below(lines.parts.lines());
    const float azimuth = numbers.between(0, kTurn), elevation = numbers.between(-kSteepest, kSteepest);
    const auto line = lines.parts.line(c);
    const float y = line.empty() ? lines.bounds.low.y : line.back().top;
    rays.push_back({{lines.x[c], y + lift, lines.z[c]}, towards(azimuth, elevation)});
  }
  return rays;
}

struct Shot {
  std::array<double, kSamples> seconds{};
  std::vector<float> distances;
};

// Casts all rays kSamples times on one thread, after a first time that fills the caches.
template <class Cast>
Shot shoot(std::span<const Ray> rays, const Cast& cast) {
  Shot shot;
  shot.distances.resize(rays.size());
  cast(rays, std::span(shot.distances));
  for (std::size_t k = 0; k < kSamples; ++k) {
    shot.seconds[k] = processor_seconds([&] { cast(rays, std::span(shot.distances)); });
  }
  return shot;
}

Shot shoot(std::span<const Ray> rays, const RayIndex& index) {
  std::vector<RayHit> hits(rays.size());
  return shoot(rays, [&](std::span<const Ray> all, std::span<float> distances) {
    index.closest(all, hits);
    for (std::size_t r = 0; r < all.size(); ++r) distances[r] = hits[r].distance;
  });
}

std::size_t agreeing(std::span<const float> a, std::span<const float> b, float within) {
  std::size_t n = 0;
  for (std::size_t r = 0; r < a.size(); ++r) {
    n += std::isinf(a[r]) || std::isinf(b[r]) ? std::isinf(a[r]) == std::isinf(b[r])
                                              : std::abs(a[r] - b[r]) <= within;
  }
  return n;
}

}  // namespace

void measure_rays(const Scene& scene, const Representation& built, const TriangleMesh& mesh, int count,
                  Recorder& recorder) {
  const auto n = static_cast<std::size_t>(count);
  Stopwatch watch;
  const RayIndex index(mesh);
  recorder.add("embree_time", "s", watch.seconds());
  recorder.add("embree_bytes", "B", static_cast<double>(index.bytes()));
  watch = {};
  const std::unique_ptr<RayCaster> own = own_ray_caster(built);
  if (own) {
    recorder.add("ray_index_time", "s", watch.seconds());
    recorder.add("ray_index_bytes", "B", own->bytes());
  }
  recorder.add("own_rays", "", own ? 1 : 0);
  std::size_t agree = 0, hits = 0;
  std::array<double, kSamples> own_seconds{}, embree_seconds{};  // of all rays
  for (const bool above : {true, false}) {
    const std::vector<Ray> rays = above ? rays_from_above(scene.lines, n) : rays_along_ground(scene.lines, n);
    const Shot embree = shoot(rays, index);
    const Shot shot = own ? shoot(rays, [&](auto all, auto out) { own->closest(all, out); }) : embree;
    for (const float distance : embree.distances) hits += std::isfinite(distance);
    agree += agreeing(shot.distances, embree.distances, scene.cell);
    for (std::size_t k = 0; k < kSamples; ++k) {
      own_seconds[k] += shot.seconds[k];
      embree_seconds[k] += embree.seconds[k];
      recorder.add(above ? "rays_above" : "rays_along", "1/s", static_cast<double>(n) / shot.seconds[k]);
      recorder.add(above ? "embree_above" : "embree_along", "1/s",
                   static_cast<double>(n) / embree.seconds[k]);
    }
  }
  recorder.add("ray_hits", "", static_cast<double>(hits) / static_cast<double>(2 * n));
  if (!own) return;
  recorder.add("ray_agreement", "", static_cast<double>(agree) / static_cast<double>(2 * n));
  for (std::size_t k = 0; k < kSamples; ++k) {
    recorder.add("rays", "1/s", static_cast<double>(2 * n) / own_seconds[k]);
    recorder.add("embree_rays", "1/s", static_cast<double>(2 * n) / embree_seconds[k]);
  }
}

}  // namespace terrabench::cross
