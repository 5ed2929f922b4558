// Taking vertices out of a Delaunay triangulation, and closing the gaps in its arrays.
#include <algorithm>
#include <cassert>
#include <functional>

#include "terrain/tin/circles.h"
#include "terrain/tin/delaunay.h"

namespace terrabench::tin {

void Delaunay::append_star(std::uint32_t v, std::uint32_t triangle, std::vector<std::uint32_t>& to) const {
  const auto next = [&](std::uint32_t t, std::size_t turn) {
    const auto k = static_cast<std::size_t>(place_of(triangles_[t].vertex, v));
    return triangles_[t].neighbour[(k + turn) % 3];
  };
  std::uint32_t first = triangle;
  for (std::uint32_t back = next(first, 2); back != kNone; back = next(first, 2)) {
    first = back;
    if (first == triangle) break;
  }
  std::uint32_t at = first;
  do {
    to.push_back(at);
    at = next(at, 1);
  } while (at != kNone && at != first);
}

// The polygon's triangles are those without a conflict: such an ear is cut off until three edges are left.
void Delaunay::remove(std::uint32_t v, std::uint32_t triangle, std::vector<std::uint32_t>& changed) {
  std::vector<std::uint32_t> star;
  append_star(v, triangle, star);
  std::vector<RingEdge> ring;
  for (const std::uint32_t t : star) {
    const auto k = static_cast<std::size_t>(place_of(triangles_[t].vertex, v));
    const auto& [corners, beyond] = triangles_[t];
    ring.push_back({corners[(k + 1) % 3], beyond[k]});
    if (beyond[(k + 1) % 3] == kNone) ring.push_back({corners[(k + 2) % 3], kNone});  // the border
  }
  while (ring.size() >= 3) {
    std::size_t first = 0;
    while (ring.size() > 3 && !is_ear(ring, first)) ++first;
    assert(first < ring.size());  // a polygon without an ear is none
    const std::size_t second = (first + 1) % ring.size(), third = (first + 2) % ring.size();
    const std::uint32_t t = star.back();
    star.pop_back();
    changed.push_back(t);
    fill(t, {ring[first], ring[second], {ring[third].from, ring.size() > 3 ? kNone : ring[third].beyond}});
    if (ring.size() == 3) break;
    ring[first].beyond = t;
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(second));
  }
  for (const std::uint32_t t : star) {
    triangles_[t].vertex[0] = kNone;
    free_triangles_.push_back(t);
  }
  free_vertices_.push_back(v);
}

bool Delaunay::is_ear(const std::vector<RingEdge>& ring, std::size_t first) const {
  const auto at = [&](std::size_t k) { return vertices_[ring[(first + k) % ring.size()].from]; };
  if (twice_area(at(0), at(1), at(2)) <= 0) return false;
  return std::ranges::none_of(
      ring, [&](const RingEdge& e) { return in_conflict(at(0), at(1), at(2), vertices_[e.from]); });
}

// Makes the triangle of three edges, and the triangles beyond them its neighbours.
void Delaunay::fill(std::uint32_t triangle, const std::array<RingEdge, 3>& ring) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [from, beyond] = ring[k];
    const std::uint32_t to = ring[(k + 1) % 3].from;
    triangles_[triangle].vertex[k] = from;
    triangles_[triangle].neighbour[(k + 2) % 3] = beyond;
    if (beyond == kNone) continue;
    Triangle& other = triangles_[beyond];
    for (std::size_t m = 0; m < 3; ++m) {
      if (other.vertex[m] != from && other.vertex[m] != to) other.neighbour[m] = triangle;
    }
  }
}

void Delaunay::rotate(std::uint32_t triangle) {
  Triangle& t = triangles_[triangle];
  int first = before(vertex(t, 1), vertex(t, 0)) ? 1 : 0;
  if (before(vertex(t, 2), vertex(t, first))) first = 2;
  std::rotate(t.vertex.begin(), t.vertex.begin() + first, t.vertex.end());
  std::rotate(t.neighbour.begin(), t.neighbour.begin() + first, t.neighbour.end());
}

// From the greatest free index down, so that the last one is never free itself.
std::vector<Delaunay::Move> Delaunay::free_and_last(std::vector<std::uint32_t>& free,
                                                    std::size_t size) const {
  std::ranges::sort(free, std::greater{});
  std::vector<Move> moves;
  auto last = static_cast<std::uint32_t>(size);
  for (const std::uint32_t to : free) {
    if (to != --last) moves.push_back({last, to});
  }
  return moves;
}

std::vector<Delaunay::Move> Delaunay::compact_triangles() {
  std::vector<Move> moves = free_and_last(free_triangles_, triangles_.size());
  for (const auto [from, to] : moves) {
    triangles_[to] = triangles_[from];
    for (const std::uint32_t n : triangles_[to].neighbour) replace(n, from, to);
  }
  triangles_.resize(triangles_.size() - free_triangles_.size());
  free_triangles_ = std::vector<std::uint32_t>();
  return moves;
}

void Delaunay::renumber(const Move& move, std::uint32_t triangle) {
  std::vector<std::uint32_t> star;
  append_star(move.from, triangle, star);
  for (const std::uint32_t t : star) {
    auto& vertices = triangles_[t].vertex;
    vertices[static_cast<std::size_t>(place_of(vertices, move.from))] = move.to;
  }
}

}  // namespace terrabench::tin
