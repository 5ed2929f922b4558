#include "terrain/tin/delaunay.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "terrain/tin/circles.h"

namespace terrabench::tin {
namespace {

// The indices by ascending buckets, of which there are `buckets`, and in each by ascending keys. O(n) for
// small buckets.
template <class Bucket, class Key>
std::vector<std::uint32_t> sorted(std::vector<std::uint32_t> order, std::size_t buckets, const Bucket& bucket,
                                  const Key& key) {
  std::vector<std::uint32_t> end(buckets + 1);
  for (const std::uint32_t k : order) ++end[bucket(k) + 1];
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> keyed(order.size());
  for (const std::uint32_t k : order) keyed[end[bucket(k)]++] = {key(k), k};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, buckets), [&](const auto& range) {
    for (std::size_t b = range.begin(); b < range.end(); ++b) {
      const std::uint32_t first = b == 0 ? 0 : end[b - 1];
      std::sort(keyed.begin() + first, keyed.begin() + end[b]);
      for (std::uint32_t k = first; k < end[b]; ++k) order[k] = keyed[k].second;
    }
  });
  return order;
}

// 0 … n - 1 but for those that are free.
std::vector<std::uint32_t> used(std::size_t n, const std::vector<std::uint32_t>& free) {
  std::vector<bool> is_free(n);
  for (const std::uint32_t k : free) is_free[k] = true;
  std::vector<std::uint32_t> all;
  all.reserve(n - free.size());
  for (std::uint32_t k = 0; k < n; ++k) {
    if (!is_free[k]) all.push_back(k);
  }
  return all;
}

// The place of each of n indices in the order.
std::vector<std::uint32_t> inverse(const std::vector<std::uint32_t>& order, std::size_t n) {
  std::vector<std::uint32_t> place(n);
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(order.size()), 4096),
                    [&](const auto& range) {
                      for (std::uint32_t k = range.begin(); k < range.end(); ++k) place[order[k]] = k;
                    });
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
  const std::size_t rows = std::ranges::max(vertices_, {}, &Sample::j).j + std::size_t{1};
  std::vector<std::uint32_t> former = sorted(
      used(vertices_.size(), free_vertices_), rows, [&](std::uint32_t v) { return vertices_[v].j; },
      [&](std::uint32_t v) { return vertices_[v].i; });
  const std::vector<std::uint32_t> vertex_now = inverse(former, vertices_.size());
  std::vector<std::uint32_t> order = used(triangles_.size(), free_triangles_);
  tbb::parallel_for(std::size_t{0}, order.size(), [&](std::size_t k) {
    Triangle& t = triangles_[order[k]];
    for (std::uint32_t& v : t.vertex) v = vertex_now[v];
    const auto first = std::ranges::min_element(t.vertex) - t.vertex.begin();
    std::rotate(t.vertex.begin(), t.vertex.begin() + first, t.vertex.end());
    std::rotate(t.neighbour.begin(), t.neighbour.begin() + first, t.neighbour.end());
  });
  order = sorted(
      std::move(order), former.size(), [&](std::uint32_t t) { return triangles_[t].vertex[0]; },
      [&](std::uint32_t t) { return triangles_[t].vertex[1]; });
  const std::vector<std::uint32_t> triangle_now = inverse(order, triangles_.size());
  std::vector<Triangle> triangles(order.size());
  tbb::parallel_for(std::size_t{0}, order.size(), [&](std::size_t k) {
    triangles[k] = triangles_[order[k]];
    for (std::uint32_t& n : triangles[k].neighbour) n = n == kNone ? kNone : triangle_now[n];
  });
  vertices_ = gathered(vertices_, former);
  triangles_ = std::move(triangles);
  cavity_ = {};
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

// By depth first, so that the ring comes in order: the triangles without vertices between them form a tree.
// False if one of them has a corner outside the tile.
bool Delaunay::find_cavity(const Tile& tile, Sample p, std::uint32_t first, Cavity& c) const {
  if (!all_in(tile, triangles_[first])) return false;
  c.triangles.assign(1, first);
  c.ring.clear();
  c.open.assign({{first, 2}, {first, 1}, {first, 0}});
  std::size_t border = 0;  // place in the ring after the edge that holds p
  while (!c.open.empty()) {
    const auto [at, edge] = c.open.back();
    c.open.pop_back();
    const Triangle& t = triangles_[at];
    const std::uint32_t beyond = t.neighbour[static_cast<std::size_t>(edge)];
    const int next = (edge + 1) % 3;
    if (beyond != kNone) {
      const Triangle& other = triangles_[beyond];
      if (in_conflict(vertex(other, 0), vertex(other, 1), vertex(other, 2), p)) {
        if (!all_in(tile, other)) return false;
        const int back = place_of(other.neighbour, at);
        c.triangles.push_back(beyond);
        c.open.push_back({beyond, (back + 2) % 3});
        c.open.push_back({beyond, (back + 1) % 3});
        continue;
      }
    }
    c.ring.push_back({t.vertex[static_cast<std::size_t>(next)], beyond});
    if (beyond == kNone && twice_area(vertex(t, next), vertex(t, (edge + 2) % 3), p) == 0)
      border = c.ring.size();
  }
  c.at_border = border != 0;
  std::rotate(c.ring.begin(), c.ring.begin() + static_cast<std::ptrdiff_t>(border), c.ring.end());
  return true;
}

// A triangle (p, from, to) for each edge of the ring but one that holds p: one or two more than before.
template <class NewTriangle>
void Delaunay::fan_out(Cavity& c, std::uint32_t p, const NewTriangle& new_triangle) {
  const std::size_t count = c.ring.size() - (c.at_border ? 1 : 0);
  while (c.triangles.size() < count) c.triangles.push_back(new_triangle());
  for (std::size_t k = 0; k < count; ++k) {
    const auto [from, beyond] = c.ring[k];
    const std::uint32_t to = c.ring[(k + 1) % c.ring.size()].from, at = c.triangles[k];
    const std::uint32_t next = k + 1 < count ? c.triangles[k + 1] : c.at_border ? kNone : c.triangles.front();
    const std::uint32_t last = k > 0 ? c.triangles[k - 1] : c.at_border ? kNone : c.triangles.back();
    triangles_[at] = {{p, from, to}, {beyond, next, last}};
    if (beyond == kNone) continue;
    Triangle& other = triangles_[beyond];
    for (std::size_t m = 0; m < 3; ++m) {
      if (other.vertex[m] != from && other.vertex[m] != to) other.neighbour[m] = at;
    }
  }
}

std::uint32_t Delaunay::insert(Sample p, std::uint32_t triangle, std::vector<std::uint32_t>& changed) {
  if (const std::uint32_t there = vertex_at(p, triangle); there != kNone) return there;
  find_cavity(Tile{}, p, triangle, cavity_);
  const std::uint32_t added = new_vertex(p);
  fan_out(cavity_, added, [&] { return new_triangle(); });
  changed.insert(changed.end(), cavity_.triangles.begin(), cavity_.triangles.end());
  return added;
}

std::uint32_t Delaunay::insert_in(const Tile& tile, Sample p, std::uint32_t triangle, Workspace& work,
                                  std::vector<std::uint32_t>& changed) {
  if (!find_cavity(tile, p, triangle, work.cavity)) return kNone;
  if (const std::uint32_t there = vertex_at(p, triangle); there != kNone) return there;
  const auto take = [](std::vector<std::uint32_t>& free) {
    const std::uint32_t taken = free.back();
    free.pop_back();
    return taken;
  };
  const std::uint32_t added = take(work.vertices);
  vertices_[added] = p;
  fan_out(work.cavity, added, [&] { return take(work.triangles); });
  changed.insert(changed.end(), work.cavity.triangles.begin(), work.cavity.triangles.end());
  return added;
}

Delaunay::Workspace Delaunay::make_workspace(std::size_t vertices) {
  Workspace work;
  while (work.vertices.size() < vertices) work.vertices.push_back(new_vertex({}));
  while (work.triangles.size() < 2 * vertices) {
    work.triangles.push_back(new_triangle());
    triangles_[work.triangles.back()].vertex[0] = kNone;
  }
  return work;
}

void Delaunay::take_back(Workspace&& work) {
  free_vertices_.insert(free_vertices_.end(), work.vertices.begin(), work.vertices.end());
  free_triangles_.insert(free_triangles_.end(), work.triangles.begin(), work.triangles.end());
}

void Delaunay::append_conflicts(Sample p, std::uint32_t triangle, std::vector<std::uint32_t>& to) const {
  Cavity cavity;
  find_cavity(Tile{}, p, triangle, cavity);
  to.insert(to.end(), cavity.triangles.begin(), cavity.triangles.end());
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
