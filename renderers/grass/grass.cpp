#include "renderers/grass/grass.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <optional>

#include "renderers/gl.h"
#include "renderers/grass/look_block.h"
#include "renderers/grass/texture.h"
#include "terrain/solid.h"

namespace terrabench {
namespace {

// Numbers of the shaders.
constexpr GLuint kGrowthBlock = 1, kVertices = 0, kTriangles = 1, kStrands = 2, kCommand = 3;
constexpr std::uint32_t kGroup = 64;  // of grass_place.comp

struct Vertex {
  glm::vec3 position, normal;
};

struct GrowthBlock {  // std140
  float height, variation, width, texture_metres;
  std::uint32_t point, turned, strands, triangles, random, unused[3];
};

// Argument of glMultiDrawArraysIndirect.
struct RunCommand {
  std::uint32_t count, instances, first, base_instance;
};

// Argument of glDrawElementsIndirect.
struct Command {
  std::uint32_t count = 12, instances = 0, first_index = 0;
  std::int32_t base_vertex = 0;
  std::uint32_t base_instance = 0;
};

// The two triangles of each billboard, from its corners in the order left and right, bottom and top.
constexpr std::array<std::uint16_t, 12> kCorners = {0, 1, 2, 2, 1, 3, 4, 5, 6, 6, 5, 7};

Texture2dArray make_texture() {
  const std::vector<GrassTexels> levels = paint_grass();
  Texture2dArray texture;
  glTextureStorage3D(texture.id(), static_cast<GLsizei>(levels.size()), GL_SRGB8_ALPHA8, kGrassTexels,
                     kGrassTexels, kGrassLayers);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const int side = levels[k].side;
    glTextureSubImage3D(texture.id(), static_cast<GLint>(k), 0, 0, 0, side, side, kGrassLayers, GL_RGBA,
                        GL_UNSIGNED_BYTE, levels[k].rgba.data());
  }
  glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

std::vector<Vertex> interleave(const GrassGround& ground) {
  std::vector<Vertex> vertices(ground.positions.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i] = {ground.positions[i], ground.normals[i]};
  return vertices;
}

GrowthBlock growth_block(const GrassGrowth& growth, const GrassPlan& plan) {
  return {growth.height,
          growth.height_variation,
          growth.width,
          growth.texture_metres,
          static_cast<std::uint32_t>(growth.point),
          growth.turned ? 1U : 0U,
          static_cast<std::uint32_t>(plan.strands()),
          static_cast<std::uint32_t>(plan.growing()),
          static_cast<std::uint32_t>(growth.random),
          {}};
}

// One instanced draw call per run of triangles: instance k draws strand k + 1 of each.
std::vector<RunCommand> run_commands(const GrassPlan& plan) {
  std::vector<RunCommand> commands;
  for (const GrassPlan::Run& run : plan.runs) {
    commands.push_back({3 * run.triangles, run.strands, 3 * run.first, 0});
  }
  return commands;
}

Bounds bounds_of(const GrassGround& ground, const GrassPlan& plan) {
  Bounds box{glm::vec3(std::numeric_limits<float>::max()), glm::vec3(std::numeric_limits<float>::lowest())};
  for (std::size_t t = 0; t < plan.growing(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const glm::vec3& at = ground.positions[plan.triangles[t][corner]];
      box = {glm::min(box.low, at), glm::max(box.high, at)};
    }
  }
  return box;
}

// Whether a box that is larger by `margin` on all sides lies beyond one side of the view.
bool outside(const Bounds& box, float margin, const glm::mat4& world_to_clip) {
  const glm::mat4 rows = glm::transpose(world_to_clip);
  for (int axis = 0; axis < 2; ++axis) {
    for (const float sign : {-1.0F, 1.0F}) {
      const glm::vec4 plane = rows[3] + sign * rows[axis];
      const glm::vec3 normal(plane);
      const glm::vec3 inmost = glm::mix(box.low, box.high, glm::greaterThan(normal, glm::vec3(0)));
      if (glm::dot(normal, inmost) + plane.w < -margin * glm::length(normal)) return true;
    }
  }
  return false;
}

}  // namespace

struct GrassPatch::Gl {
  Gl(const GrassGround& ground, const GrassGrowth& growth) : plan(plan_grass(ground, growth)) {
    if (plan.strands() == 0) return;
    const std::vector<Vertex> all = interleave(ground);
    const GrowthBlock block = growth_block(growth, plan);
    vertices = make_buffer(std::span<const Vertex>(all));
    triangles = make_buffer(std::span<const glm::uvec4>(plan.triangles));
    growing = make_buffer(std::span<const GrowthBlock>(&block, 1));
    const std::vector<RunCommand> commands = run_commands(plan);
    runs = make_buffer(std::span<const RunCommand>(commands));
    ground_bytes = all.size() * sizeof(Vertex) + plan.triangles.size() * sizeof(glm::uvec4) + sizeof block +
                   commands.size() * sizeof(RunCommand);
    total = static_cast<std::uint32_t>(plan.strands());
    triangle_count = static_cast<std::uint32_t>(plan.growing());
    // With the products of the paper, strands stand anywhere.
    if (growth.point == PointReading::kSum) box = bounds_of(ground, plan);
    tallest = growth.height * (1 + growth.height_variation);
    widest = growth.width * (1 + growth.height_variation);
    plan.triangles = {};  // the GPU has them
    check_gl("uploading the grass");
  }

  bool may_show(const GrassLook& look) const {
    const float margin = tallest * (1 + glm::length(look.wind)) + widest;
    return total > 0 && !(box && outside(*box, margin, look.world_to_clip));
  }

  void bind() const {
    glBindBufferBase(GL_UNIFORM_BUFFER, kGrowthBlock, growing.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kVertices, vertices.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kTriangles, triangles.id());
  }

  // The buffer of strands, with room for all of them.
  static void reserve(std::optional<Buffer>& buffer, std::uint32_t strands) {
    if (buffer) return;
    buffer.emplace();
    glNamedBufferStorage(buffer->id(), static_cast<GLsizeiptr>(strands * sizeof(GrassStrand)), nullptr, 0);
    check_gl("memory for grass");
  }

  GrassPlan plan;
  Buffer vertices, triangles, growing, runs, command;
  std::optional<Buffer> grown, in_view;  // of kInstancing, of kIndirect
  std::size_t ground_bytes = 0;
  std::uint32_t total = 0, triangle_count = 0;
  std::optional<Bounds> box;      // of the ground that grows grass
  float tallest = 0, widest = 0;  // metres, of a billboard
  bool has_command = false;
};

GrassPatch::GrassPatch(const GrassGround& ground, const GrassGrowth& growth)
    : gl_(std::make_unique<Gl>(ground, growth)) {}
GrassPatch::~GrassPatch() = default;
GrassPatch::GrassPatch(GrassPatch&&) noexcept = default;
GrassPatch& GrassPatch::operator=(GrassPatch&&) noexcept = default;

std::int64_t GrassPatch::strands() const { return gl_->total; }
std::size_t GrassPatch::bytes() const {
  const std::size_t buffers = (gl_->grown ? 1 : 0) + (gl_->in_view ? 1 : 0);
  return gl_->ground_bytes + buffers * gl_->total * sizeof(GrassStrand) +
         (gl_->has_command ? sizeof(Command) : 0);
}

struct GrassRenderer::Gl {
  Gl() : corners(make_buffer(std::span<const std::uint16_t>(kCorners))) {
    glVertexArrayElementBuffer(instanced.id(), corners.id());
    check_gl("preparing the grass");
  }

  // Starts growing strands into a buffer: all of them, or those in view, counted in the patch's command. What
  // reads them waits for a barrier.
  void grow(GrassPatch::Gl& patch, const Buffer& into, bool in_view_only) {
    patch.bind();
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kStrands, into.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kCommand, patch.command.id());
    glProgramUniform1i(place.id(), uniform(place, "in_view_only"), in_view_only ? 1 : 0);
    glUseProgram(place.id());
    glDispatchCompute((patch.total + kGroup - 1) / kGroup, 1, 1);
  }
  static void barrier() {
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  }

  void grow_all(GrassPatch::Gl& patch) {
    if (patch.grown) return;
    ready_command(patch);
    GrassPatch::Gl::reserve(patch.grown, patch.total);
    grow(patch, *patch.grown, false);
  }
  void grow_in_view(GrassPatch::Gl& patch) {
    const Command fresh;
    ready_command(patch);
    glNamedBufferSubData(patch.command.id(), 0, sizeof fresh, &fresh);
    GrassPatch::Gl::reserve(patch.in_view, patch.total);
    grow(patch, *patch.in_view, true);
  }

  // The shader declares the command in any case, so it exists in any case.
  static void ready_command(GrassPatch::Gl& patch) {
    if (patch.has_command) return;
    glNamedBufferStorage(patch.command.id(), sizeof(Command), nullptr, GL_DYNAMIC_STORAGE_BIT);
    patch.has_command = true;
  }

  void draw_by_triangle(const GrassPatch::Gl&) const;
  void draw_by_strand(const GrassPatch::Gl&, bool indirect) const;
  void draw(std::span<GrassPatch::Gl* const>, GrassTechnique);

  Program by_triangle = link_program("grass_corner.vert", "grass.frag", "grass.geom"),
          by_strand = link_program("grass_instance.vert", "grass.frag"),
          place = link_compute(shader_file("grass_place.comp"));
  LookBlock look;
  Texture2dArray texture = make_texture();
  VertexArray none, instanced;
  Buffer corners;
};

void GrassRenderer::Gl::draw_by_triangle(const GrassPatch::Gl& patch) const {
  patch.bind();
  glUseProgram(by_triangle.id());
  glBindVertexArray(none.id());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, patch.runs.id());
  glMultiDrawArraysIndirect(GL_TRIANGLES, nullptr, static_cast<GLsizei>(patch.plan.runs.size()), 0);
}

void GrassRenderer::Gl::draw_by_strand(const GrassPatch::Gl& patch, bool indirect) const {
  patch.bind();
  const Buffer& strands = indirect ? *patch.in_view : *patch.grown;
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kStrands, strands.id());
  glUseProgram(by_strand.id());
  glBindVertexArray(instanced.id());
  if (indirect) {
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, patch.command.id());
    glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, nullptr);
  } else {
    glDrawElementsInstanced(GL_TRIANGLES, kCorners.size(), GL_UNSIGNED_SHORT, nullptr,
                            static_cast<GLsizei>(patch.total));
  }
}

// All patches grow before the first is drawn, so that the GPU waits once.
void GrassRenderer::Gl::draw(std::span<GrassPatch::Gl* const> patches, GrassTechnique technique) {
  if (technique == GrassTechnique::kGeometryShader) {
    for (const GrassPatch::Gl* const patch : patches) draw_by_triangle(*patch);
    return;
  }
  const bool indirect = technique == GrassTechnique::kIndirect;
  barrier();  // the last frame's draws have read the strands that are written now
  for (GrassPatch::Gl* const patch : patches) indirect ? grow_in_view(*patch) : grow_all(*patch);
  barrier();
  for (const GrassPatch::Gl* const patch : patches) draw_by_strand(*patch, indirect);
}

GrassRenderer::GrassRenderer() : gl_(std::make_unique<Gl>()) {}
GrassRenderer::~GrassRenderer() = default;

void GrassRenderer::draw(std::span<GrassPatch* const> patches, const GrassLook& look,
                         GrassTechnique technique) {
  std::vector<GrassPatch::Gl*> in_view;
  for (const GrassPatch* const patch : patches) {
    if (patch->gl_->may_show(look)) in_view.push_back(patch->gl_.get());
  }
  if (in_view.empty()) return;
  GLint samples = 0;
  glGetIntegerv(GL_SAMPLES, &samples);
  const bool culled = glIsEnabled(GL_CULL_FACE) == GL_TRUE;
  gl_->look.set(look);
  for (const Program* const program : {&gl_->by_triangle, &gl_->by_strand}) {
    glProgramUniform1i(program->id(), uniform(*program, "samples"), std::max(samples, 1));
  }
  glBindTextureUnit(0, gl_->texture.id());
  glDisable(GL_CULL_FACE);  // billboards have no back
  gl_->draw(in_view, technique);
  if (culled) glEnable(GL_CULL_FACE);
}

void GrassRenderer::draw(GrassPatch& patch, const GrassLook& look, GrassTechnique technique) {
  GrassPatch* const one = &patch;
  draw({&one, 1}, look, technique);
}

std::int64_t GrassRenderer::count_billboards(GrassPatch& patch, const GrassLook& look,
                                             GrassTechnique technique) {
  const PrimitiveQuery query;
  glBeginQuery(GL_PRIMITIVES_GENERATED, query.id());
  draw(patch, look, technique);
  glEndQuery(GL_PRIMITIVES_GENERATED);
  GLuint64 triangles = 0;
  glGetQueryObjectui64v(query.id(), GL_QUERY_RESULT, &triangles);
  check_gl("drawing grass");
  return static_cast<std::int64_t>(triangles / 2);
}

std::vector<GrassStrand> GrassRenderer::strands(GrassPatch& patch) {
  std::vector<GrassStrand> all(static_cast<std::size_t>(patch.strands()));
  if (all.empty()) return all;
  gl_->look.set({});
  gl_->grow_all(*patch.gl_);
  Gl::barrier();
  glGetNamedBufferSubData(patch.gl_->grown->id(), 0,
                          static_cast<GLsizeiptr>(all.size() * sizeof(GrassStrand)), all.data());
  check_gl("reading grass back");
  return all;
}

}  // namespace terrabench
