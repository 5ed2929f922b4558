// Rays on a representation, its own way and through its mesh.
#include <cmath>
#include <numbers>
#include <utility>

#include "experiments/cross/representations/representation_costs.h"
#include "experiments/cross/workloads.h"
#include "experiments/stopwatch.h"
#include "renderers/raytrace/ray_index.h"
#include "representations/ray_cast.h"
#include "terrain/memory.h"

namespace terrabench::cross {
namespace {

constexpr std::uint64_t kSeed = 2;

glm::vec3 towards(float azimuth, float elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
          std::cos(elevation) * std::sin(azimuth)};
}

// From a plane above the ground, 15° to 90° down.
std::vector<Ray> rays_from_above(const GroundLines& lines, std::size_t n) {
  constexpr float kTurn = 2 * std::numbers::pi_v<float>;
  const Bounds& bounds = lines.bounds;
  const float height = bounds.high.y + 0.1F * bounds.size().y;
  Numbers numbers(kSeed);
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
  Numbers numbers(kSeed);
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

// The same rays, cast in two ways. They are cast twice on one thread: once to fill its caches, then timed.
class Shots {
 public:
  Shots(std::vector<Ray> rays, const RayIndex& index, const RayCaster* own)
      : rays_(std::move(rays)), index_(index), own_(own), hits_(rays_.size()), distances_(rays_.size()) {}

  // Distances to what is hit, infinite where nothing is.
  std::span<const float> through_mesh() {
    index_.closest(rays_, hits_);
    for (std::size_t r = 0; r < rays_.size(); ++r) distances_[r] = hits_[r].distance;
    return distances_;
  }
  std::span<const float> own_way() {
    if (own_ == nullptr) return through_mesh();
    own_->closest(rays_, distances_);
    return distances_;
  }
  double seconds_through_mesh() {
    return warm_seconds([&] { through_mesh(); });
  }
  double seconds_own_way() {
    return warm_seconds([&] { own_way(); });
  }

 private:
  template <class Cast>
  static double warm_seconds(const Cast& cast) {
    processor_seconds(cast);
    return processor_seconds(cast);
  }

  std::vector<Ray> rays_;
  const RayIndex& index_;
  const RayCaster* own_;
  std::vector<RayHit> hits_;
  std::vector<float> distances_;
};

std::size_t agreeing(std::span<const float> a, std::span<const float> b, float within) {
  std::size_t n = 0;
  for (std::size_t r = 0; r < a.size(); ++r) {
    n += std::isinf(a[r]) || std::isinf(b[r]) ? std::isinf(a[r]) == std::isinf(b[r])
                                              : std::abs(a[r] - b[r]) <= within;
  }
  return n;
}

// What casts the rays of one case; kept alive until its samples are taken.
struct Casters {
  Casters(const Scene& scene, std::unique_ptr<RayIndex> mesh, std::unique_ptr<RayCaster> own_way,
          std::size_t n)
      : index(std::move(mesh)),
        own(std::move(own_way)),
        above(rays_from_above(scene.lines, n), *index, own.get()),
        along(rays_along_ground(scene.lines, n), *index, own.get()) {}

  std::unique_ptr<RayIndex> index;
  std::unique_ptr<RayCaster> own;
  Shots above, along;
};

// All in one piece of work, so that sums are of the same repetition.
void add_samples(const std::shared_ptr<Casters>& casters, double n, Samples& samples) {
  if (!casters->own) {
    samples.add({"embree_above", "rays_above", "embree_along", "rays_along"}, "1/s", [casters, n] {
      const double above = n / casters->above.seconds_through_mesh(),
                   along = n / casters->along.seconds_through_mesh();
      return std::vector{above, above, along, along};
    });
    return;
  }
  samples.add({"embree_above", "rays_above", "embree_along", "rays_along", "rays", "embree_rays"}, "1/s",
              [casters, n] {
                const double mesh_above = casters->above.seconds_through_mesh(),
                             own_above = casters->above.seconds_own_way(),
                             mesh_along = casters->along.seconds_through_mesh(),
                             own_along = casters->along.seconds_own_way();
                return std::vector{n / mesh_above,
                                   n / own_above,
                                   n / mesh_along,
                                   n / own_along,
                                   2 * n / (own_above + own_along),
                                   2 * n / (mesh_above + mesh_along)};
              });
}

}  // namespace

void measure_rays(const Scene& scene, const Representation& built, const TriangleMesh& mesh, int count,
                  Recorder& recorder, Samples& samples) {
  const auto n = static_cast<std::size_t>(count);
  auto index = std::make_unique<RayIndex>(mesh);
  recorder.add("embree_bytes", "B", static_cast<double>(index->bytes()));
  std::unique_ptr<RayCaster> own = built.ray_caster();
  if (own) recorder.add("ray_index_bytes", "B", own->bytes());
  const auto casters = std::make_shared<Casters>(scene, std::move(index), std::move(own), n);
  std::size_t agree = 0, hits = 0;
  for (Shots* const shots : {&casters->above, &casters->along}) {
    const std::span<const float> found = shots->through_mesh();
    const std::vector<float> through_mesh(found.begin(), found.end());
    for (const float distance : through_mesh) hits += std::isfinite(distance);
    agree += agreeing(shots->own_way(), through_mesh, scene.cell);
  }
  recorder.add("ray_hits", "", static_cast<double>(hits) / static_cast<double>(2 * n));
  if (casters->own) {
    recorder.add("ray_agreement", "", static_cast<double>(agree) / static_cast<double>(2 * n));
  }
  add_samples(casters, static_cast<double>(n), samples);
}

}  // namespace terrabench::cross
