#include <algorithm>
#include <cassert>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <numeric>
#include <span>

#include "renderers/gl.h"
#include "renderers/scene_parts.h"

namespace terrabench {
namespace {

// Laid out as in shaders/overlay.vert.
struct Vertex {
  glm::vec4 clip, ink;
  glm::vec2 profile;
};

// Distance from the near plane in clip space; points with a negative one are clipped.
float depth_in_front(const glm::vec4& clip) { return clip.z + clip.w; }

// Moves overlays nearer by a hundred-thousandth of the depth range, so that they win against coplanar
// surfaces.
constexpr float kDepthBias = 2e-5F;

class Triangles {
 public:
  Triangles(const View& view, const glm::mat4& to_clip)
      : pixels_(static_cast<float>(view.width), static_cast<float>(view.height)), to_clip_(to_clip) {}

  void add_plane(const ScenePlane& plane) {
    assert(plane.corners.size() >= 3);
    const glm::vec4 fill = ink(plane.color, plane.fill_opacity);
    const std::vector<glm::vec3> seen = in_front(plane.corners);
    const glm::vec2 inside(0, 1e6F);  // without a soft border, which the outline covers
    for (std::size_t i = 2; i < seen.size(); ++i) {
      for (const std::size_t corner : {std::size_t{0}, i - 1, i}) {
        vertices_.push_back({glm::vec4(seen[corner], 1), fill, inside});
      }
    }
    if (plane.line_width <= 0) return;
    for (std::size_t i = 0; i < plane.corners.size(); ++i) {
      add_segment(plane.corners[i], plane.corners[(i + 1) % plane.corners.size()], ink(plane.color, 1),
                  plane.line_width);
    }
  }

  void add_line(const SceneLine& line) {
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      add_segment(line.points[i - 1], line.points[i], ink(line.color, 1), line.width);
    }
  }

  std::span<const Vertex> vertices() const { return vertices_; }

 private:
  static glm::vec4 ink(const Rgb& color, float opacity) {
    return {glm::vec3(color[0], color[1], color[2]) / 255.0F, opacity};
  }

  static glm::vec3 divide(const glm::vec4& clip) {
    glm::vec3 device = glm::vec3(clip) / clip.w;
    device.z -= kDepthBias;
    return device;
  }

  static glm::vec4 cut(const glm::vec4& a, const glm::vec4& b) {
    return glm::mix(a, b, depth_in_front(a) / (depth_in_front(a) - depth_in_front(b)));
  }

  // The part of the polygon beyond the near plane, in device coordinates.
  std::vector<glm::vec3> in_front(const std::vector<glm::vec3>& corners) const {
    std::vector<glm::vec3> kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const glm::vec4 a = to_clip_ * glm::vec4(corners[i], 1);
      const glm::vec4 b = to_clip_ * glm::vec4(corners[(i + 1) % corners.size()], 1);
      if (depth_in_front(a) >= 0) kept.push_back(divide(a));
      if ((depth_in_front(a) >= 0) != (depth_in_front(b) >= 0)) kept.push_back(divide(cut(a, b)));
    }
    return kept;
  }

  // A rectangle on the screen around the segment, with a margin of one pixel for its soft border.
  void add_segment(const glm::vec3& from, const glm::vec3& to, const glm::vec4& colour, float width) {
    glm::vec4 a = to_clip_ * glm::vec4(from, 1), b = to_clip_ * glm::vec4(to, 1);
    if (depth_in_front(a) < 0 && depth_in_front(b) < 0) return;
    if (depth_in_front(a) < 0) a = cut(a, b);
    if (depth_in_front(b) < 0) b = cut(b, a);
    const glm::vec3 ends[] = {divide(a), divide(b)};
    const glm::vec2 along = (glm::vec2(ends[1]) - glm::vec2(ends[0])) * pixels_;
    const float length = glm::length(along);
    if (!(length > 0)) return;
    const glm::vec2 forward = along / length, side(-forward.y, forward.x);
    const float half = 0.5F * width, reach = half + 1;
    const auto corner = [&](int end, float across) {
      // Extended by half a width at both ends, so that the segments of a line join.
      const glm::vec2 shift = 2.0F * (side * across + forward * (end == 0 ? -half : half)) / pixels_;
      return Vertex{glm::vec4(glm::vec2(ends[end]) + shift, ends[end].z, 1), colour, {across, half}};
    };
    for (const auto& [end, across] :
         {std::pair{0, -reach}, {1, -reach}, {1, reach}, {0, -reach}, {1, reach}, {0, reach}}) {
      vertices_.push_back(corner(end, across));
    }
  }

  glm::vec2 pixels_;
  glm::mat4 to_clip_;
  std::vector<Vertex> vertices_;
};

// The planes' numbers, from the farthest to the nearest by their middles.
std::vector<std::size_t> back_to_front(const std::vector<ScenePlane>& planes, const glm::vec3& eye) {
  std::vector<float> distance;
  for (const ScenePlane& plane : planes) {
    const glm::vec3 sum = std::accumulate(plane.corners.begin(), plane.corners.end(), glm::vec3(0));
    distance.push_back(glm::distance(eye, sum / static_cast<float>(plane.corners.size())));
  }
  std::vector<std::size_t> order(planes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return distance[a] > distance[b]; });
  return order;
}

}  // namespace

void draw_overlay(const Scene& scene, const View& view, const glm::mat4& world_to_clip) {
  Triangles triangles(view, world_to_clip);
  for (const std::size_t i : back_to_front(scene.planes, view.eye)) triangles.add_plane(scene.planes[i]);
  for (const SceneLine& line : scene.lines) triangles.add_line(line);
  if (triangles.vertices().empty()) return;

  const Program program = link_program("overlay.vert", "overlay.frag");
  const VertexArray array;
  const Buffer buffer = make_buffer(triangles.vertices());
  glVertexArrayVertexBuffer(array.id(), 0, buffer.id(), 0, sizeof(Vertex));
  const auto attribute = [&](GLuint location, GLint components, std::size_t offset) {
    glVertexArrayAttribFormat(array.id(), location, components, GL_FLOAT, GL_FALSE,
                              static_cast<GLuint>(offset));
    glVertexArrayAttribBinding(array.id(), location, 0);
    glEnableVertexArrayAttrib(array.id(), location);
  };
  attribute(0, 4, offsetof(Vertex, clip));
  attribute(1, 4, offsetof(Vertex, ink));
  attribute(2, 2, offsetof(Vertex, profile));
  glUseProgram(program.id());
  glBindVertexArray(array.id());
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);  // planes are translucent and must not hide later ones
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(triangles.vertices().size()));
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glBindVertexArray(0);
  check_gl("drawing planes and lines");
}

}  // namespace terrabench
