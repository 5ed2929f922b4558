#include "renderers/grass/growth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "terrain/error.h"

namespace terrabench {
namespace {

void check(const GrassGround& ground, const GrassGrowth& growth) {
  if (growth.strands < 0 || growth.strands > GrassGrowth::kMostStrands) {
    throw usage_error(fmt::format("invalid number of strands {}", growth.strands), "grass",
                      fmt::format("it must be 0 to {}", GrassGrowth::kMostStrands));
  }
  const bool positive = growth.height > 0 && growth.width > 0 && growth.texture_metres > 0;
  const bool usable = std::isfinite(growth.height) && std::isfinite(growth.width) &&
                      growth.height_variation >= 0 && growth.height_variation <= 1 &&
                      !std::isnan(growth.steepest);
  if (!positive || !usable) {
    throw usage_error("invalid size of grass", "grass",
                      "height, width and texture must be above 0 m, the variation of height 0 to 1");
  }
  if (ground.normals.size() != ground.positions.size()) {
    throw usage_error(
        fmt::format("{} normals for {} positions", ground.normals.size(), ground.positions.size()), "grass",
        "call compute_normals() for the mesh");
  }
  const auto high = std::max_element(ground.indices.begin(), ground.indices.end());
  if (ground.indices.size() % 3 != 0 || (high != ground.indices.end() && *high >= ground.positions.size())) {
    throw usage_error(
        fmt::format("{} indices, the largest of them {}, for {} positions", ground.indices.size(),
                    high == ground.indices.end() ? 0 : *high, ground.positions.size()),
        "grass", "each triangle has three indices below the number of positions");
  }
}

// From the number of strands of each triangle: the order, the runs and the number of each one's first strand.
void arrange(GrassPlan& plan) {
  std::stable_sort(plan.triangles.begin(), plan.triangles.end(),
                   [](const glm::uvec4& a, const glm::uvec4& b) { return a.w > b.w; });
  std::uint32_t first = 0;
  for (std::size_t t = 0; t < plan.triangles.size(); ++t) {
    const std::uint32_t own = plan.triangles[t].w;
    plan.triangles[t].w = first;
    first += own;
    if (own == 0) continue;
    if (plan.runs.empty() || plan.runs.back().strands != own) {
      plan.runs.push_back({static_cast<std::uint32_t>(t), 0, own});
    }
    ++plan.runs.back().triangles;
  }
  plan.triangles.emplace_back(0, 0, 0, first);
}

}  // namespace

double slope_angle(double normal_y, SlopeAngle reading) {
  const double y = std::clamp(normal_y, -1.0, 1.0);
  return reading == SlopeAngle::kPrinted ? (1 - y) * 90 : std::acos(y) * 180 / std::numbers::pi;
}

GrassGround grass_ground(const TriangleMesh& mesh) { return {mesh.positions, mesh.normals, mesh.indices}; }

GrassPlan plan_grass(const GrassGround& ground, const GrassGrowth& growth) {
  check(ground, growth);
  GrassPlan plan;
  std::vector<double> ends;  // running sum of the triangles' weights
  double sum = 0;
  for (std::size_t t = 0; t < ground.indices.size(); t += 3) {
    const glm::uvec3 at(ground.indices[t], ground.indices[t + 1], ground.indices[t + 2]);
    const auto usable = [&](std::uint32_t v) {
      return is_finite(ground.positions[v]) && is_finite(ground.normals[v]);
    };
    if (!usable(at.x) || !usable(at.y) || !usable(at.z)) continue;
    const glm::dvec3 a(ground.positions[at.x]), b(ground.positions[at.y]), c(ground.positions[at.z]);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double twice_area = glm::length(normal);
    if (!(twice_area > 0) || slope_angle(normal.y / twice_area, growth.slope) > growth.steepest) continue;
    sum += growth.by_area ? twice_area : 1;
    ends.push_back(sum);
    plan.triangles.emplace_back(at, 0);
  }
  if (plan.triangles.empty()) return plan;
  // The number of strands up to each triangle, by proportion of the running sum; the last is exact.
  std::uint32_t before = 0;
  for (std::size_t t = 0; t < ends.size(); ++t) {
    const double share = t + 1 == ends.size() ? 1 : ends[t] / sum;
    const auto end = static_cast<std::uint32_t>(std::floor(share * static_cast<double>(growth.strands)));
    plan.triangles[t].w = end - before;
    before = end;
  }
  arrange(plan);
  return plan;
}

}  // namespace terrabench
