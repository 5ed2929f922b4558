#include "experiments/meshgrow/models.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <numbers>

#include "representations/procedural_mesh/growing/expression.h"
#include "terrain/error.h"

namespace terrabench::meshgrow {
namespace {

float noise(const glm::vec3& p) { return static_cast<float>(growing::gradient_noise(p.x, p.y, p.z)); }

// Several octaves, about -1 to 1.
float rough_noise(glm::vec3 p) {
  float sum = 0, weight = 1;
  for (int octave = 0; octave < 4; ++octave, p *= 2.03F, weight *= 0.5F) sum += weight * noise(p);
  return sum;
}

RayMaterial chair(std::string_view symbol, const SurfacePoint& at) {
  const glm::vec3& p = at.local;
  if (symbol == "cloth" || symbol == "cushion") {
    const float dye = 1 + 0.12F * rough_noise(14.0F * p);
    return {.albedo = dye * glm::vec3(0.42F, 0.06F, 0.05F), .roughness = 1};
  }
  // Fine fibres along the legs and across the seat and the back, and broad, faint figure.
  const glm::vec3 along = p.y < 0.41F ? glm::vec3(70, 2.5F, 70) : glm::vec3(70, 70, 2.5F);
  const float fibre = 0.5F + 0.3F * rough_noise(along * p) + 0.25F * noise(0.1F * along * p);
  const glm::vec3 wood = glm::mix(glm::vec3(0.25F, 0.125F, 0.055F), glm::vec3(0.34F, 0.185F, 0.085F),
                                  std::clamp(fibre, 0.0F, 1.0F));
  return {.albedo = wood, .specular = 0.04F, .roughness = 0.4F};
}

RayMaterial cactus(std::string_view symbol, const SurfacePoint& at) {
  if (symbol == "spike") return {.albedo = {0.72F, 0.6F, 0.34F}, .roughness = 0.6F};
  // Lighter along the ribs, which follow u.
  const float rib = 0.5F + 0.5F * std::cos(8 * std::numbers::pi_v<float> * at.texture.x);
  const glm::vec3 green = glm::mix(glm::vec3(0.05F, 0.16F, 0.05F), glm::vec3(0.15F, 0.33F, 0.1F), rib);
  return {.albedo = (1 + 0.15F * rough_noise(6.0F * at.local)) * green, .specular = 0.03F, .roughness = 0.5F};
}

RayMaterial fork(std::string_view, const SurfacePoint& at) {
  // Dark in the grooves between the ridges of cos(360° · 8u), and spotted.
  const float ridge = 0.5F + 0.5F * std::cos(16 * std::numbers::pi_v<float> * at.texture.x);
  const float spots = 1 + 0.35F * rough_noise(9.0F * at.local * glm::vec3(1, 0.4F, 1));
  const glm::vec3 bark = glm::mix(glm::vec3(0.13F, 0.085F, 0.055F), glm::vec3(0.36F, 0.27F, 0.19F), ridge);
  return {.albedo = glm::clamp(spots * bark, 0.0F, 1.0F), .roughness = 1};
}

struct Tree {
  glm::vec3 leaf_dark, leaf_light;
  glm::vec3 grain;  // how often the bark's pattern repeats per metre, along each axis
  glm::vec3 bark_dark, bark_light;
};
constexpr Tree kAspen{
    {0.13F, 0.27F, 0.05F}, {0.3F, 0.42F, 0.09F}, {9, 40, 9}, {0.2F, 0.18F, 0.15F}, {0.46F, 0.43F, 0.36F}};
constexpr Tree kTupelo{
    {0.07F, 0.2F, 0.04F}, {0.2F, 0.36F, 0.08F}, {20, 8, 20}, {0.1F, 0.07F, 0.05F}, {0.26F, 0.2F, 0.15F}};
constexpr Tree kTamarack{
    {0.05F, 0.16F, 0.07F}, {0.13F, 0.27F, 0.1F}, {14, 5, 14}, {0.13F, 0.09F, 0.07F}, {0.3F, 0.23F, 0.18F}};
constexpr Tree kOak{
    {0.1F, 0.18F, 0.04F}, {0.26F, 0.32F, 0.08F}, {18, 5, 18}, {0.08F, 0.07F, 0.06F}, {0.24F, 0.21F, 0.18F}};

template <const Tree& look>
RayMaterial tree(std::string_view symbol, const SurfacePoint& at) {
  if (symbol != "green") {
    const float spots = std::clamp(0.5F + rough_noise(look.grain * at.local), 0.0F, 1.0F);
    return {.albedo = glm::mix(look.bark_dark, look.bark_light, spots), .roughness = 1};
  }
  const float mix = std::clamp(0.5F + 0.9F * noise(2.3F * at.local), 0.0F, 1.0F);
  return {.albedo = glm::mix(look.leaf_dark, look.leaf_light, mix),
          .translucency = 0.35F,
          .specular = 0.03F,
          .roughness = 0.5F};
}

RayMaterial candle_holder(std::string_view symbol, const SurfacePoint& at) {
  if (symbol == "wax") return {.albedo = {0.82F, 0.77F, 0.62F}, .specular = 0.03F, .roughness = 0.4F};
  // Rust lies where the model's own noise eats pits, and in larger stains.
  const glm::vec3& p = at.local;
  const float pits = std::clamp(4 * noise(40.0F * p) - 0.6F, 0.0F, 1.0F);
  const float stains = std::clamp(1.6F * rough_noise(9.0F * p) + 0.1F, 0.0F, 1.0F);
  const float rust = std::max(pits, stains);
  const float hue = std::clamp(0.5F + rough_noise(70.0F * p), 0.0F, 1.0F);
  const glm::vec3 brown = glm::mix(glm::vec3(0.17F, 0.055F, 0.02F), glm::vec3(0.42F, 0.17F, 0.05F), hue);
  return {.albedo = glm::mix(glm::vec3(0.1F, 0.1F, 0.11F), brown, rust),
          .specular = 0.04F * (1 - rust),
          .metal = 0.7F * (1 - rust),
          .roughness = glm::mix(0.42F, 1.0F, rust)};
}

constexpr std::array kPainted{
    PaintedModel{"chair", chair},
    PaintedModel{"cactus", cactus},
    PaintedModel{"fork_ridges", fork},
    PaintedModel{"fork_ridges_random", fork},
    PaintedModel{"branch_aspen", tree<kAspen>},
    PaintedModel{"bush_tupelo", tree<kTupelo>},
    PaintedModel{"aspen", tree<kAspen>},
    PaintedModel{"tamarack", tree<kTamarack>},
    PaintedModel{"oak", tree<kOak>},
    PaintedModel{"candle_holder", candle_holder},
};

}  // namespace

const PaintedModel& painted(std::string_view model) {
  std::vector<std::string_view> names;
  for (const PaintedModel& each : kPainted) {
    if (each.model == model) return each;
    names.push_back(each.model);
  }
  throw unknown_name("painted model", model, names);
}

namespace {

// Normals are smooth where faces meet at less than this angle; elsewhere the surface has an edge, as at the
// foot of a spike and around a leaf.
constexpr float kSmoothCosine = 0.64F;  // 50°

glm::vec3 unit(const glm::vec3& v) {
  const float length = glm::length(v);
  return length > 0 ? v / length : glm::vec3(0, 1, 0);
}

// Radians between the sides of a triangle at `at`; 0 for a triangle without area, which has no normal.
float angle_at(const glm::vec3& at, const glm::vec3& a, const glm::vec3& b) {
  const glm::vec3 to_a = a - at, to_b = b - at;
  return std::atan2(glm::length(glm::cross(to_a, to_b)), glm::dot(to_a, to_b));
}

// Gives each corner of a triangle the mean normal of the triangles at its vertex that are smooth with its
// own, weighted by their angles there (Thürmer and Wüthrich 1998): by area, the mean would depend on the
// diagonals along which polygons are cut. A vertex whose corners differ becomes several. O(triangles ·
// triangles at a vertex)
void add_normals(ModelMesh& out) {
  TriangleMesh& mesh = out.mesh;
  std::vector<glm::vec3> units(mesh.triangles());
  std::vector<float> angles(mesh.indices.size());
  std::vector<std::uint32_t> first(mesh.positions.size() + 1), uses(mesh.indices.size());
  for (std::size_t t = 0; t < units.size(); ++t) {
    const std::uint32_t* const v = &mesh.indices[3 * t];
    const auto at = [&](std::size_t k) { return mesh.positions[v[k % 3]]; };
    units[t] = unit(glm::cross(at(1) - at(0), at(2) - at(0)));
    for (std::size_t k = 0; k < 3; ++k) {
      angles[3 * t + k] = angle_at(at(k), at(k + 1), at(k + 2));
      ++first[v[k] + 1];
    }
  }
  for (std::size_t v = 0; v + 1 < first.size(); ++v) first[v + 1] += first[v];
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::uint32_t c = 0; c < mesh.indices.size(); ++c) uses[next[mesh.indices[c]]++] = c;
  const std::size_t vertices = mesh.positions.size();
  mesh.normals.assign(vertices, glm::vec3(0, 1, 0));
  std::vector<std::pair<glm::vec3, std::uint32_t>> made;  // the normals at a place, and their vertices
  for (std::uint32_t v = 0; v < vertices; ++v) {
    made.clear();
    for (std::uint32_t k = first[v]; k < first[v + 1]; ++k) {
      glm::vec3 sum(0);
      for (std::uint32_t other = first[v]; other < first[v + 1]; ++other) {
        const glm::vec3& normal = units[uses[other] / 3];
        if (glm::dot(units[uses[k] / 3], normal) >= kSmoothCosine) sum += angles[uses[other]] * normal;
      }
      const auto same = [&](const auto& each) { return each.first == sum; };
      auto at = std::find_if(made.begin(), made.end(), same);
      if (at == made.end()) {
        const bool another = !made.empty();
        const auto number = another ? static_cast<std::uint32_t>(mesh.positions.size()) : v;
        if (another) {
          mesh.positions.push_back(glm::vec3(mesh.positions[v]));
          mesh.normals.push_back(unit(sum));
          if (!out.texture.empty()) out.texture.push_back(glm::vec2(out.texture[v]));
        } else {
          mesh.normals[v] = unit(sum);
        }
        at = made.insert(made.end(), {sum, number});
      }
      mesh.indices[uses[k]] = at->second;
    }
  }
}

}  // namespace

ModelMesh triangles_of(const FaceMesh& faces) {
  ModelMesh out;
  out.mesh.positions = faces.positions;
  out.texture = faces.texture;
  for (std::size_t f = 0; f < faces.faces(); ++f) {
    const std::uint32_t* corner = &faces.corners[faces.first_corner[f]];
    const std::uint32_t n = faces.first_corner[f + 1] - faces.first_corner[f];
    const auto at = [&](std::uint32_t k) { return corner[k % n]; };
    const auto diagonal = [&](std::uint32_t k) {
      return glm::distance(faces.positions[at(k)], faces.positions[at(k + 2)]);
    };
    const std::uint32_t apex = n == 4 && diagonal(1) < diagonal(0) ? 1 : 0;
    for (std::uint32_t k = 1; k + 1 < n; ++k) {
      out.mesh.indices.insert(out.mesh.indices.end(), {at(apex), at(apex + k), at(apex + k + 1)});
      out.wires.push_back(static_cast<std::uint8_t>((k == 1 ? 1U : 0U) | 2U | (k + 2 == n ? 4U : 0U)));
      out.symbols.push_back(faces.symbols.empty() ? 0 : faces.symbols[f]);
    }
  }
  add_normals(out);
  return out;
}

RayMesh in_materials(const ModelMesh& mesh, const PaintedModel& look, const growing::RuleSystem& system) {
  return {.mesh = &mesh.mesh,
          .texture = mesh.texture,
          .material_at = [&mesh, &look, &system](const SurfacePoint& at) {
            return look.material(system.symbols[mesh.symbols[at.triangle]].name, at);
          }};
}

View close_view(std::span<const glm::vec3> points, View view, float margin) {
  for (int step = 0; step < 6; ++step) {
    const glm::mat4 to_clip = world_to_clip(view);
    glm::vec2 low(1e9F), high(-1e9F);
    for (const glm::vec3& point : points) {
      const glm::vec4 at = to_clip * glm::vec4(point, 1);
      low = glm::min(low, glm::vec2(at) / at.w);
      high = glm::max(high, glm::vec2(at) / at.w);
    }
    const glm::vec3 back = view.eye - view.target, from = glm::normalize(back);
    const glm::vec3 right = glm::normalize(glm::cross(view.up, from)), above = glm::cross(from, right);
    const float slope_y = std::tan(0.5F * view.vertical_fov) * glm::length(back);
    const float slope_x = slope_y * static_cast<float>(view.width) / static_cast<float>(view.height);
    const glm::vec2 middle = 0.5F * (low + high), half = 0.5F * (high - low);
    view.target += middle.x * slope_x * right + middle.y * slope_y * above;
    view.eye = view.target + margin * std::max(half.x, half.y) * back;
  }
  return view;
}

Daylight model_daylight() {
  Daylight light;
  light.sun = {-0.5F, 1.0F, 0.45F};
  light.sun_irradiance = 3.6F * sun_color(light.turbidity, glm::normalize(light.sun).y);
  light.sun_radius = 0.035F;
  light.sky_irradiance = 1.2F;
  return light;
}

}  // namespace terrabench::meshgrow
