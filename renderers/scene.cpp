#include "renderers/scene.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <optional>

#include "renderers/gl.h"
#include "renderers/ramp.h"
#include "renderers/scene_parts.h"
#include "renderers/target.h"
#include "terrain/framing.h"

namespace terrabench {
namespace {

// The view with its depth range fitted to the scene, for the best depth precision.
View fit_depth(View view, const Bounds& bounds) {
  auto [nearest, farthest] = depth_range(view, bounds);
  farthest = std::max(farthest, 0.0F);
  // The margin keeps rounding from clipping the outermost vertices. From inside the terrain, kLeastShare of
  // the depth range in front of the eye is clipped.
  constexpr float kMargin = 0.01F, kLeastShare = 1e-4F;
  const float margin = std::max(kMargin * (farthest - nearest), 1e-5F * farthest);
  view.far = std::max(farthest + margin, 1e-3F);
  view.near = std::max(nearest - margin, view.far * kLeastShare);
  return view;
}

constexpr GLuint kRampUnit = 0, kWiresUnit = 1;  // texture units

struct MeshBuffers {
  VertexArray array;
  std::vector<Buffer> buffers;
};

template <class T>
void add_attribute(MeshBuffers& mesh, GLuint location, GLint components, GLenum type,
                   const std::vector<T>& values) {
  const Buffer& buffer = mesh.buffers.emplace_back(make_buffer(std::span<const T>(values)));
  glVertexArrayVertexBuffer(mesh.array.id(), location, buffer.id(), 0, sizeof(T));
  // Integers are normalised to [0, 1].
  glVertexArrayAttribFormat(mesh.array.id(), location, components, type, GL_TRUE, 0);
  glVertexArrayAttribBinding(mesh.array.id(), location, location);
  glEnableVertexArrayAttrib(mesh.array.id(), location);
}

MeshBuffers upload(const SceneMesh& item) {
  MeshBuffers gl;
  add_attribute(gl, 0, 3, GL_FLOAT, item.mesh->positions);
  if (item.shading == Shading::kLit) {
    if (!item.mesh->normals.empty()) {
      add_attribute(gl, 1, 3, GL_FLOAT, item.mesh->normals);
      add_attribute(gl, 2, 1, GL_FLOAT, curvature_shading(*item.mesh));
    }
    if (!item.colors.empty()) add_attribute(gl, 3, 3, GL_UNSIGNED_BYTE, item.colors);
  }
  const Buffer& indices =
      gl.buffers.emplace_back(make_buffer(std::span<const std::uint32_t>(item.mesh->indices)));
  glVertexArrayElementBuffer(gl.array.id(), indices.id());
  check_gl("uploading the mesh");
  return gl;
}

// Calls `before` with the number of the first triangle of each draw call.
template <class Before>
void draw_triangles(const TriangleMesh& mesh, const Before& before) {
  // OpenGL's count is a signed 32-bit number.
  constexpr std::size_t kMostIndices = 3U << 28;
  for (std::size_t first = 0; first < mesh.indices.size(); first += kMostIndices) {
    const auto count = static_cast<GLsizei>(std::min(kMostIndices, mesh.indices.size() - first));
    // OpenGL takes the offset as a pointer.
    const auto* const offset =
        reinterpret_cast<const void*>(first * sizeof(std::uint32_t));  // NOLINT(performance-no-int-to-ptr)
    before(static_cast<GLint>(first / 3));
    glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, offset);
  }
}

void set(const Program& program, const char* name, const glm::vec3& value) {
  glProgramUniform3fv(program.id(), uniform(program, name), 1, glm::value_ptr(value));
}
void set(const Program& program, const char* name, float value) {
  glProgramUniform1f(program.id(), uniform(program, name), value);
}
void set(const Program& program, const char* name, bool value) {
  glProgramUniform1i(program.id(), uniform(program, name), value ? 1 : 0);
}

// Sets the uniforms that all meshes of a picture share.
void set_scene(const Program& program, const Scene& scene, const View& view, const glm::mat4& to_clip) {
  const GLuint id = program.id();
  glProgramUniformMatrix4fv(id, uniform(program, "world_to_clip"), 1, GL_FALSE, glm::value_ptr(to_clip));
  set(program, "sun", glm::normalize(scene.sun));
  set(program, "eye", view.eye);
  // An empty height range gives the lowest colour, not a division by zero.
  glProgramUniform2f(
      id, uniform(program, "height_range"), scene.lowest,
      std::max(scene.highest, std::nextafter(scene.lowest, std::numeric_limits<float>::max())));
  glProgramUniform1i(id, uniform(program, "ramp"), kRampUnit);
}

void set_shading(const Program& program, const SceneMesh& item) {
  const bool lit = item.shading == Shading::kLit;
  const float exaggeration = item.shading_exaggeration > 0 ? item.shading_exaggeration
                             : lit                         ? choose_exaggeration(*item.mesh)
                                                           : 1.0F;
  set(program, "exaggeration", exaggeration);
  set(program, "facets", item.mesh->normals.empty());
  set(program, "painted", !item.colors.empty());
  set(program, "flat_fill", !lit);
  set(program, "fill_color", as_shares(item.fill));
  const glm::vec4 ink(as_shares(item.wire_color), item.wire_opacity);
  glProgramUniform4fv(program.id(), uniform(program, "wire_ink"), 1, glm::value_ptr(ink));
}

// The two programs that draw meshes. Only the one for wires has the geometry shader, which costs time.
class MeshPainter {
 public:
  MeshPainter(const Scene& scene, const View& view, const glm::mat4& to_clip)
      : scene_(scene), view_(view), to_clip_(to_clip) {}

  void paint(const SceneMesh& item) {
    const MeshBuffers buffers = upload(item);
    glBindVertexArray(buffers.array.id());
    glBindTextureUnit(kRampUnit, ramp_.id());
    if (item.wire_width > 0) {
      paint_with_wires(item);
    } else {
      const Program& program = linked(plain_, nullptr);
      set_shading(program, item);
      glUseProgram(program.id());
      draw_triangles(*item.mesh, [](GLint) {});
    }
    glBindVertexArray(0);
    check_gl("drawing the mesh");
  }

 private:
  const Program& linked(std::optional<Program>& program, const ShaderFile* geometry) {
    if (!program) {
      program = link_program(shader_file("mesh.vert"), shader_file("relief.frag"), geometry);
      set_scene(*program, scene_, view_, to_clip_);
    }
    return *program;
  }

  void paint_with_wires(const SceneMesh& item) {
    const Program& program = linked(wired_, &shader_file("wire.geom"));
    const GLuint id = program.id();
    set_shading(program, item);
    glProgramUniform2f(id, uniform(program, "pixels"), static_cast<float>(view_.width),
                       static_cast<float>(view_.height));
    set(program, "wire_width", item.wire_width);
    glProgramUniform1i(id, uniform(program, "drawn"), kWiresUnit);
    const std::vector<std::uint8_t> wires = with_outlines(*item.mesh, item.wires, view_.eye);
    const Buffer masks = make_buffer(std::span<const std::uint8_t>(wires));
    const BufferTexture drawn;
    glTextureBuffer(drawn.id(), GL_R8UI, masks.id());
    glBindTextureUnit(kWiresUnit, drawn.id());
    glUseProgram(id);
    const GLint first_triangle = uniform(program, "first_triangle");
    draw_triangles(*item.mesh, [&](GLint first) { glProgramUniform1i(id, first_triangle, first); });
  }

  const Scene& scene_;
  const View& view_;
  glm::mat4 to_clip_;
  std::optional<Program> plain_, wired_;
  Texture1d ramp_ = make_ramp_texture();
};

void draw(const Scene& scene, const View& view) {
  const glm::mat4 to_clip = world_to_clip(fit_depth(view, bounds_of(scene)));
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  MeshPainter painter(scene, view, to_clip);
  for (const SceneMesh& item : scene.meshes) {
    if (item.mesh->triangles() > 0) painter.paint(item);
  }
  if (!scene.planes.empty() || !scene.lines.empty()) draw_overlay(scene, view, to_clip);
  glDisable(GL_DEPTH_TEST);
  glUseProgram(0);
  check_gl("drawing the scene");
}

}  // namespace

Bounds bounds_of(const Scene& scene) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  Bounds box{glm::vec3(kFar), glm::vec3(-kFar)};
  const auto add = [&](const glm::vec3& point) {
    box.low = glm::min(box.low, point);
    box.high = glm::max(box.high, point);
  };
  for (const SceneMesh& item : scene.meshes) {
    if (item.mesh->positions.empty()) continue;
    const Bounds mesh = bounds_of(*item.mesh);
    add(mesh.low);
    add(mesh.high);
  }
  for (const ScenePlane& plane : scene.planes) std::for_each(plane.corners.begin(), plane.corners.end(), add);
  for (const SceneLine& line : scene.lines) std::for_each(line.points.begin(), line.points.end(), add);
  return box.low.x <= box.high.x ? box : Bounds{};
}

Image render_scene(GlContext& context, const Scene& scene, const View& view) {
  bool empty = scene.planes.empty() && scene.lines.empty();
  for (const SceneMesh& item : scene.meshes) {
    assert(item.mesh != nullptr);
    assert(item.mesh->normals.empty() || item.mesh->normals.size() == item.mesh->positions.size());
    assert(item.colors.empty() || item.colors.size() == item.mesh->positions.size());
    assert(item.wires.empty() || item.wires.size() == item.mesh->triangles());
    empty = empty && item.mesh->triangles() == 0;
  }
  context.make_current();
  context.target().begin(view.width, view.height, scene.background);
  if (!empty) draw(scene, view);
  return context.target().read();
}

Image render_relief(GlContext& context, const TriangleMesh& mesh, const View& view,
                    const ReliefStyle& style) {
  Scene scene;
  scene.lowest = style.lowest;
  scene.highest = style.highest;
  scene.sun = style.sun;
  scene.background = style.background;
  SceneMesh& drawn = scene.meshes.emplace_back();
  drawn.mesh = &mesh;
  drawn.shading_exaggeration = style.shading_exaggeration;
  return render_scene(context, scene, view);
}

}  // namespace terrabench
