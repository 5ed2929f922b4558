#include "renderers/relief.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <span>
#include <vector>

#include "renderers/gl.h"
#include "renderers/ramp.h"
#include "renderers/target.h"

namespace terrabench {
namespace {

// The view with its depth range drawn close around the mesh, so that depth is as precise as it can be.
View fit_depth(View view, const Bounds& bounds) {
  const glm::vec3 forward = glm::normalize(view.target - view.eye);
  float nearest = std::numeric_limits<float>::infinity(), farthest = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 p((corner & 1) != 0 ? bounds.high.x : bounds.low.x,
                      (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                      (corner & 4) != 0 ? bounds.high.z : bounds.low.z);
    const float depth = glm::dot(p - view.eye, forward);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  // The margin keeps the outermost vertices from being clipped by rounding. From inside the terrain, a
  // ten-thousandth of the range in front of the eye is not seen.
  constexpr float kMargin = 0.01F, kLeastShare = 1e-4F;
  const float margin = std::max(kMargin * (farthest - nearest), 1e-5F * farthest);
  view.far = std::max(farthest + margin, 1e-3F);
  view.near = std::max(nearest - margin, view.far * kLeastShare);
  return view;
}

// How hollow (below 0) or rounded (above) the surface is around each vertex, as the share by which to change
// its light: valleys darken and ridges lighten, as if they saw less or more of the sky. The bend of normals
// along edges, averaged over neighbours twice for a softer line. O(triangles).
std::vector<float> curvature_shading(const TriangleMesh& mesh) {
  const std::size_t n = mesh.positions.size();
  std::vector<float> bend(n, 0.0F), sum(n, 0.0F);
  std::vector<std::uint32_t> count(n, 0);
  const auto for_each_edge = [&](auto&& visit) {
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
      for (std::size_t k = 0; k < 3; ++k) visit(mesh.indices[t + k], mesh.indices[t + (k + 1) % 3]);
    }
  };
  for_each_edge([&](std::uint32_t i, std::uint32_t j) {
    const glm::vec3 along = mesh.positions[j] - mesh.positions[i];
    const float length = glm::length(along);
    if (!(length > 0)) return;
    const float angle = glm::dot(mesh.normals[j] - mesh.normals[i], along) / length;
    for (const std::uint32_t v : {i, j}) {
      bend[v] += angle;
      ++count[v];
    }
  });
  for (std::size_t v = 0; v < n; ++v) bend[v] /= static_cast<float>(std::max(count[v], 1U));

  for (int pass = 0; pass < 2; ++pass) {
    std::fill(sum.begin(), sum.end(), 0.0F);
    std::fill(count.begin(), count.end(), 0U);
    for_each_edge([&](std::uint32_t i, std::uint32_t j) {
      sum[i] += bend[j];
      sum[j] += bend[i];
      ++count[i];
      ++count[j];
    });
    for (std::size_t v = 0; v < n; ++v) {
      bend[v] = 0.5F * (bend[v] + sum[v] / static_cast<float>(std::max(count[v], 1U)));
    }
  }

  // In units of the mesh's own typical bend, so that fine and coarse meshes of one ground look alike; below a
  // hundredth of a radian an edge counts as straight.
  constexpr float kStrength = 0.17F, kStraight = 0.01F;
  double squares = 0;
  for (const float b : bend) squares += static_cast<double>(b) * b;
  const float typical = std::max(static_cast<float>(std::sqrt(squares / static_cast<double>(n))), kStraight);
  for (float& b : bend) b = kStrength * std::tanh(b / (1.5F * typical));
  return bend;
}

// The factor by which slopes are steepened for the light: what brings the mean slope of the ground up to that
// of a lively hill. Walls and ceilings do not count. O(triangles).
float choose_exaggeration(const TriangleMesh& mesh) {
  constexpr float kLivelySlope = 0.45F, kMost = 8.0F;
  double rise = 0, area = 0;
  for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    const glm::vec3& a = mesh.positions[mesh.indices[t]];
    const glm::vec3 normal =
        glm::cross(mesh.positions[mesh.indices[t + 1]] - a, mesh.positions[mesh.indices[t + 2]] - a);
    const float horizontal = std::hypot(normal.x, normal.z);
    if (normal.y <= 0.2F * horizontal) continue;
    rise += horizontal;
    area += normal.y;
  }
  const auto slope = static_cast<float>(rise / area);  // not a number when nothing faces up
  return slope > 0 ? std::clamp(kLivelySlope / slope, 1.0F, kMost) : 1.0F;
}

struct MeshBuffers {
  VertexArray array;
  std::vector<Buffer> buffers;
};

template <class T>
void add_attribute(MeshBuffers& mesh, GLuint location, GLint components, const std::vector<T>& values) {
  const Buffer& buffer = mesh.buffers.emplace_back(make_buffer(std::span<const T>(values)));
  glVertexArrayVertexBuffer(mesh.array.id(), location, buffer.id(), 0, sizeof(T));
  glVertexArrayAttribFormat(mesh.array.id(), location, components, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(mesh.array.id(), location, location);
  glEnableVertexArrayAttrib(mesh.array.id(), location);
}

MeshBuffers upload(const TriangleMesh& mesh) {
  MeshBuffers gl;
  add_attribute(gl, 0, 3, mesh.positions);
  if (!mesh.normals.empty()) {
    add_attribute(gl, 1, 3, mesh.normals);
    add_attribute(gl, 2, 1, curvature_shading(mesh));
  }
  const Buffer& indices = gl.buffers.emplace_back(make_buffer(std::span<const std::uint32_t>(mesh.indices)));
  glVertexArrayElementBuffer(gl.array.id(), indices.id());
  check_gl("uploading the mesh");
  return gl;
}

Texture1d upload_ramp() {
  constexpr int kColors = 256;
  std::array<glm::vec3, kColors> colors;
  for (int i = 0; i < kColors; ++i) colors[i] = ramp_color(static_cast<float>(i) / (kColors - 1));
  Texture1d ramp;
  glTextureStorage1D(ramp.id(), 1, GL_RGB32F, kColors);
  glTextureSubImage1D(ramp.id(), 0, 0, kColors, GL_RGB, GL_FLOAT, colors.data());
  glTextureParameteri(ramp.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(ramp.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  return ramp;
}

void draw_triangles(const TriangleMesh& mesh) {
  // The count of a draw is a signed 32-bit number.
  constexpr std::size_t kMostIndices = 3U << 28;
  for (std::size_t first = 0; first < mesh.indices.size(); first += kMostIndices) {
    const auto count = static_cast<GLsizei>(std::min(kMostIndices, mesh.indices.size() - first));
    // OpenGL takes the offset in the form of a pointer.
    const auto* const offset =
        reinterpret_cast<const void*>(first * sizeof(std::uint32_t));  // NOLINT(performance-no-int-to-ptr)
    glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, offset);
  }
}

void set_uniforms(const Program& program, const TriangleMesh& mesh, const View& view,
                  const ReliefStyle& style) {
  const glm::mat4 to_clip = world_to_clip(fit_depth(view, bounds_of(mesh)));
  const glm::vec3 sun = glm::normalize(style.sun);
  const float exaggeration =
      style.shading_exaggeration > 0 ? style.shading_exaggeration : choose_exaggeration(mesh);
  const GLuint id = program.id();
  glProgramUniformMatrix4fv(id, uniform(program, "world_to_clip"), 1, GL_FALSE, glm::value_ptr(to_clip));
  glProgramUniform3fv(id, uniform(program, "sun"), 1, glm::value_ptr(sun));
  glProgramUniform3fv(id, uniform(program, "eye"), 1, glm::value_ptr(view.eye));
  // A ramp of no extent is all its lowest colour, not a division by zero.
  glProgramUniform2f(
      id, uniform(program, "height_range"), style.lowest,
      std::max(style.highest, std::nextafter(style.lowest, std::numeric_limits<float>::max())));
  glProgramUniform1f(id, uniform(program, "exaggeration"), exaggeration);
  glProgramUniform1i(id, uniform(program, "facets"), mesh.normals.empty() ? 1 : 0);
  glProgramUniform1i(id, uniform(program, "ramp"), 0);
  glProgramUniform1i(id, uniform(program, "edges"), 0);
}

// The edges over the surface, which is pushed back a little so that they win where both have one depth.
void draw_edges(const Program& program, const TriangleMesh& mesh) {
  glProgramUniform1i(program.id(), uniform(program, "edges"), 1);
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  draw_triangles(mesh);
  glDisable(GL_BLEND);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

void draw(const TriangleMesh& mesh, const View& view, const ReliefStyle& style) {
  const Program program = link_program(shader_file("relief.vert"), shader_file("relief.frag"));
  const Texture1d ramp = upload_ramp();
  const MeshBuffers buffers = upload(mesh);
  set_uniforms(program, mesh, view, style);
  glUseProgram(program.id());
  glBindTextureUnit(0, ramp.id());
  glBindVertexArray(buffers.array.id());
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  if (style.wireframe) {
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1, 1);
  }
  draw_triangles(mesh);
  if (style.wireframe) draw_edges(program, mesh);
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(0);
  glUseProgram(0);
  check_gl("drawing the mesh");
}

}  // namespace

Image render_relief(GlContext& context, const TriangleMesh& mesh, const View& view,
                    const ReliefStyle& style) {
  assert(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size());
  context.make_current();
  RenderTarget& target = context.target();
  target.resize(view.width, view.height);
  target.bind();
  const auto channel = [&](std::size_t i) { return static_cast<float>(style.background[i]) / 255.0F; };
  glClearColor(channel(0), channel(1), channel(2), 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  if (mesh.triangles() > 0) draw(mesh, view, style);
  return target.read();
}

}  // namespace terrabench
