// Solids and heights with known answers, and the queries that tests make to every representation.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "representations/representation.h"

namespace terrabench::test {

inline TerrainSource from_predicate(Bounds bounds,
                                    std::function<Material(float x, float y, float z)> material) {
  TerrainSource source;
  source.name = "predicate";
  source.solid = Solid{bounds, std::string(32, '0'),
                       [material = std::move(material)](const ColumnSamples& at, std::span<Material> out) {
                         for (std::size_t i = 0; i < out.size(); ++i) {
                           out[i] = material(at.x, at.y0 + static_cast<float>(i) * at.dy, at.z);
                         }
                       }};
  return source;
}

inline TerrainSource from_heights(int width, int depth, std::vector<float> heights, float cell_x = 1,
                                  float cell_z = 1) {
  return source_of("heights", Heightfield{width, depth, cell_x, cell_z, std::move(heights), {}});
}

// Boxes of up to `materials` materials; with few levels they touch in every way that cells can.
inline TerrainSource random_boxes(unsigned seed, int n, int boxes, int materials) {
  struct Box {
    glm::vec3 low, high;
    Material material;
  };
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  const auto size = static_cast<float>(n);
  std::vector<Box> all;
  for (int b = 0; b < boxes; ++b) {
    const glm::vec3 low = glm::vec3(unit(random), unit(random), unit(random)) * size;
    const glm::vec3 extent = glm::vec3(unit(random), unit(random), unit(random)) * size * 0.4F;
    all.push_back(
        {low, low + extent, static_cast<Material>(random() % static_cast<unsigned>(materials + 1))});
  }
  return from_predicate({glm::vec3(0), glm::vec3(size)}, [all](float x, float y, float z) {
    Material material = Material::kAir;
    for (const Box& box : all) {
      if (x >= box.low.x && x < box.high.x && y >= box.low.y && y < box.high.y && z >= box.low.z &&
          z < box.high.z) {
        material = box.material;
      }
    }
    return material;
  });
}

// Every cell by itself, on or off: the worst case for runs, and full of cells that touch along edges and at
// corners.
inline TerrainSource random_cells(unsigned seed, int width, int levels, int depth, int materials,
                                  unsigned percent) {
  const Bounds bounds = {
      {-3, 10, 5},
      {-3 + static_cast<float>(width), 10 + static_cast<float>(levels), 5 + static_cast<float>(depth)}};
  return from_predicate(bounds, [=](float x, float y, float z) {
    const auto cell = [](float v) { return static_cast<unsigned>(static_cast<int>(std::floor(v)) + 1000); };
    unsigned hash =
        (cell(x) * 73856093U) ^ (cell(y) * 19349663U) ^ (cell(z) * 83492791U) ^ (seed * 2654435761U);
    hash = (hash ^ (hash >> 15)) * 2246822519U;
    hash = (hash ^ (hash >> 13)) * 3266489917U;
    hash ^= hash >> 16;
    return hash % 100 < percent ? static_cast<Material>(1 + hash / 100 % static_cast<unsigned>(materials))
                                : Material::kAir;
  });
}

// Rolling ground with winding tunnels and an overhanging face: about as many runs per column as the
// paper's caves.
inline TerrainSource caves() {
  return from_predicate({{0, 0, 0}, {1, 1, 1}}, [](float x, float y, float z) {
    constexpr float kTurn = 2 * std::numbers::pi_v<float>;
    const float ground = 0.55F + 0.12F * std::sin(kTurn * 2 * x + 3 * y) * std::cos(kTurn * 3 * z) +
                         0.05F * std::sin(kTurn * 7 * (x + z));
    const float a = std::sin(kTurn * (5 * x + 2 * y)) + std::sin(kTurn * (4 * y + 3 * z));
    const float b = std::sin(kTurn * (3 * z - 6 * y)) + std::cos(kTurn * (5 * x - 2 * z));
    const bool tunnel = std::abs(a) < 0.5F && std::abs(b) < 0.6F;
    return y < ground && !tunnel ? Material::kBedrock : Material::kAir;
  });
}

// The names of all registered types, or of those with the traits asked for, so that tests find a new method.
inline std::vector<std::string_view> types(bool (*chosen)(const Traits&) = nullptr) {
  std::vector<std::string_view> names;
  for (const RepresentationType& type : representations()) {
    if (chosen == nullptr || chosen(type.traits)) names.push_back(type.name);
  }
  return names;
}

inline Parameters with(const RepresentationType& type, std::int64_t resolution, double step = 0) {
  Parameters parameters(type.parameters);
  parameters.set("resolution", resolution);
  parameters.set("step", step);
  if (parameters.has("w")) parameters.set("w", std::int64_t{1});  // the grounds are small
  return parameters;
}

inline std::unique_ptr<Representation> build(std::string_view name, const TerrainSource& source,
                                             std::int64_t resolution = 0, double step = 0) {
  Progress progress;
  const RepresentationType& type = representation(name);
  return type.build(source, with(type, resolution, step), progress);
}

inline std::vector<std::byte> saved(const Representation& structure) {
  ByteSink sink;
  structure.save(sink);
  return {sink.bytes().begin(), sink.bytes().end()};
}

// A copy through save() and load().
inline std::unique_ptr<Representation> reloaded(std::string_view name, const Representation& structure) {
  ByteSink sink;
  structure.save(sink);
  ByteSource bytes(sink.bytes(), "memory");
  auto copy = representation(name).load(bytes);
  EXPECT_EQ(bytes.left(), 0U);
  return copy;
}

// All columns of an n × m lattice over the structure's bounds, at the middles of its cells.
struct Lattice {
  std::vector<float> x, z;
  Lattice(const Bounds& bounds, int n, int m) {
    for (int j = 0; j < m; ++j) {
      for (int i = 0; i < n; ++i) {
        x.push_back(bounds.low.x + (static_cast<float>(i) + 0.5F) * bounds.size().x / static_cast<float>(n));
        z.push_back(bounds.low.z + (static_cast<float>(j) + 0.5F) * bounds.size().z / static_cast<float>(m));
      }
    }
  }
  Columns columns() const { return {x, z}; }
};

inline SpanSink spans_of(const Representation& structure, Columns columns) {
  SpanSink sink;
  structure.spans(columns, sink);
  return sink;
}

inline bool same_spans(const SpanSink& a, const SpanSink& b) {
  if (a.columns() != b.columns()) return false;
  for (std::size_t c = 0; c < a.columns(); ++c) {
    if (!std::equal(a.column(c).begin(), a.column(c).end(), b.column(c).begin(), b.column(c).end()))
      return false;
  }
  return true;
}

// Points all around and inside the bounds.
struct Cloud {
  std::vector<float> x, y, z;
  Cloud(const Bounds& bounds, std::size_t n, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-0.1F, 1.1F);
    for (std::size_t i = 0; i < n; ++i) {
      x.push_back(bounds.low.x + unit(random) * bounds.size().x);
      y.push_back(bounds.low.y + unit(random) * bounds.size().y);
      z.push_back(bounds.low.z + unit(random) * bounds.size().z);
    }
  }
  Points points() const { return {x, y, z}; }
};

// Enclosed volume by the divergence theorem: right only for closed, outward-facing meshes.
inline double volume(const TriangleMesh& mesh) {
  double six = 0;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const glm::dvec3 a = mesh.positions[mesh.indices[t]], b = mesh.positions[mesh.indices[t + 1]],
                     c = mesh.positions[mesh.indices[t + 2]];
    six += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
  }
  return six / 6;
}

}  // namespace terrabench::test
