#include "representations/tin/delaunay.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "representations/tin/circles.h"

namespace terrabench::tin {
namespace {

// The triangle's corners, beginning with number `first`.
std::array<std::uint32_t, 3> corners_from(const Triangle& t, int first) {
  const auto at = [&](int k) { return t.vertex[static_cast<std::size_t>((first + k) % 3)]; };
  return {at(0), at(1), at(2)};
}

// 0 … n - 1 by ascending buckets, of which there are `buckets`, and in each by ascending keys. O(n) for small
// buckets.
template <class Bucket, class Key>
std::vector<std::uint32_t> sorted(std::size_t n, std::size_t buckets, const Bucket& bucket, const Key& key) {
  std::vector<std::uint32_t> end(buckets + 1), order(n);
  for (std::uint32_t k = 0; k < n; ++k) ++end[bucket(k) + 1];
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> keyed(n);
  for (std::uint32_t k = 0; k < n; ++k) keyed[end[bucket(k)]++] = {key(k), k};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, buckets), [&](const auto& range) {
    for (std::size_t b = range.begin(); b < range.end(); ++b) {
      const std::uint32_t first = b == 0 ? 0 : end[b - 1];
      std::sort(keyed.begin() + first, keyed.begin() + end[b]);
      for (std::uint32_t k = first; k < end[b]; ++k) order[k] = keyed[k].second;
    }
  });
  return order;
}

std::vector<std::uint32_t> inverse(const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> place(order.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) place[order[k]] = k;
  return place;
}

}  // namespace

Delaunay::Delaunay(int width, int depth) {
  const auto east = static_cast<std::uint16_t>(width - 1), south = static_cast<std::uint16_t>(depth - 1);
  vertices_ = {{0, 0}, {east, 0}, {0, south}, {east, south}};
  triangles_ = {{{0, 1, 3}, {kNone, 1, kNone}}, {{0, 3, 2}, {kNone, kNone, 0}}};
}

void Delaunay::reserve(std::size_t vertices) {
  vertices_.reserve(vertices);
  triangles_.reserve(2 * vertices);
}

Delaunay::Former Delaunay::put_in_order() {
  std::vector<std::uint32_t> former = sorted(
      vertices_.size(), std::size_t{1} << 16, [&](std::uint32_t v) { return vertices_[v].j; },
      [&](std::uint32_t v) { return vertices_[v].i; });
  const std::vector<std::uint32_t> vertex_now = inverse(former);
  tbb::parallel_for(std::size_t{0}, triangles_.size(), [&](std::size_t k) {
    Triangle& t = triangles_[k];
    for (std::uint32_t& v : t.vertex) v = vertex_now[v];
    const auto first = std::ranges::min_element(t.vertex) - t.vertex.begin();
    std::rotate(t.vertex.begin(), t.vertex.begin() + first, t.vertex.end());
    std::rotate(t.neighbour.begin(), t.neighbour.begin() + first, t.neighbour.end());
  });
  std::vector<std::uint32_t> order = sorted(
      triangles_.size(), vertices_.size(), [&](std::uint32_t t) { return triangles_[t].vertex[0]; },
      [&](std::uint32_t t) { return triangles_[t].vertex[1]; });
  const std::vector<std::uint32_t> triangle_now = inverse(order);
  std::vector<Sample> vertices;
  vertices.reserve(former.size());
  for (const std::uint32_t v : former) vertices.push_back(vertices_[v]);
  std::vector<Triangle> triangles(order.size());
  tbb::parallel_for(std::size_t{0}, order.size(), [&](std::size_t k) {
    triangles[k] = triangles_[order[k]];
    for (std::uint32_t& n : triangles[k].neighbour) n = n == kNone ? kNone : triangle_now[n];
  });
  vertices_ = std::move(vertices);
  triangles_ = std::move(triangles);
  suspects_ = std::vector<std::uint32_t>();
  return {std::move(former), std::move(order)};
}

std::uint32_t Delaunay::locate(Sample p, std::uint32_t start) const {
  // In a Delaunay triangulation a walk toward the point never returns to a triangle.
  for (std::uint32_t at = start;;) {
    const Triangle& t = triangles_[at];
    const Sample a = vertex(t, 0), b = vertex(t, 1), c = vertex(t, 2);
    const int beyond = twice_area(b, c, p) < 0   ? 0
                       : twice_area(c, a, p) < 0 ? 1
                       : twice_area(a, b, p) < 0 ? 2
                                                 : 3;
    if (beyond == 3) return at;
    at = t.neighbour[static_cast<std::size_t>(beyond)];
  }
}

std::uint32_t Delaunay::vertex_at(Sample s, std::uint32_t triangle) const {
  for (const std::uint32_t v : triangles_[triangle].vertex) {
    if (vertices_[v] == s) return v;
  }
  return kNone;
}

std::uint32_t Delaunay::new_vertex(Sample p) {
  if (free_vertices_.empty()) {
    vertices_.push_back(p);
    return static_cast<std::uint32_t>(vertices_.size() - 1);
  }
  const std::uint32_t v = free_vertices_.back();
  free_vertices_.pop_back();
  vertices_[v] = p;
  return v;
}

std::uint32_t Delaunay::new_triangle() {
  if (free_triangles_.empty()) {
    triangles_.emplace_back();
    return static_cast<std::uint32_t>(triangles_.size() - 1);
  }
  const std::uint32_t t = free_triangles_.back();
  free_triangles_.pop_back();
  return t;
}

void Delaunay::replace(std::uint32_t triangle, std::uint32_t neighbour, std::uint32_t by) {
  if (triangle == kNone) return;
  auto& neighbours = triangles_[triangle].neighbour;
  neighbours[static_cast<std::size_t>(place_of(neighbours, neighbour))] = by;
}

std::uint32_t Delaunay::insert(Sample p, std::uint32_t triangle, std::vector<std::uint32_t>& changed) {
  if (const std::uint32_t there = vertex_at(p, triangle); there != kNone) return there;
  const Triangle t = triangles_[triangle];
  int edge = 3;
  for (int k = 0; k < 3; ++k) {
    const Sample from = vertex(t, (k + 1) % 3), to = vertex(t, (k + 2) % 3);
    if (twice_area(from, to, p) == 0) edge = k;
  }
  const std::uint32_t added = new_vertex(p);
  suspects_.clear();
  if (edge == 3) {
    split(triangle, added);
  } else {
    split_edge(triangle, edge, added);
  }
  flip_from(changed);
  return added;
}

// (a, b, c) becomes (p, b, c), (p, c, a) and (p, a, b).
void Delaunay::split(std::uint32_t first, std::uint32_t p) {
  const auto [a, b, c] = triangles_[first].vertex;
  const auto [beyond_a, beyond_b, beyond_c] = triangles_[first].neighbour;
  const std::uint32_t second = new_triangle(), third = new_triangle();
  triangles_[first] = {{p, b, c}, {beyond_a, second, third}};
  triangles_[second] = {{p, c, a}, {beyond_b, third, first}};
  triangles_[third] = {{p, a, b}, {beyond_c, first, second}};
  replace(beyond_b, first, second);
  replace(beyond_c, first, third);
  suspects_.insert(suspects_.end(), {first, second, third});
}

// p lies on the edge bc of (a, b, c), which becomes (p, c, a) and (p, a, b); (q, c, b) on its other side, if
// there is one, becomes (p, q, c) and (p, b, q).
void Delaunay::split_edge(std::uint32_t near, int edge, std::uint32_t p) {
  const auto [a, b, c] = corners_from(triangles_[near], edge);
  const auto near_side = [&](int k) {
    return triangles_[near].neighbour[static_cast<std::size_t>((edge + k) % 3)];
  };
  const std::uint32_t far = near_side(0), beyond_b = near_side(1), beyond_c = near_side(2);
  const std::uint32_t near_new = new_triangle(), far_new = far == kNone ? kNone : new_triangle();
  triangles_[near] = {{p, c, a}, {beyond_b, near_new, far}};
  triangles_[near_new] = {{p, a, b}, {beyond_c, far_new, near}};
  replace(beyond_c, near, near_new);
  suspects_.insert(suspects_.end(), {near, near_new});
  if (far == kNone) return;
  const int q_at = place_of(triangles_[far].neighbour, near);
  const std::uint32_t q = triangles_[far].vertex[static_cast<std::size_t>(q_at)];
  const auto far_side = [&](int k) {
    return triangles_[far].neighbour[static_cast<std::size_t>((q_at + k) % 3)];
  };
  const std::uint32_t beyond_far_c = far_side(1), beyond_far_b = far_side(2);
  // (q, c, b): opposite c lies edge bq, opposite b edge qc.
  triangles_[far] = {{p, q, c}, {beyond_far_b, near, far_new}};
  triangles_[far_new] = {{p, b, q}, {beyond_far_c, far, near_new}};
  replace(beyond_far_c, far, far_new);
  suspects_.insert(suspects_.end(), {far, far_new});
}

bool Delaunay::should_flip(const Triangle& t, Sample q) const {
  const Sample p = vertex(t, 0), b = vertex(t, 1), c = vertex(t, 2);
  const int side = in_circle(p, b, c, q);
  return side != 0 ? side > 0 : prefers(p, q, b, c);
}

// Each suspect has the new vertex as its corner 0.
void Delaunay::flip_from(std::vector<std::uint32_t>& changed) {
  while (!suspects_.empty()) {
    const std::uint32_t near = suspects_.back();
    const Triangle t = triangles_[near];
    const std::uint32_t far = t.neighbour[0];
    const Triangle other = far == kNone ? Triangle{} : triangles_[far];
    const int q_at = far == kNone ? 0 : place_of(other.neighbour, near);
    if (far == kNone || !should_flip(t, vertex(other, q_at))) {
      suspects_.pop_back();
      changed.push_back(near);
      continue;
    }
    // (p, b, c) and (q, c, b) become (p, b, q) and (p, q, c).
    const auto [p, b, c] = t.vertex;
    const std::uint32_t q = other.vertex[static_cast<std::size_t>(q_at)];
    const std::uint32_t beyond_bq = other.neighbour[static_cast<std::size_t>((q_at + 1) % 3)];
    const std::uint32_t beyond_qc = other.neighbour[static_cast<std::size_t>((q_at + 2) % 3)];
    const std::uint32_t beyond_cp = t.neighbour[1], beyond_pb = t.neighbour[2];
    triangles_[near] = {{p, b, q}, {beyond_bq, far, beyond_pb}};
    triangles_[far] = {{p, q, c}, {beyond_qc, beyond_cp, near}};
    replace(beyond_bq, far, near);
    replace(beyond_cp, near, far);
    suspects_.push_back(far);
  }
}

void Delaunay::append_conflicts(Sample p, std::uint32_t triangle, std::vector<std::uint32_t>& to) const {
  const std::size_t first = to.size();
  to.push_back(triangle);
  for (std::size_t at = first; at < to.size(); ++at) {
    for (const std::uint32_t beyond : triangles_[to[at]].neighbour) {
      if (beyond == kNone ||
          std::find(to.begin() + static_cast<std::ptrdiff_t>(first), to.end(), beyond) != to.end()) {
        continue;
      }
      const Triangle& t = triangles_[beyond];
      if (in_conflict(vertex(t, 0), vertex(t, 1), vertex(t, 2), p)) to.push_back(beyond);
    }
  }
}

void Delaunay::make_room() {
  const auto grow = [](auto& elements) {
    if (elements.size() + 2 > elements.capacity())
      elements.reserve(elements.size() + elements.size() / 64 + 16);
  };
  grow(vertices_);
  grow(triangles_);
}

}  // namespace terrabench::tin
