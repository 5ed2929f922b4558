#include "lod/meters/bare_pixels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <tuple>
#include <vector>

#include "lod/meters/projector.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

struct ScreenCorner {
  double x, y;
};

// Twice the signed area of p, q and the point; of either order of p and q the same but for the sign, to the
// bit. Never 0: the point counts as displaced by an infinitesimal to the right and a smaller one down.
double side(ScreenCorner p, ScreenCorner q, double x, double y) {
  const bool swap = std::tie(q.x, q.y) < std::tie(p.x, p.y);
  if (swap) std::swap(p, q);
  const double dx = q.x - p.x, dy = q.y - p.y;
  double at = dx * (y - p.y) - dy * (x - p.x);
  if (at == 0) at = dy != 0 ? -dy : dx;
  return swap ? -at : at;
}

// Per pixel, triangles seen from their front minus those seen from their back.
class Crossings {
 public:
  explicit Crossings(const View& view)
      : width_(view.width),
        height_(view.height),
        near_(view.near),
        project_(view),
        sums_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0) {}

  void draw(const glm::vec3* corners) {
    std::array<ScreenCorner, 4> cut;
    std::size_t n = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 p = corners[k], q = corners[(k + 1) % 3];
      const ScreenPoint at = project_(p);
      if (at.depth >= near_) cut[n++] = {at.x, at.y};
      if ((at.depth < near_) != (project_(q).depth < near_)) cut[n++] = at_near_plane(p, q);
    }
    for (std::size_t k = 2; k < n; ++k) draw(cut[0], cut[k - 1], cut[k]);
  }

  int at(int x, int y) const { return sums_[static_cast<std::size_t>(y) * width_ + x]; }
  const Projector& project() const { return project_; }

 private:
  // The same bits whichever end comes first.
  ScreenCorner at_near_plane(glm::dvec3 p, glm::dvec3 q) const {
    if (std::tie(q.x, q.y, q.z) < std::tie(p.x, p.y, p.z)) std::swap(p, q);
    const double at_p = project_(p).depth - near_, at_q = project_(q).depth - near_;
    const ScreenPoint cut = project_(glm::mix(p, q, at_p / (at_p - at_q)));
    return {cut.x, cut.y};
  }

  void draw(ScreenCorner a, ScreenCorner b, ScreenCorner c) {
    // Clamped before the conversion: beside a near plane a triangle may reach any number of pixels.
    const auto pixel = [](double at, int size) {
      return static_cast<int>(std::floor(std::clamp(at, 0.0, size - 1.0)));
    };
    const auto [left, right] = std::minmax({a.x, b.x, c.x});
    const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
    if (right < 0 || bottom < 0 || left > width_ || top > height_) return;
    for (int y = pixel(top, height_); y <= pixel(bottom, height_); ++y) {
      for (int x = pixel(left, width_); x <= pixel(right, width_); ++x) {
        const double u = side(a, b, x + 0.5, y + 0.5), v = side(b, c, x + 0.5, y + 0.5),
                     w = side(c, a, x + 0.5, y + 0.5);
        if ((u > 0) != (v > 0) || (v > 0) != (w > 0)) continue;
        // Rows run downwards, so counter-clockwise is negative.
        std::atomic_ref<int>(sums_[static_cast<std::size_t>(y) * width_ + x])
            .fetch_add(u < 0 ? 1 : -1, std::memory_order_relaxed);
      }
    }
  }

  int width_, height_;
  double near_;
  Projector project_;
  std::vector<int> sums_;
};

// The least and largest sum that a line of sight may have.
std::array<int, 2> expected(const Heightfield& ground, const glm::dvec3& eye, const glm::dvec3& direction,
                            double focal) {
  double way = std::numeric_limits<double>::infinity();
  const glm::dvec3 extent(ground.extent_x(), 0, ground.extent_z());
  for (const int axis : {0, 2}) {
    if (direction[axis] > 0) way = std::min(way, (extent[axis] - eye[axis]) / direction[axis]);
    if (direction[axis] < 0) way = std::min(way, -eye[axis] / direction[axis]);
  }
  if (std::isinf(way)) return direction.y < 0 ? std::array{1, 1} : std::array{0, 0};
  const glm::dvec3 end = eye + way * direction;
  const float border = ground.sample(std::clamp(static_cast<float>(end.x), 0.0F, ground.extent_x()),
                                     std::clamp(static_cast<float>(end.z), 0.0F, ground.extent_z()));
  const double margin = 2 * way / focal;
  return {end.y < border - margin ? 1 : 0, end.y > border + margin ? 0 : 1};
}

}  // namespace

BarePixels find_bare_pixels(const Frame& frame, const Heightfield& ground, const View& view) {
  if (!(view.eye.x >= 0 && view.eye.x <= ground.extent_x() && view.eye.z >= 0 &&
        view.eye.z <= ground.extent_z())) {
    throw usage_error("the eye must be over the ground's extent", "eye", "choose another view");
  }
  Crossings crossings(view);
  std::vector<glm::vec3> corners;
  corners.reserve(3 * frame.stats.triangles);
  triangles(frame, [&](std::span<const glm::vec3> some) {
    corners.insert(corners.end(), some.begin(), some.end());
  });
  tbb::parallel_for(std::size_t{0}, corners.size() / 3,
                    [&](std::size_t t) { crossings.draw(&corners[3 * t]); });
  std::atomic<std::size_t> bare = 0, covered = 0;
  tbb::parallel_for(0, view.height, [&](int y) {
    for (int x = 0; x < view.width; ++x) {
      const auto [least, largest] = expected(
          ground, view.eye, crossings.project().direction(x + 0.5, y + 0.5), crossings.project().focal());
      bare += crossings.at(x, y) < least ? 1U : 0U;
      covered += crossings.at(x, y) > largest ? 1U : 0U;
    }
  });
  return {bare, covered};
}

}  // namespace terrabench
