// Implicit surfaces and fields with known answers.
#pragma once

#include <map>

#include "representations/implicit/implicit_surface.h"
#include "tests/representations/ground.h"

namespace terrabench::test {

struct ImplicitOptions {
  std::int64_t resolution = 0;
  std::string_view kernel = "cube", extractor = "marching_cubes";
  double radius = 0, cell = 0;
};

inline std::unique_ptr<ImplicitSurface> implicit(const TerrainSource& source,
                                                 const ImplicitOptions& options) {
  const RepresentationType& type = representation("implicit");
  Parameters parameters(type.parameters);
  parameters.set("resolution", options.resolution);
  parameters.set("kernel", std::string(options.kernel));
  parameters.set("extractor", std::string(options.extractor));
  parameters.set("radius", options.radius);
  parameters.set("cell", options.cell);
  Progress progress;
  return std::unique_ptr<ImplicitSurface>(
      dynamic_cast<ImplicitSurface*>(type.build(source, parameters, progress).release()));
}

// A field given by a function of the position, without limits in height.
class FunctionField final : public SampledField {
 public:
  explicit FunctionField(std::function<float(glm::vec3)> value) : value_(std::move(value)) {}

  std::unique_ptr<FieldPlanes> planes(std::span<const float> xs, std::span<const float> ys) const override {
    struct Planes final : FieldPlanes {
      Planes(const FunctionField& of, std::span<const float> x, std::span<const float> y)
          : field(of), xs(x), ys(y) {}
      void sample(double z, std::span<float> out) override {
        for (std::size_t i = 0; i < xs.size(); ++i) {
          for (std::size_t k = 0; k < ys.size(); ++k) {
            out[i * ys.size() + k] = field.at({xs[i], ys[k], static_cast<float>(z)});
          }
        }
      }
      const FunctionField& field;
      std::span<const float> xs, ys;
    };
    return std::make_unique<Planes>(*this, xs, ys);
  }
  float at(glm::vec3 p) const override { return value_(p); }
  Heights heights(glm::dvec2, glm::dvec2) const override { return {-1e300, 1e300}; }

 private:
  std::function<float(glm::vec3)> value_;
};

// Vertices - edges + triangles: 2 for each ball, 0 for each ring.
inline std::int64_t euler_characteristic(const TriangleMesh& mesh) {
  return static_cast<std::int64_t>(mesh.positions.size()) -
         static_cast<std::int64_t>(check_edges(mesh).edges) + static_cast<std::int64_t>(mesh.triangles());
}

using Vertex = std::array<float, 6>;  // position and normal

inline Vertex vertex_of(const TriangleMesh& mesh, std::uint32_t v) {
  const glm::vec3 p = mesh.positions[v], n = mesh.normals[v];
  return {p.x, p.y, p.z, n.x, n.y, n.z};
}

// The edges of one triangle alone, as vertex numbers.
inline std::vector<std::pair<std::uint32_t, std::uint32_t>> open_edges(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (std::size_t t = 0; t < mesh.indices.size(); ++t) {
    const std::uint32_t a = mesh.indices[t], b = mesh.indices[t % 3 == 2 ? t - 2 : t + 1];
    ++uses[std::minmax(a, b)];
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open;
  for (const auto& [edge, count] : uses) {
    if (count == 1) open.push_back(edge);
  }
  return open;
}

inline bool same_mesh(const TriangleMesh& a, const TriangleMesh& b) {
  return a.positions == b.positions && a.normals == b.normals && a.indices == b.indices;
}

}  // namespace terrabench::test
