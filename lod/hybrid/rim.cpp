#include "lod/hybrid/rim.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "lod/hybrid/height_chunks.h"
#include "terrain/error.h"

namespace terrabench::hybrid {
namespace {

constexpr double kRounding = 1e-3;  // samples, within which a vertex counts as lying at a sample's x or z

double to_sample(float metres, float cell) {
  const double at = static_cast<double>(metres) / cell, whole = std::round(at);
  return std::abs(at - whole) <= kRounding ? whole : at;
}

// The heights between samples, on the triangles that a clipmap draws.
float height_at(const Heightfield& field, glm::dvec2 at) {
  const glm::ivec2 low =
      glm::clamp(glm::ivec2(glm::floor(at)), glm::ivec2(0), {field.width - 2, field.depth - 2});
  const glm::dvec2 f = glm::clamp(at - glm::dvec2(low), 0.0, 1.0);
  const double east = field.at(low.x + 1, low.y), south = field.at(low.x, low.y + 1);
  const double corner = f.x + f.y <= 1 ? field.at(low.x, low.y) : field.at(low.x + 1, low.y + 1);
  const glm::dvec2 share = f.x + f.y <= 1 ? f : glm::dvec2(1 - f.y, 1 - f.x);
  return static_cast<float>(corner + share.x * (east - corner) + share.y * (south - corner));
}

class Joining {
 public:
  Joining(const TriangleMesh& from, const Outline& chunk, const Rim& rim, const Heightfield& heights)
      : from_(from), chunk_(chunk), rim_(rim), heights_(heights), cells_(chunk.high - chunk.low) {
    at_sample_.assign(static_cast<std::size_t>(cells_.x + 1) * static_cast<std::size_t>(cells_.y + 1), kNone);
  }

  TriangleMesh run() {
    place_vertices();
    for (std::size_t k = 0; k < from_.indices.size(); k += 3) {
      add({moved_[from_.indices[k]], moved_[from_.indices[k + 1]], moved_[from_.indices[k + 2]]});
    }
    check_closed();
    return std::move(to_);
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  using Triangle = std::array<std::uint32_t, 3>;

  double distance_to_rim(glm::dvec2 at) const {
    const glm::dvec2 inside = glm::min(at - glm::dvec2(rim_.outline.low), glm::dvec2(rim_.outline.high) - at);
    return std::min(inside.x, inside.y);
  }

  void place_vertices() {
    moved_.reserve(from_.positions.size());
    to_.positions.reserve(from_.positions.size());
    to_.normals.reserve(from_.positions.size());
    to_.indices.reserve(from_.indices.size());
    places_.assign(from_.positions.size(), glm::ivec2(-1));
    for (std::size_t v = 0; v < from_.positions.size(); ++v) {
      const glm::vec3& p = from_.positions[v];
      const glm::dvec2 at(to_sample(p.x, heights_.cell_x), to_sample(p.z, heights_.cell_z));
      const double distance = distance_to_rim(at);
      moved_.push_back(distance <= 0 ? at_sample(glm::ivec2(glm::round(at))) : moved(v, at, distance));
    }
  }

  // The vertex at a sample on the rim.
  std::uint32_t at_sample(glm::ivec2 sample) {
    sample = glm::clamp(sample, chunk_.low, chunk_.high);
    const glm::ivec2 local = sample - chunk_.low;
    std::uint32_t& known = at_sample_[static_cast<std::size_t>(local.y) * (cells_.x + 1) + local.x];
    if (known == kNone) known = add_vertex(place_of(heights_, sample), normal_of(heights_, sample), sample);
    return known;
  }

  std::uint32_t moved(std::size_t v, glm::dvec2 at, double distance) {
    glm::vec3 position = from_.positions[v], normal = from_.normals[v];
    const double way = std::min(distance / rim_.band, 1.0);
    const auto share = static_cast<float>(1 - way * way * (3 - 2 * way));
    if (share > 0) {
      position.y += share * (height_at(heights_, at) - position.y);
      const glm::vec3 far = normal_of(heights_, glm::ivec2(glm::round(at)));
      const glm::vec3 mixed = normal + share * (far - normal);
      if (glm::dot(mixed, mixed) > 0) normal = glm::normalize(mixed);
    }
    return add_vertex(position, normal, glm::ivec2(-1));
  }

  std::uint32_t add_vertex(glm::vec3 position, glm::vec3 normal, glm::ivec2 sample) {
    const auto number = static_cast<std::uint32_t>(to_.positions.size());
    to_.positions.push_back(position);
    to_.normals.push_back(normal);
    if (places_.size() <= number) places_.resize(number + 1, glm::ivec2(-1));
    places_[number] = sample;
    return number;
  }

  // Whether two vertices lie on one side of the rim, and which: 0 west, 1 north, 2 east, 3 south; -1 for
  // none.
  int side_of(std::uint32_t p, std::uint32_t q) const {
    const glm::ivec2 a = places_[p], b = places_[q];
    if (a.x < 0 || b.x < 0) return -1;
    if (a.x == b.x && a.x == rim_.outline.low.x) return 0;
    if (a.y == b.y && a.y == rim_.outline.low.y) return 1;
    if (a.x == b.x && a.x == rim_.outline.high.x) return 2;
    if (a.y == b.y && a.y == rim_.outline.high.y) return 3;
    return -1;
  }

  void add(const Triangle& t) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return;
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t p = t[e], q = t[(e + 1) % 3], r = t[(e + 2) % 3];
      if (side_of(p, q) < 0) continue;
      const glm::ivec2 a = places_[p], b = places_[q];
      if (std::max(std::abs(b.x - a.x), std::abs(b.y - a.y)) < 2) continue;
      const std::uint32_t middle = at_sample((a + b) / 2);
      add({p, middle, r});
      add({middle, q, r});
      return;
    }
    to_.indices.insert(to_.indices.end(), t.begin(), t.end());
    for (std::size_t e = 0; e < 3; ++e) count_side(t[e], t[(e + 1) % 3]);
  }

  // Sides of triangles along the rim, counter-clockwise ones minus clockwise ones, per cell.
  void count_side(std::uint32_t p, std::uint32_t q) {
    const int side = side_of(p, q);
    if (side < 0) return;
    std::vector<int>& counts = counts_[static_cast<std::size_t>(side)];
    counts.resize(static_cast<std::size_t>(std::max(cells_.x, cells_.y)), 0);
    const int axis = side % 2 == 0 ? 1 : 0;  // along which the side runs
    const int a = places_[p][axis] - chunk_.low[axis], b = places_[q][axis] - chunk_.low[axis];
    const bool forward = (b > a) == (side == 0 || side == 3);
    counts[static_cast<std::size_t>(std::min(a, b))] += forward ? 1 : -1;
  }

  void check_closed() {
    const std::array on_rim = {chunk_.low.x == rim_.outline.low.x, chunk_.low.y == rim_.outline.low.y,
                               chunk_.high.x == rim_.outline.high.x, chunk_.high.y == rim_.outline.high.y};
    for (std::size_t side = 0; side < 4; ++side) {
      if (!on_rim[side]) continue;
      const int along = side % 2 == 0 ? cells_.y : cells_.x;
      counts_[side].resize(static_cast<std::size_t>(std::max(cells_.x, cells_.y)), 0);
      for (int k = 0; k < along; ++k) {
        const int surfaces = counts_[side][static_cast<std::size_t>(k)];
        if (surfaces == 1) continue;
        constexpr std::array kNames = {"western", "northern", "eastern", "southern"};
        throw bad_input(fmt::format("over cell {} of the {} side of the chunk at sample ({}, {}), the near "
                                    "surface rises to the air {} times more than it returns, not once",
                                    k, kNames[side], chunk_.low.x, chunk_.low.y, surfaces),
                        "near surface", "it must cover its bounds without openings, solid at the bottom");
      }
    }
  }

  const TriangleMesh& from_;
  const Outline& chunk_;
  const Rim& rim_;
  const Heightfield& heights_;
  glm::ivec2 cells_;
  TriangleMesh to_;
  std::vector<std::uint32_t> at_sample_;  // vertex per sample of the chunk, of those on the rim
  std::vector<std::uint32_t> moved_;      // vertex of to_ per vertex of from_
  std::vector<glm::ivec2> places_;        // sample per vertex of to_ on the rim; -1 for others
  std::array<std::vector<int>, 4> counts_;
};

}  // namespace

RimDistances distances(const Outline& chunk, const Rim& rim) {
  return {glm::clamp(chunk.low - rim.outline.low, 0, rim.band),
          glm::clamp(rim.outline.high - chunk.high, 0, rim.band)};
}

TriangleMesh join(const TriangleMesh& mesh, const Outline& chunk, const Rim& rim,
                  const Heightfield& heights) {
  return Joining(mesh, chunk, rim, heights).run();
}

}  // namespace terrabench::hybrid
