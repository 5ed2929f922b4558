#include "representations/ght/triangulate.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <queue>
#include <tuple>

namespace terrabench::ght {
namespace {

// Points by the square that holds them, in one sorted array.
class PointHash {
 public:
  PointHash(std::span<const glm::dvec2> points, double side) : per_side_(1 / side) {
    entries_.reserve(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) entries_.push_back({key(points[i]), i});
    std::sort(entries_.begin(), entries_.end());
  }
  // Calls visit(point) for the points in the box, and perhaps others, until it returns true; whether one did.
  template <class Visit>
  bool any(glm::dvec2 low, glm::dvec2 high, const Visit& visit) const {
    const auto [row_low, column_low] = key(low);
    const auto [row_high, column_high] = key(high);
    // For a box with more rows than there are points, all points are visited.
    if (row_high - row_low > static_cast<std::int64_t>(entries_.size())) {
      return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) { return visit(e.point); });
    }
    for (std::int64_t row = row_low; row <= row_high; ++row) {
      auto at = std::lower_bound(entries_.begin(), entries_.end(), Entry{{row, column_low}, 0});
      for (; at != entries_.end() && at->key <= std::pair(row, column_high); ++at) {
        if (visit(at->point)) return true;
      }
    }
    return false;
  }

 private:
  using Key = std::pair<std::int64_t, std::int64_t>;  // row, column
  struct Entry {
    Key key;
    std::uint32_t point;
    auto operator<=>(const Entry&) const = default;
  };
  Key key(glm::dvec2 p) const {
    return {static_cast<std::int64_t>(std::floor(p.y * per_side_)),
            static_cast<std::int64_t>(std::floor(p.x * per_side_))};
  }

  double per_side_;
  std::vector<Entry> entries_;
};

// Twice the area over the square of the longest side: 0.87 for an equilateral triangle, 0 for a line.
double shape(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  const glm::dvec2 u = b - a, v = c - b, w = a - c;
  const double longest = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)});
  return longest > 0 ? turn(a, b, c) / longest : 0;
}

double mean_side(std::span<const glm::dvec2> points) {
  double length = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    length += glm::distance(points[i], points[(i + 1) % points.size()]);
  }
  return std::max(length / static_cast<double>(points.size()), 1e-9);
}

class EarCutter {
 public:
  // `polygon` lists points in order; a point may come twice, where a bridge leads to and from a hole. `side`
  // is the side of the hash's squares.
  EarCutter(std::span<const glm::dvec2> points, std::vector<std::uint32_t> polygon, double side)
      : points_(points), polygon_(std::move(polygon)), hash_(corners(), side) {
    const std::size_t n = polygon_.size();
    next_.resize(n);
    previous_.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) {
      next_[i] = static_cast<std::uint32_t>((i + 1) % n);
      previous_[i] = static_cast<std::uint32_t>((i + n - 1) % n);
    }
    gone_.assign(n, 0);
    version_.assign(n, 0);
    waiting_.assign(n, kNobody);
  }

  std::optional<std::vector<Triangle>> run(const Joined& joined) {
    std::size_t left = polygon_.size();
    for (std::uint32_t at = 0; at < left; ++at) consider(at);
    while (left > 3 && !candidates_.empty()) {
      const Candidate best = candidates_.top();
      candidates_.pop();
      if (gone_[best.at] != 0 || best.version != version_[best.at]) continue;
      if (const std::uint32_t blocking = blocker(best.at); blocking != kNobody) {
        waits_.push_back({best.at, waiting_[blocking]});
        waiting_[blocking] = static_cast<std::uint32_t>(waits_.size() - 1);
        continue;
      }
      const std::uint32_t before = previous_[best.at], after = next_[best.at];
      if (joined(polygon_[before], polygon_[after])) continue;
      cut(best.at);
      --left;
      for (const std::uint32_t changed : {before, after}) {
        ++version_[changed];
        consider(changed);
      }
      for (std::uint32_t w = waiting_[best.at]; w != kNobody; w = waits_[w].next) consider(waits_[w].at);
    }
    const auto last = static_cast<std::uint32_t>(std::find(gone_.begin(), gone_.end(), 0) - gone_.begin());
    if (left != 3 || turn(corner(previous_[last]), corner(last), corner(next_[last])) < 0)
      return std::nullopt;
    cut(last);
    return std::move(triangles_);
  }

 private:
  std::vector<glm::dvec2> corners() const {
    std::vector<glm::dvec2> all;
    all.reserve(polygon_.size());
    for (const std::uint32_t p : polygon_) all.push_back(points_[p]);
    return all;
  }
  glm::dvec2 corner(std::uint32_t at) const { return points_[polygon_[at]]; }

  // Makes the corner a candidate if it could be an ear. The cheapest leave a short side and are no slivers.
  void consider(std::uint32_t at) {
    const std::uint32_t before = previous_[at], after = next_[at];
    if (gone_[at] != 0 || polygon_[before] == polygon_[after]) return;  // or the bridge's far end
    const glm::dvec2 a = corner(before), b = corner(at), c = corner(after), side = c - a;
    // Points over one another, on a cliff, make a vertical triangle in any case: no worse than others.
    const double form = a == b || b == c ? 1 : shape(a, b, c);
    if (form >= 0) candidates_.push({glm::dot(side, side) / std::max(form, 1e-12), at, version_[at]});
  }

  // A corner that lies inside the ear, or kNobody.
  std::uint32_t blocker(std::uint32_t at) const {
    const std::uint32_t before = previous_[at], after = next_[at];
    const glm::dvec2 a = corner(before), b = corner(at), c = corner(after);
    std::uint32_t found = kNobody;
    const auto blocks = [&](std::uint32_t other) {
      if (gone_[other] != 0 || other == before || other == at || other == after) return false;
      const glm::dvec2 q = corner(other);
      if (q == a || q == b || q == c) return false;
      if (turn(a, b, q) < 0 || turn(b, c, q) < 0 || turn(c, a, q) < 0) return false;
      found = other;
      return true;
    };
    const glm::dvec2 low = {std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})};
    const glm::dvec2 high = {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})};
    hash_.any(low, high, blocks);
    return found;
  }

  void cut(std::uint32_t at) {
    triangles_.push_back({polygon_[previous_[at]], polygon_[at], polygon_[next_[at]]});
    next_[previous_[at]] = next_[at];
    previous_[next_[at]] = previous_[at];
    gone_[at] = 1;
  }

  static constexpr std::uint32_t kNobody = 0xFFFFFFFF;
  struct Candidate {
    double cost;
    std::uint32_t at, version;
    bool operator<(const Candidate& other) const {  // the cheapest is on top
      return cost > other.cost || (cost == other.cost && at > other.at);
    }
  };

  std::span<const glm::dvec2> points_;
  std::vector<std::uint32_t> polygon_, next_, previous_;
  std::vector<std::uint32_t> version_;  // counts the changes of a corner's neighbours
  std::vector<std::uint32_t> waiting_;  // first in the list of corners that this one blocks
  struct Wait {
    std::uint32_t at, next;
  };
  std::vector<Wait> waits_;
  std::vector<char> gone_;
  std::priority_queue<Candidate> candidates_;
  PointHash hash_;
  std::vector<Triangle> triangles_;
};

// Positive when d lies inside the circle through the counter-clockwise a, b, c. Unit: length to the fourth
// power.
double in_circle(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
  a -= d, b -= d, c -= d;
  const auto area = [](glm::dvec2 p, glm::dvec2 q) { return p.x * q.y - p.y * q.x; };
  return glm::dot(a, a) * area(b, c) + glm::dot(b, b) * area(c, a) + glm::dot(c, c) * area(a, b);
}

// Flips edges between two triangles until none has a better diagonal (Lawson 1977), which shortens the long
// edges that ear cutting leaves in narrow places. Half-edge 3t + k runs from corner k of triangle t to the
// next.
class Flipper {
 public:
  Flipper(std::span<const glm::dvec2> points, std::vector<Triangle> triangles, const Joined& joined)
      : points_(points),
        triangles_(std::move(triangles)),
        joined_(joined),
        twin_(3 * triangles_.size(), kNone) {
    struct Half {
      std::uint32_t low, high, half;
    };
    std::vector<Half> halves;
    halves.reserve(twin_.size());
    for (std::uint32_t h = 0; h < twin_.size(); ++h) {
      const auto [low, high] = std::minmax(from(h), from(next(h)));
      halves.push_back({low, high, h});
    }
    std::sort(halves.begin(), halves.end(), [](const Half& a, const Half& b) {
      return std::tie(a.low, a.high, a.half) < std::tie(b.low, b.high, b.half);
    });
    for (std::size_t k = 1; k < halves.size(); ++k) {
      const Half &a = halves[k - 1], &b = halves[k];
      if (a.low == b.low && a.high == b.high) twin_[a.half] = b.half, twin_[b.half] = a.half;
    }
  }

  // Afterwards flips an edge of each triangle that has only points from `first` on and only one neighbour, so
  // that each such point is joined to the other loop.
  std::vector<Triangle> run(std::uint32_t first) {
    std::vector<std::uint32_t> waiting;
    for (std::uint32_t h = 0; h < twin_.size(); ++h) {
      if (h < twin_[h] && twin_[h] != kNone) waiting.push_back(h);
    }
    // Each flip lowers the triangles on the paraboloid over the points. Rounding may hide that, so the number
    // of flips is limited.
    for (std::size_t left = kMostFlips * triangles_.size(); !waiting.empty() && left > 0; --left) {
      const std::uint32_t h = waiting.back();
      waiting.pop_back();
      if (twin_[h] == kNone || !better_across(h)) continue;
      for (const std::uint32_t around : flip(h)) waiting.push_back(around);
    }
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      const Triangle& corners = triangles_[t];
      if (std::any_of(corners.begin(), corners.end(), [&](std::uint32_t p) { return p < first; })) continue;
      const std::array halves = {3 * t, 3 * t + 1, 3 * t + 2};
      const auto shared = [&](std::uint32_t h) { return twin_[h] != kNone; };
      if (std::count_if(halves.begin(), halves.end(), shared) != 1) continue;
      const std::uint32_t h = *std::find_if(halves.begin(), halves.end(), shared);
      if (can_flip(h)) flip(h);
    }
    return std::move(triangles_);
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  static constexpr std::size_t kMostFlips = 64;  // per triangle

  static std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::uint32_t previous(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  std::uint32_t& from(std::uint32_t h) { return triangles_[h / 3][h % 3]; }
  std::uint32_t from(std::uint32_t h) const { return triangles_[h / 3][h % 3]; }

  // Whether the other diagonal lies within both triangles and does not exist yet.
  bool can_flip(std::uint32_t h) const {
    const std::uint32_t t = twin_[h], p = from(previous(h)), q = from(previous(t));
    const glm::dvec2 a = points_[from(h)], b = points_[from(t)], c = points_[p], d = points_[q];
    return p != q && turn(a, d, c) >= 0 && turn(d, b, c) >= 0 && !joined_(p, q) && !has_edge(previous(h), q);
  }

  // Whether the other diagonal is better and possible.
  bool better_across(std::uint32_t h) const {
    const std::uint32_t t = twin_[h];
    const glm::dvec2 a = points_[from(h)], b = points_[from(t)], c = points_[from(previous(h))],
                     d = points_[from(previous(t))];
    const glm::dvec2 old = b - a, across = d - c;
    const double size = std::max({glm::dot(old, old), glm::dot(across, across), glm::dot(c - a, c - a)});
    // For points on one circle, or over one another on a cliff, the shorter edge.
    constexpr double kSlip = 1e-9;
    const double inside = in_circle(a, b, c, d);
    const bool better =
        inside > kSlip * size * size ||
        (inside > -kSlip * size * size && glm::dot(across, across) < (1 - kSlip) * glm::dot(old, old));
    return better && can_flip(h);
  }

  // Whether an edge leads to `to` from the corner at which half-edge h starts.
  bool has_edge(std::uint32_t h, std::uint32_t to) const {
    std::uint32_t at = h;
    do {  // counter-clockwise around the corner
      if (from(next(at)) == to || from(previous(at)) == to) return true;
      at = twin_[previous(at)];
    } while (at != kNone && at != h);
    // At the border: continue the other way around from the start.
    while (at == kNone && twin_[h] != kNone) {
      h = next(twin_[h]);
      if (from(next(h)) == to || from(previous(h)) == to) return true;
    }
    return false;
  }

  // Replaces the triangles (a, b, c) and (b, a, d) on half-edge h = a → b by (a, d, c) and (d, b, c). Returns
  // the half-edges around both.
  std::array<std::uint32_t, 4> flip(std::uint32_t h) {
    const std::uint32_t t = twin_[h];
    const std::uint32_t ad = twin_[next(t)], db = twin_[previous(t)], bc = twin_[next(h)],
                        ca = twin_[previous(h)];
    const std::uint32_t a = from(h), b = from(t), c = from(previous(h)), d = from(previous(t));
    const std::uint32_t first = h / 3 * 3, second = t / 3 * 3;
    triangles_[h / 3] = {a, d, c};
    triangles_[t / 3] = {d, b, c};
    const auto pair = [&](std::uint32_t half, std::uint32_t other) {
      twin_[half] = other;
      if (other != kNone) twin_[other] = half;
    };
    pair(first, ad);
    pair(first + 1, second + 2);
    pair(first + 2, ca);
    pair(second, db);
    pair(second + 1, bc);
    return {first, first + 2, second, second + 1};
  }

  std::span<const glm::dvec2> points_;
  std::vector<Triangle> triangles_;
  const Joined& joined_;
  std::vector<std::uint32_t> twin_;
};

bool cross(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
  return turn(a, b, c) * turn(a, b, d) <= 0 && turn(c, d, a) * turn(c, d, b) <= 0;
}

// The nearest outer point that is visible from inner point 0.
std::optional<std::uint32_t> find_bridge(std::span<const glm::dvec2> points, std::size_t outer) {
  const glm::dvec2 from = points[outer];
  std::vector<std::uint32_t> nearest(outer);
  std::iota(nearest.begin(), nearest.end(), 0U);
  std::sort(nearest.begin(), nearest.end(), [&](std::uint32_t a, std::uint32_t b) {
    const glm::dvec2 u = points[a] - from, v = points[b] - from;
    return std::pair(glm::dot(u, u), a) < std::pair(glm::dot(v, v), b);
  });
  for (const std::uint32_t to : nearest) {
    bool blocked = false;
    for (std::size_t i = 0; i < points.size() && !blocked; ++i) {
      const std::size_t j = i + 1 == outer ? 0 : i + 1 == points.size() ? outer : i + 1;
      if (i == to || j == to || i == outer || j == outer) continue;
      blocked = cross(from, points[to], points[i], points[j]);
    }
    if (!blocked) return to;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<Triangle>> triangulate(std::span<const glm::dvec2> points) {
  if (points.size() < 3) return std::nullopt;
  std::vector<std::uint32_t> polygon(points.size());
  std::iota(polygon.begin(), polygon.end(), 0U);
  return EarCutter(points, std::move(polygon), mean_side(points)).run([](std::uint32_t, std::uint32_t) {
    return false;
  });
}

std::optional<std::vector<Triangle>> triangulate_ring(std::span<const glm::dvec2> outer,
                                                      std::span<const glm::dvec2> inner,
                                                      const Joined& joined) {
  if (outer.size() < 3 || inner.size() < 3) return std::nullopt;
  std::vector<glm::dvec2> points(outer.begin(), outer.end());
  points.insert(points.end(), inner.begin(), inner.end());
  const std::optional<std::uint32_t> bridge = find_bridge(points, outer.size());
  if (!bridge) return std::nullopt;
  // Around the outer loop from the bridge, across it, around the inner loop the other way, and back.
  const auto n = static_cast<std::uint32_t>(outer.size()), m = static_cast<std::uint32_t>(inner.size());
  std::vector<std::uint32_t> polygon;
  polygon.reserve(points.size() + 2);
  for (std::uint32_t k = 0; k <= n; ++k) polygon.push_back((*bridge + k) % n);
  for (std::uint32_t k = 0; k <= m; ++k) polygon.push_back(n + (m - k) % m);
  std::optional<std::vector<Triangle>> ears =
      EarCutter(points, std::move(polygon), mean_side(inner)).run(joined);
  if (!ears) return std::nullopt;
  return Flipper(points, std::move(*ears), joined).run(n);
}

}  // namespace terrabench::ght
