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
  bool operator==(const ScreenCorner&) const = default;
};

// Twice the signed area of p, q and the point; of either order of p and q the same but for the sign, to the
// bit. 0 only for p = q: the point counts as displaced by an infinitesimal to the right and a smaller one
// down.
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
    if (a == b || b == c || c == a) return;
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

// The least and largest height of the drawn border near each sample of it. Coarse levels draw the border with
// fewer vertices, the farthest `reach` samples apart, so that it lies between the heights within that reach.
class Border {
 public:
  Border(const Heightfield& ground, const std::vector<glm::vec3>& corners) : ground_(ground) {
    const int x_reach = reach(corners, 0, ground.extent_z(), ground.cell_x),
              z_reach = reach(corners, 2, ground.extent_x(), ground.cell_z);
    for (const int end : {0, 1}) {
      rows_[end] =
          ranges(ground.width, x_reach, [&](int i) { return ground.at(i, end * (ground.depth - 1)); });
      columns_[end] =
          ranges(ground.depth, z_reach, [&](int j) { return ground.at(end * (ground.width - 1), j); });
    }
  }

  // The sums that a line of sight may have: 1 when it leaves the ground's extent below the border.
  std::array<int, 2> sums(const glm::dvec3& eye, const glm::dvec3& direction) const {
    double way = std::numeric_limits<double>::infinity();
    int through = 0;  // axis
    const glm::dvec3 extent(ground_.extent_x(), 0, ground_.extent_z());
    for (const int axis : {0, 2}) {
      if (direction[axis] == 0) continue;
      const double here = ((direction[axis] > 0 ? extent[axis] : 0) - eye[axis]) / direction[axis];
      if (here < way) std::tie(way, through) = std::tuple(here, axis);
    }
    if (std::isinf(way)) return direction.y < 0 ? std::array{1, 1} : std::array{0, 0};
    const glm::dvec3 end = eye + way * direction;
    const std::vector<Range>& side = (through == 0 ? columns_ : rows_)[direction[through] > 0 ? 1 : 0];
    const double at = through == 0 ? end.z / ground_.cell_z : end.x / ground_.cell_x;
    const auto k = static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(side.size() - 1)));
    return {end.y < side[k].low ? 1 : 0, end.y > side[k].high ? 0 : 1};
  }

 private:
  struct Range {
    float low, high;
  };

  // The longest edge along the two borders in direction of the axis, samples.
  static int reach(const std::vector<glm::vec3>& corners, int axis, float far, float cell) {
    const int across = 2 - axis;
    float longest = cell;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const glm::vec3 &p = corners[k], &q = corners[k % 3 == 2 ? k - 2 : k + 1];
      const bool on_border = p[across] == q[across] && (p[across] <= 0 || p[across] >= far);
      if (on_border) longest = std::max(longest, std::abs(q[axis] - p[axis]));
    }
    return static_cast<int>(std::ceil(longest / cell));
  }

  template <class HeightOf>
  static std::vector<Range> ranges(int samples, int reach, const HeightOf& height) {
    std::vector<Range> all;
    for (int i = 0; i < samples; ++i) {
      Range range{height(i), height(i)};
      for (int k = std::max(i - reach, 0); k <= std::min(i + reach + 1, samples - 1); ++k) {
        range = {std::min(range.low, height(k)), std::max(range.high, height(k))};
      }
      all.push_back(range);
    }
    return all;
  }

  const Heightfield& ground_;
  std::array<std::vector<Range>, 2> rows_, columns_;  // north and south; west and east
};

// What a pixel's sum must be. Near the border both: there the pixels' centres decide by rounding.
class Expected {
 public:
  Expected(const Border& border, const View& view, const Projector& project)
      : width_(view.width + 2 * kNear),
        sums_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(view.height + 2 * kNear)) {
    tbb::parallel_for(0, view.height + 2 * kNear, [&](int y) {
      for (int x = 0; x < width_; ++x) {
        sums_[index(x, y)] = border.sums(view.eye, project.direction(x - kNear + 0.5, y - kNear + 0.5));
      }
    });
  }

  // The least and the largest.
  std::array<int, 2> at(int x, int y) const {
    std::array<int, 2> range{1, 0};
    for (int v = y; v <= y + 2 * kNear; ++v) {
      for (int u = x; u <= x + 2 * kNear; ++u) {
        const auto& [least, largest] = sums_[index(u, v)];
        range = {std::min(range[0], least), std::max(range[1], largest)};
      }
    }
    return range;
  }

 private:
  static constexpr int kNear = 2;  // pixels
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }

  int width_;
  std::vector<std::array<int, 2>> sums_;  // with a margin around the picture
};

}  // namespace

BarePixels find_bare_pixels(const Frame& frame, const Heightfield& ground, const View& view) {
  if (!(view.eye.x >= 0 && view.eye.x <= ground.extent_x() && view.eye.z >= 0 &&
        view.eye.z <= ground.extent_z())) {
    throw usage_error("the eye must be over the ground's extent", "eye",
                      "choose another view, or a camera path that stays on the ground (docs/paths.md)");
  }
  Crossings crossings(view);
  std::vector<glm::vec3> corners;
  corners.reserve(3 * frame.stats.triangles);
  triangles(frame, [&](std::span<const glm::vec3> some) {
    corners.insert(corners.end(), some.begin(), some.end());
  });
  tbb::parallel_for(std::size_t{0}, corners.size() / 3,
                    [&](std::size_t t) { crossings.draw(&corners[3 * t]); });
  const Expected expected(Border(ground, corners), view, crossings.project());
  std::atomic<std::size_t> bare = 0, covered = 0;
  tbb::parallel_for(0, view.height, [&](int y) {
    for (int x = 0; x < view.width; ++x) {
      const auto [least, largest] = expected.at(x, y);
      bare += crossings.at(x, y) < least ? 1U : 0U;
      covered += crossings.at(x, y) > largest ? 1U : 0U;
    }
  });
  return {bare, covered};
}

}  // namespace terrabench
