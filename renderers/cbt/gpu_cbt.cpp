#include "renderers/cbt/gpu_cbt.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "renderers/frame_style.h"
#include "renderers/gl.h"
#include "renderers/target.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

// Laid out as the blocks of shaders/cbt_tree.glsl, cbt_rule.glsl and cbt_sum.comp.
struct LatticeBlock {
  glm::ivec2 last, roots;
  glm::vec2 cell;
  std::int32_t side_log, depth;
};
static_assert(sizeof(LatticeBlock) == 32);

struct RuleBlock {
  glm::dvec4 eye_pixels, forward_focal, near_secant;
  std::array<glm::dvec4, 6> planes;
};
static_assert(sizeof(RuleBlock) == 288);

struct Commands {
  std::uint32_t draw[4], groups[3], unused;
};
constexpr GLintptr kGroups = 16;  // bytes before Commands::groups
constexpr int kDeepest = 30;      // the shaders count bits in 32 bits

template <class T>
Buffer storage_block(std::span<const T> content, std::string_view what) {
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  const auto bytes = static_cast<GLint64>(content.size_bytes());
  if (bytes > most) {
    throw environment_error(fmt::format("{} take {} MiB, but a storage block holds at most {} MiB", what,
                                        bytes >> 20, most >> 20),
                            "", "take a smaller terrain");
  }
  Buffer buffer;
  glNamedBufferStorage(buffer.id(), bytes, content.data(), 0);
  return buffer;
}

Buffer lattice_of(const SplitGround& ground) {
  const GroundGrid& grid = ground.grid;
  const LatticeBlock block{{grid.width - 1, grid.depth - 1},
                           ground.roots,
                           {grid.cell_x, grid.cell_z},
                           ground.side_log,
                           ground.depth};
  return make_buffer(std::span(&block, 1));
}

}  // namespace

struct GpuCbt::Gl {
  explicit Gl(const SplitGround& ground)
      : tree(storage_block(ground.tree, "the bits of cbt")),
        heights(storage_block(ground.grid.heights, "heights")),
        errors(storage_block(std::span(ground.errors), "errors of cbt")),
        radii(storage_block(std::span(ground.radii), "radii of cbt")),
        lattice(lattice_of(ground)),
        tree_bytes(ground.tree.size_bytes()) {
    glNamedBufferStorage(rule.id(), sizeof(RuleBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
    glNamedBufferStorage(commands.id(), sizeof(Commands), nullptr, 0);
    check_gl("reserving memory for the tree");
  }

  Program merge = link_compute(shader_file("cbt_merge.comp")),
          split = link_compute(shader_file("cbt_split.comp")),
          sum = link_compute(shader_file("cbt_sum.comp")),
          leaves = link_program("cbt.vert", "relief.frag", "wire.geom");
  GLint level = uniform(sum, "level");
  Texture1d ramp = make_ramp_texture();
  VertexArray none;
  Buffer tree, heights, errors, radii, lattice, rule, commands;
  std::size_t tree_bytes;
};

GpuCbt::GpuCbt(GlContext& context, const SplitGround& ground) : context_(context), depth_(ground.depth) {
  if (depth_ > kDeepest) {
    throw environment_error(fmt::format("the tree has {} levels; the shaders take {}", depth_, kDeepest), "",
                            "take a smaller terrain");
  }
  context_.make_current();
  gl_ = std::make_unique<Gl>(ground);
  bind();
  sum_up();
}

GpuCbt::~GpuCbt() { context_.make_current_to_delete(); }

void GpuCbt::bind() const {
  const GLuint blocks[] = {gl_->tree.id(), gl_->heights.id(), gl_->errors.id(), gl_->radii.id(),
                           gl_->commands.id()};
  glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizei>(std::size(blocks)), blocks);
  const GLuint uniforms[] = {gl_->lattice.id(), gl_->rule.id()};
  glBindBuffersBase(GL_UNIFORM_BUFFER, 0, static_cast<GLsizei>(std::size(uniforms)), uniforms);
}

void GpuCbt::sum_up() {
  constexpr int kTop = 4, kPerGroup = 32 * 64;  // level summed with all above it; nodes
  glUseProgram(gl_->sum.id());
  for (int level = depth_ - 1; level > kTop; --level) {
    glUniform1i(gl_->level, level);
    glDispatchCompute(std::clamp((1U << level) / kPerGroup, 1U, 65535U), 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
  glUniform1i(gl_->level, std::min(kTop, depth_ - 1));
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  glUseProgram(0);
}

void GpuCbt::update(const SplitRule& by) {
  context_.make_current();
  const BoundTerms& bound = by.bound;
  const RuleBlock rule{
      {bound.eye, bound.pixels}, {bound.forward, bound.focal}, {bound.near, bound.secant, 0, 0}, by.planes};
  glNamedBufferSubData(gl_->rule.id(), 0, sizeof rule, &rule);
  bind();
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, gl_->commands.id());
  for (const Program* const pass : {&gl_->merge, &gl_->split}) {
    glUseProgram(pass->id());
    glDispatchComputeIndirect(kGroups);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
  sum_up();
}

void GpuCbt::draw(const View& view, const FrameStyle& style) {
  context_.make_current();
  context_.target().begin(view.width, view.height, style.background);
  bind();
  glBindTextureUnit(0, gl_->ramp.id());
  set_matrix(gl_->leaves, world_to_clip(view));
  set_style(gl_->leaves, view, style);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glEnable(GL_CULL_FACE);
  glUseProgram(gl_->leaves.id());
  glBindVertexArray(gl_->none.id());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, gl_->commands.id());
  glDrawArraysIndirect(GL_TRIANGLES, nullptr);
  glUseProgram(0);
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_TEST);
}

std::vector<std::uint64_t> GpuCbt::tree() const {
  context_.make_current();
  std::vector<std::uint64_t> words(gl_->tree_bytes / sizeof(std::uint64_t));
  glGetNamedBufferSubData(gl_->tree.id(), 0, static_cast<GLsizeiptr>(gl_->tree_bytes), words.data());
  check_gl("reading the tree");
  return words;
}

std::size_t GpuCbt::tree_bytes() const { return gl_->tree_bytes; }

}  // namespace terrabench
