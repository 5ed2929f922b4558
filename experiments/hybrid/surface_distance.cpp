#include "experiments/hybrid/surface_distance.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace terrabench::hybrid {
namespace {

// Nearest point of a triangle by the regions around it (Ericson 2005, Real-Time Collision Detection, §5.1.5).
float squared_distance(glm::vec3 p, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
  const auto squared = [](glm::vec3 v) { return glm::dot(v, v); };
  const auto to_edge = [&](glm::vec3 from, glm::vec3 to) {
    const float length = squared(to - from);
    const float t = length > 0 ? std::clamp(glm::dot(p - from, to - from) / length, 0.0F, 1.0F) : 0;
    return squared(p - from - t * (to - from));
  };
  const glm::vec3 normal = glm::cross(b - a, c - a);
  const float area = squared(normal);
  if (area > 0 && glm::dot(glm::cross(b - a, p - a), normal) >= 0 &&
      glm::dot(glm::cross(c - b, p - b), normal) >= 0 && glm::dot(glm::cross(a - c, p - c), normal) >= 0) {
    const float height = glm::dot(p - a, normal);
    return height * height / area;
  }
  return std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
}

// Triangles by the cubes that their boxes overlap, as one array with the first of each cube.
class Cubes {
 public:
  Cubes(const TriangleMesh& mesh, float cell) : mesh_(mesh), cell_(cell) {
    const Bounds box = bounds_of(mesh);
    low_ = box.low;
    size_ = glm::ivec3(box.size() / cell) + 1;
    first_.assign(static_cast<std::size_t>(size_.x) * size_.y * size_.z + 1, 0);
    each_overlap([&](std::size_t cube, std::uint32_t) { ++first_[cube + 1]; });
    for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
    triangles_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    each_overlap([&](std::size_t cube, std::uint32_t triangle) { triangles_[next[cube]++] = triangle; });
  }

  float distance(glm::vec3 p) const {
    const glm::ivec3 at = glm::clamp(glm::ivec3(glm::floor((p - low_) / cell_)), glm::ivec3(0), size_ - 1);
    float best = std::numeric_limits<float>::max();
    // Cubes farther than r - 1 cells hold nothing nearer than that.
    const int farthest = std::max({size_.x, size_.y, size_.z});
    for (int r = 0; r <= farthest; ++r) {
      const float nearest = static_cast<float>(r - 1) * cell_;
      if (r > 0 && nearest > 0 && nearest * nearest > best) break;
      const glm::ivec3 from = glm::max(at - r, glm::ivec3(0)), to = glm::min(at + r, size_ - 1);
      for (int z = from.z; z <= to.z; ++z) {
        for (int y = from.y; y <= to.y; ++y) {
          const bool shell = std::max(std::abs(z - at.z), std::abs(y - at.y)) == r;
          for (int x = from.x; x <= to.x; ++x) {
            if (shell || std::abs(x - at.x) == r) best = std::min(best, nearest_in({x, y, z}, p));
          }
        }
      }
    }
    return std::sqrt(best);
  }

 private:
  std::size_t cube(glm::ivec3 at) const {
    return (static_cast<std::size_t>(at.z) * size_.y + static_cast<std::size_t>(at.y)) * size_.x +
           static_cast<std::size_t>(at.x);
  }
  glm::vec3 corner(std::uint32_t triangle, std::size_t k) const {
    return mesh_.positions[mesh_.indices[3 * std::size_t{triangle} + k]];
  }
  template <class Use>
  void each_overlap(const Use& use) const {
    for (std::uint32_t t = 0; t < mesh_.triangles(); ++t) {
      const glm::vec3 a = corner(t, 0), b = corner(t, 1), c = corner(t, 2);
      const auto place = [&](glm::vec3 p) {
        return glm::clamp(glm::ivec3((p - low_) / cell_), glm::ivec3(0), size_ - 1);
      };
      const glm::ivec3 from = place(glm::min(a, glm::min(b, c))), to = place(glm::max(a, glm::max(b, c)));
      for (int z = from.z; z <= to.z; ++z) {
        for (int y = from.y; y <= to.y; ++y) {
          for (int x = from.x; x <= to.x; ++x) use(cube({x, y, z}), t);
        }
      }
    }
  }
  float nearest_in(glm::ivec3 at, glm::vec3 p) const {
    float best = std::numeric_limits<float>::max();
    for (std::uint32_t k = first_[cube(at)]; k < first_[cube(at) + 1]; ++k) {
      const std::uint32_t t = triangles_[k];
      best = std::min(best, squared_distance(p, corner(t, 0), corner(t, 1), corner(t, 2)));
    }
    return best;
  }

  const TriangleMesh& mesh_;
  float cell_;
  glm::vec3 low_;
  glm::ivec3 size_;
  std::vector<std::uint32_t> first_, triangles_;
};

}  // namespace

SurfaceDistance distance_to(const TriangleMesh& from, const TriangleMesh& to, float cell) {
  const Cubes cubes(to, cell);
  const std::size_t vertices = from.positions.size();
  std::vector<float> distances(vertices + from.triangles());
  tbb::parallel_for(std::size_t{0}, distances.size(), [&](std::size_t k) {
    if (k < vertices) {
      distances[k] = cubes.distance(from.positions[k]);
      return;
    }
    const std::uint32_t* corners = &from.indices[3 * (k - vertices)];
    distances[k] = cubes.distance(
        (from.positions[corners[0]] + from.positions[corners[1]] + from.positions[corners[2]]) / 3.0F);
  });
  SurfaceDistance found;
  for (const float distance : distances) {
    found.largest = std::max<double>(found.largest, distance);
    found.mean += distance;
  }
  found.mean /= static_cast<double>(distances.size());
  const auto rank = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() * 99 / 100);
  std::nth_element(distances.begin(), rank, distances.end());
  found.common = *rank;
  return found;
}

}  // namespace terrabench::hybrid
