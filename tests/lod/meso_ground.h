// Ground with an arch, a tunnel that crosses all rims and a pit, as chunks of a mesh and as heights: for the
// tests of methods and meters for ground that is not a heightfield. Extracted by marching tetrahedra, so that
// neither the lattice nor the triangles are those of the structures under test.
#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <utility>
#include <vector>

#include "terrain/heightfield.h"
#include "terrain/mesh_chunks.h"

namespace terrabench::test {

struct MesoOptions {
  int samples = 97;   // of the heights, along both axes, 1 m apart
  float cell = 1;     // of the chunks' lattice, metres
  int cells = 16;     // along a chunk's side
  glm::vec2 low{0};   // of chunk (0, 0)
  int chunks = 6;     // along both axes
  float relief = 6;   // metres
  bool floor = true;  // false: the ground has no ground below 0 m, so that its surface is not closed
};

class MesoGround final : public MeshChunks {
 public:
  explicit MesoGround(const MesoOptions& options = {})
      : options_(options), versions_(static_cast<std::size_t>(options.chunks) * options.chunks, 1) {}

  // Positive in the ground, metres or less.
  float solid(glm::vec3 p) const {
    const float hill = this->hill(p.x, p.z) - p.y;
    const float middle = 0.5F * static_cast<float>(options_.samples - 1);
    const float ring = std::hypot(p.x - middle, p.y - hill_at_middle()) - 9;  // an arch across x
    const float arch = 2.2F - std::hypot(ring, p.z - middle);
    // A tunnel along a slanted line, under the arch's feet and through every rim.
    const float tunnel = 2.6F - std::hypot(p.z - middle - 0.37F * (p.x - middle), p.y + 3.3F);
    float value = std::min(std::max(hill, arch), -tunnel);
    for (const auto& [centre, radius] : pits_) value = std::min(value, glm::distance(p, centre) - radius);
    return options_.floor ? std::max(value, -12 - p.y) : std::min(value, p.y);
  }
  // The heights of the hills alone: the far surface.
  Heightfield heights() const {
    Heightfield field = Heightfield::zeros(options_.samples, options_.samples);
    for (int j = 0; j < field.depth; ++j) {
      for (int i = 0; i < field.width; ++i) {
        field.at(i, j) = hill(static_cast<float>(i), static_cast<float>(j));
      }
    }
    return field;
  }
  float hill(float x, float z) const {
    return options_.relief * (0.7F * std::sin(0.09F * x + 1) * std::cos(0.07F * z) +
                              0.3F * std::sin(0.31F * x + 0.2F * z)) +
           4;
  }

  // Removes a ball: an edit of the chunks that it reaches.
  void dig(glm::vec3 centre, float radius) {
    pits_.emplace_back(centre, radius);
    const float side = options_.cell * static_cast<float>(options_.cells);
    for (int b = 0; b < options_.chunks; ++b) {
      for (int a = 0; a < options_.chunks; ++a) {
        const glm::vec2 low = options_.low + side * glm::vec2(a, b);
        const glm::vec2 at(centre.x, centre.z);
        const glm::vec2 nearest = glm::clamp(at, low, low + side);
        if (glm::distance(nearest, at) <= radius + options_.cell) ++version_at({a, b});
      }
    }
  }

  Bounds bounds() const override {
    const float side = options_.cell * static_cast<float>(options_.cells * options_.chunks);
    return {{options_.low.x, -14, options_.low.y}, {options_.low.x + side, 26, options_.low.y + side}};
  }
  float cell() const override { return options_.cell; }
  int cells() const override { return options_.cells; }
  glm::ivec2 chunks() const override { return glm::ivec2(options_.chunks); }
  std::uint64_t version(glm::ivec2 at) const override {
    return const_cast<MesoGround*>(this)->version_at(at);
  }

  TriangleMesh chunk(glm::ivec2 at, int) const override {
    ++built_;
    if (fail_at == at) throw std::runtime_error("this chunk cannot be built");
    const int levels = static_cast<int>(40 / options_.cell);
    Tetrahedra march(*this, {at.x * options_.cells, 0, at.y * options_.cells},
                     {options_.cells, levels, options_.cells});
    march.run();
    return march.mesh;
  }

  int built() const { return built_; }
  glm::ivec2 fail_at{-1};  // a chunk that throws

 private:
  float hill_at_middle() const {
    const float middle = 0.5F * static_cast<float>(options_.samples - 1);
    return hill(middle, middle);
  }
  std::uint64_t& version_at(glm::ivec2 at) {
    return versions_[static_cast<std::size_t>(at.y) * options_.chunks + at.x];
  }
  glm::vec3 place(glm::ivec3 at) const {
    return {options_.low.x + static_cast<float>(at.x) * options_.cell,
            -14 + static_cast<float>(at.y) * options_.cell,
            options_.low.y + static_cast<float>(at.z) * options_.cell};
  }

  // The surface over a box of cells.
  struct Tetrahedra {
    Tetrahedra(const MesoGround& of, glm::ivec3 from, glm::ivec3 size)
        : ground(of), first(from), cells(size) {
      for (int k = 0; k <= cells.z; ++k) {
        for (int l = 0; l <= cells.y; ++l) {
          for (int i = 0; i <= cells.x; ++i) {
            values.push_back(ground.solid(ground.place(first + glm::ivec3(i, l, k))));
          }
        }
      }
    }
    void run() {
      for (int k = 0; k < cells.z; ++k) {
        for (int l = 0; l < cells.y; ++l) {
          for (int i = 0; i < cells.x; ++i) cell(first + glm::ivec3(i, l, k));
        }
      }
    }

    const MesoGround& ground;
    glm::ivec3 first, cells;
    std::vector<float> values;
    TriangleMesh mesh;
    std::map<std::array<int, 6>, std::uint32_t> edges;

    float value(glm::ivec3 at) const {
      const glm::ivec3 local = at - first;
      return values[static_cast<std::size_t>((local.z * (cells.y + 1) + local.y) * (cells.x + 1) + local.x)];
    }
    void cell(glm::ivec3 low) {
      int solid = 0;
      for (int c = 0; c < 8; ++c) solid += value(low + glm::ivec3(c & 1, c >> 1 & 1, c >> 2)) > 0;
      if (solid == 0 || solid == 8) return;
      // Kuhn's six tetrahedra around the diagonal; neighbours share the diagonals of their faces.
      static constexpr int kOrders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
      for (const auto& order : kOrders) {
        std::array<glm::ivec3, 4> corners{low, low, low, low + 1};
        corners[1][order[0]] += 1;
        corners[2] = corners[1];
        corners[2][order[1]] += 1;
        tetrahedron(corners);
      }
    }
    void tetrahedron(const std::array<glm::ivec3, 4>& corners) {
      std::vector<glm::ivec3> in, out;
      for (const glm::ivec3& c : corners) (value(c) > 0 ? in : out).push_back(c);
      const auto edge = [&](std::size_t i, std::size_t o) { return vertex(in[i], out[o]); };
      if (in.empty() || out.empty()) return;
      if (in.size() == 1) add(edge(0, 0), edge(0, 1), edge(0, 2), in[0], out[0]);
      if (out.size() == 1) add(edge(0, 0), edge(1, 0), edge(2, 0), in[0], out[0]);
      if (in.size() == 2) {
        add(edge(0, 0), edge(0, 1), edge(1, 0), in[0], out[0]);
        add(edge(1, 0), edge(0, 1), edge(1, 1), in[0], out[0]);
      }
    }
    std::uint32_t vertex(glm::ivec3 a, glm::ivec3 b) {
      const auto key = [](glm::ivec3 p) { return std::array{p.x, p.y, p.z}; };
      if (key(b) < key(a)) std::swap(a, b);
      const auto [at, fresh] = edges.try_emplace({a.x, a.y, a.z, b.x, b.y, b.z},
                                                 static_cast<std::uint32_t>(mesh.positions.size()));
      if (fresh) {
        const glm::vec3 p = ground.place(a), q = ground.place(b);
        const float at_p = value(a), at_q = value(b);
        mesh.positions.push_back(glm::mix(p, q, std::clamp(at_p / (at_p - at_q), 0.05F, 0.95F)));
        mesh.normals.push_back({0, 1, 0});
      }
      return at->second;
    }
    // Turned so that the front faces the air.
    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c, glm::ivec3 in, glm::ivec3 out) {
      const glm::vec3 &p = mesh.positions[a], &q = mesh.positions[b], &r = mesh.positions[c];
      const bool faces_air = glm::dot(glm::cross(q - p, r - p), ground.place(out) - ground.place(in)) > 0;
      mesh.indices.insert(mesh.indices.end(), {a, faces_air ? b : c, faces_air ? c : b});
    }
  };

  MesoOptions options_;
  std::vector<std::uint64_t> versions_;
  std::vector<std::pair<glm::vec3, float>> pits_;
  mutable std::atomic<int> built_ = 0;
};

}  // namespace terrabench::test
