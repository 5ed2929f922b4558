#include "experiments/ght/stage_numbers.h"

#include <cmath>
#include <set>

#include "experiments/figures/measures.h"

namespace terrabench::ght {

Heightfield every_other(const Heightfield& field) {
  Heightfield half =
      Heightfield::zeros((field.width + 1) / 2, (field.depth + 1) / 2, 2 * field.cell_x, 2 * field.cell_z);
  for (int j = 0; j < half.depth; ++j) {
    for (int i = 0; i < half.width; ++i) half.at(i, j) = field.at(2 * i, 2 * j);
  }
  return half;
}

double correlation(const Image& map, const TriangleMesh& mesh, double cell) {
  figures::Correlation found;
  for (const glm::vec3& p : mesh.positions) {
    found.add(
        map.pixel(static_cast<int>(std::lround(p.x / cell)), static_cast<int>(std::lround(p.z / cell)))[1],
        p.y);
  }
  return found.exists() ? found.value() : 0;  // none on level ground
}

double moved_points(const std::vector<float>& earlier, const std::vector<float>& later) {
  double moved = 0;
  for (std::size_t i = 0; i < earlier.size(); ++i) {
    moved += later[i * (later.size() - 1) / (earlier.size() - 1)] != earlier[i];
  }
  return moved;
}

double mean_displacement(const std::vector<float>& line, int level) {
  const std::size_t half = (line.size() - 1) >> level;
  double sum = 0, points = 0;
  for (std::size_t i = half; i < line.size(); i += 2 * half) {
    sum += std::abs(line[i] - 0.5 * (static_cast<double>(line[i - half]) + line[i + half]));
    ++points;
  }
  return sum / points;
}

double neighbours_among(const Cells& corners, std::pair<int, int> centre, bool diagonal) {
  constexpr int kRound = 4;  // steps along an array of 5 until its first point comes again
  std::set<std::pair<int, int>> found;
  for (const auto& [i, j] : corners) {
    const auto away = [](int a, int b) { return (a - b + kRound + 1) % kRound - 1; };
    const int x = away(i, centre.first), z = away(j, centre.second);
    if (diagonal ? std::abs(x) == 1 && std::abs(z) == 1 : std::abs(x) + std::abs(z) == 1) found.emplace(x, z);
  }
  return static_cast<double>(found.size());
}

double raised_within(const Heightfield& field, int i, int j) {
  double reach = 0;
  for (int z = 0; z < field.depth; ++z) {
    for (int x = 0; x < field.width; ++x) {
      if (field.at(x, z) > 0) reach = std::max(reach, std::hypot(x - i, z - j));
    }
  }
  return reach;
}

}  // namespace terrabench::ght
