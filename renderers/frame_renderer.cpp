#include "renderers/frame_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <utility>

#include "renderers/gl.h"
#include "renderers/target.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

// Laid out as in shaders/frame.vert.
struct BatchRecord {
  std::int32_t level;
  std::uint32_t first_triangle;
  std::uint32_t corner;
  std::uint32_t morph;
};
struct LevelRecord {
  glm::ivec2 corner;
  glm::vec2 eye;
  float from, to;
  std::int32_t spacing, unused;
};
struct DrawCommand {
  std::uint32_t count, instances, first_index;
  std::int32_t base_vertex;
  std::uint32_t base_instance;
};
static_assert(sizeof(BatchRecord) + sizeof(DrawCommand) == kBytesPerBatch);
static_assert(sizeof(LevelRecord) == kBytesPerClipLevel);
static_assert(sizeof(PatchMorph) == 5 * sizeof(float));

// A buffer that is written in parts and grows to (1 + slack) times the needed size. On growth the GPU copies
// the contents, so that nothing is sent twice.
class GrowingBuffer {
 public:
  explicit GrowingBuffer(double slack = 0.5) : slack_(slack) {}
  GLuint id() const { return buffer_.id(); }
  std::size_t written() const { return written_; }  // bytes in total
  void reserve(std::size_t bytes) {
    if (bytes <= capacity_) return;
    const std::size_t capacity = bytes + static_cast<std::size_t>(static_cast<double>(bytes) * slack_);
    Buffer larger;
    glNamedBufferStorage(larger.id(), static_cast<GLsizeiptr>(capacity), nullptr, GL_DYNAMIC_STORAGE_BIT);
    check_gl("reserving memory for the terrain");
    if (capacity_ > 0) {
      glCopyNamedBufferSubData(buffer_.id(), larger.id(), 0, 0, static_cast<GLsizeiptr>(capacity_));
    }
    buffer_ = std::move(larger);
    capacity_ = capacity;
  }
  void write(std::size_t at, const void* data, std::size_t bytes) {
    if (bytes == 0) return;
    glNamedBufferSubData(buffer_.id(), static_cast<GLintptr>(at), static_cast<GLsizeiptr>(bytes), data);
    written_ += bytes;
  }
  template <class T>
  void replace(const std::vector<T>& content) {
    reserve(content.size() * sizeof(T));
    write(0, content.data(), content.size() * sizeof(T));
  }

 private:
  Buffer buffer_;
  double slack_;
  std::size_t capacity_ = 0, written_ = 0;
};

void check_room(std::size_t bytes) {
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  if (bytes > static_cast<std::size_t>(most)) {
    throw environment_error(
        fmt::format("heights need {} MiB, but this OpenGL's storage blocks hold at most {} MiB", bytes >> 20,
                    most >> 20),
        "", "draw a smaller terrain, or use a method that stores only a part of it (clipmap)");
  }
}

// During its life, triangles seen from below are culled. They would be visible only at ridges, where rounding
// can let the slope behind win a depth test.
struct CullUndersides {
  CullUndersides() { glEnable(GL_CULL_FACE); }
  ~CullUndersides() { glDisable(GL_CULL_FACE); }
};

glm::vec3 as_shares(const Rgb& color) { return glm::vec3(color[0], color[1], color[2]) / 255.0F; }

}  // namespace

struct FrameRenderer::Gl {
  Program plain = link_program(shader_file("frame.vert"), shader_file("relief.frag"));
  Program wired =
      link_program(shader_file("frame.vert"), shader_file("relief.frag"), &shader_file("wire.geom"));
  Program numbers = link_program(shader_file("frame.vert"), shader_file("triangle_number.frag"));
  Texture1d ramp = make_ramp_texture();
  VertexArray array;
  GrowingBuffer indices, batches, levels, commands, morphs;
  GrowingBuffer heights{0};  // grows only when a clipmap adds levels
  bool fresh = true;
  std::vector<BatchRecord> batch_records;
  std::vector<LevelRecord> level_records;
  std::vector<DrawCommand> draw_commands;

  Gl();
  void upload(const Frame&);
  void upload_all(const Frame&);
  void upload(const Frame&, const DirtyRange&);
  void describe(const Frame&);
  void set(const Program&, const Frame&, const View&);
  void set_style(const Program&, const View&, const FrameStyle&);
  void draw(const Program&, GLenum nearer);
};

FrameRenderer::Gl::Gl() {
  // The batch's number reaches the vertices as a per-instance attribute, read from base_instance of the
  // command.
  glVertexArrayAttribIFormat(array.id(), 0, 1, GL_UNSIGNED_INT, 0);
  glVertexArrayAttribBinding(array.id(), 0, 0);
  glVertexArrayBindingDivisor(array.id(), 0, 1);
  glEnableVertexArrayAttrib(array.id(), 0);
  // Bound in every frame, even without clip levels or morphs, so it must not be empty.
  levels.reserve(sizeof(LevelRecord));
  morphs.reserve(sizeof(PatchMorph));
}

void FrameRenderer::Gl::upload_all(const Frame& frame) {
  indices.write(0, frame.indices.data(), frame.indices.size_bytes());
  heights.write(0, frame.grid.heights.data(), frame.grid.heights.size_bytes());
  morphs.write(0, frame.morphs.data(), frame.morphs.size_bytes());
  std::size_t at = 0;
  for (const ClipLevel& level : frame.clip_levels) {
    heights.write(at, level.heights.data(), level.heights.size_bytes());
    at += level.heights.size_bytes();
  }
}

void FrameRenderer::Gl::upload(const Frame& frame, const DirtyRange& range) {
  constexpr std::size_t kWord = 4;
  switch (range.target) {
    case DirtyRange::Target::kIndices:
      indices.write(range.first * kWord, &frame.indices[range.first], range.count * kWord);
      break;
    case DirtyRange::Target::kHeights:
      heights.write(range.first * kWord, &frame.grid.heights[range.first], range.count * kWord);
      break;
    case DirtyRange::Target::kMorphs:
      morphs.write(range.first * sizeof(PatchMorph), &frame.morphs[range.first], range.bytes());
      break;
    case DirtyRange::Target::kMesh:
      break;  // meshes are uploaded by id
    case DirtyRange::Target::kClipLevel:
      const ClipLevel& level = frame.clip_levels[range.level];
      for (std::size_t row = range.z; row < std::size_t{range.z} + range.depth; ++row) {
        const std::size_t at = row * level.side + range.x;
        const std::size_t before = std::size_t{range.level} * level.heights.size();
        heights.write((before + at) * kWord, &level.heights[at], range.width * kWord);
      }
  }
}

void FrameRenderer::Gl::upload(const Frame& frame) {
  std::size_t height_bytes = frame.grid.heights.size_bytes();
  for (const ClipLevel& level : frame.clip_levels) height_bytes += level.heights.size_bytes();
  check_room(height_bytes);
  indices.reserve(frame.indices.size_bytes());
  heights.reserve(height_bytes);
  morphs.reserve(frame.morphs.size_bytes());
  if (std::exchange(fresh, false)) {
    upload_all(frame);
  } else {
    for (const DirtyRange& range : frame.uploads) upload(frame, range);
  }
}

void FrameRenderer::Gl::describe(const Frame& frame) {
  batch_records.clear();
  draw_commands.clear();
  std::uint32_t triangle = 0;
  for (const Batch& batch : frame.batches) {
    const auto number = static_cast<std::uint32_t>(draw_commands.size());
    batch_records.push_back({batch.level, triangle, batch.base_vertex, batch.morph});
    draw_commands.push_back(
        {batch.index_count, 1, batch.first_index, static_cast<std::int32_t>(batch.base_vertex), number});
    triangle += batch.index_count / 3;
  }
  level_records.clear();
  for (const ClipLevel& level : frame.clip_levels) {
    level_records.push_back({level.corner, level.eye, level.from, level.to, level.spacing, 0});
  }
  batches.replace(batch_records);
  levels.replace(level_records);
  commands.replace(draw_commands);
}

void FrameRenderer::Gl::set(const Program& program, const Frame& frame, const View& view) {
  const GLuint id = program.id();
  const glm::mat4 to_clip = world_to_clip(view);
  glProgramUniformMatrix4fv(id, uniform(program, "world_to_clip"), 1, GL_FALSE, glm::value_ptr(to_clip));
  glProgramUniform2i(id, uniform(program, "samples"), frame.grid.width, frame.grid.depth);
  glProgramUniform2f(id, uniform(program, "cell"), frame.cell_x, frame.cell_z);
  glProgramUniform1i(id, uniform(program, "side"),
                     frame.clip_levels.empty() ? 0 : frame.clip_levels.front().side);
  glProgramUniform2i(id, uniform(program, "first"), frame.first.x, frame.first.y);
  glProgramUniform2i(id, uniform(program, "last"), frame.last.x, frame.last.y);
  glProgramUniform2i(id, uniform(program, "origin"), frame.origin.x, frame.origin.y);
  glProgramUniform1i(id, uniform(program, "patch_side"), frame.patch_side);
}

void FrameRenderer::Gl::set_style(const Program& program, const View& view, const FrameStyle& style) {
  const GLuint id = program.id();
  const auto set3 = [&](const char* name, const glm::vec3& value) {
    glProgramUniform3fv(id, uniform(program, name), 1, glm::value_ptr(value));
  };
  set3("sun", glm::normalize(style.sun));
  set3("eye", view.eye);
  set3("fill_color", glm::vec3(1));
  glProgramUniform2f(
      id, uniform(program, "height_range"), style.lowest,
      std::max(style.highest, std::nextafter(style.lowest, std::numeric_limits<float>::max())));
  glProgramUniform1i(id, uniform(program, "ramp"), 0);
  glProgramUniform1f(id, uniform(program, "exaggeration"), style.shading_exaggeration);
  glProgramUniform1i(id, uniform(program, "facets"), 1);
  glProgramUniform1i(id, uniform(program, "painted"), 0);
  glProgramUniform1i(id, uniform(program, "flat_fill"), 0);
  glProgramUniform1f(id, uniform(program, "wire_width"), style.wire_width);
  glProgramUniform4f(id, uniform(program, "wire_ink"), 0.05F, 0.05F, 0.06F, style.wire_opacity);
  if (style.wire_width > 0) {
    glProgramUniform2f(id, uniform(program, "pixels"), static_cast<float>(view.width),
                       static_cast<float>(view.height));
    glProgramUniform1i(id, uniform(program, "all_edges"), 1);
    glProgramUniform1i(id, uniform(program, "drawn"), 1);
  }
  glBindTextureUnit(0, ramp.id());
}

void FrameRenderer::Gl::draw(const Program& program, GLenum nearer) {
  if (draw_commands.empty()) return;
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(nearer);
  glUseProgram(program.id());
  glVertexArrayElementBuffer(array.id(), indices.id());
  glVertexArrayVertexBuffer(array.id(), 0, commands.id(), offsetof(DrawCommand, base_instance),
                            sizeof(DrawCommand));
  glBindVertexArray(array.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, heights.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, batches.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, levels.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, morphs.id());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.id());
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr,
                              static_cast<GLsizei>(draw_commands.size()), 0);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
  glBindVertexArray(0);
  glUseProgram(0);
  glDisable(GL_DEPTH_TEST);
  check_gl("drawing the terrain");
}

FrameRenderer::FrameRenderer(GlContext& context) : context_(context) {
  context_.make_current();
  gl_ = std::make_unique<Gl>();
}

FrameRenderer::~FrameRenderer() { context_.make_current(); }

void FrameRenderer::draw(const Frame& frame, const View& view, const FrameStyle& style) {
  context_.make_current();
  RenderTarget& target = context_.target();
  target.resize(view.width, view.height);
  target.bind();
  const glm::vec3 background = as_shares(style.background);
  glClearColor(background.r, background.g, background.b, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  const CullUndersides culling;
  gl_->upload(frame);
  gl_->describe(frame);
  const Program& program = style.wire_width > 0 ? gl_->wired : gl_->plain;
  gl_->set(program, frame, view);
  gl_->set_style(program, view, style);
  gl_->draw(program, GL_LEQUAL);
}

void FrameRenderer::finish() {
  context_.make_current();
  glFinish();
}

Image FrameRenderer::image() {
  context_.make_current();
  return context_.target().read();
}

std::vector<std::uint32_t> FrameRenderer::triangle_numbers(const Frame& frame, const View& view) {
  context_.make_current();
  const Renderbuffer color, depth;
  const Framebuffer framebuffer;
  glNamedRenderbufferStorage(color.id(), GL_R32UI, view.width, view.height);
  glNamedRenderbufferStorage(depth.id(), GL_DEPTH_COMPONENT32F, view.width, view.height);
  glNamedFramebufferRenderbuffer(framebuffer.id(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color.id());
  glNamedFramebufferRenderbuffer(framebuffer.id(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth.id());
  check_gl("making a picture of triangle numbers");
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  glViewport(0, 0, view.width, view.height);
  const GLuint none = 0;
  // Depth is near ÷ distance, whose relative precision in floats is the same at any distance: a metre behind
  // a ridge ten kilometres away is hidden. There is no far plane.
  glm::mat4 clip = world_to_clip(view);
  for (int column = 0; column < 4; ++column) clip[column][2] = column == 3 ? view.near : 0;
  const GLfloat far = 0;
  glClearNamedFramebufferuiv(framebuffer.id(), GL_COLOR, 0, &none);
  glClearNamedFramebufferfv(framebuffer.id(), GL_DEPTH, 0, &far);
  gl_->upload(frame);
  gl_->describe(frame);
  gl_->set(gl_->numbers, frame, view);
  glProgramUniformMatrix4fv(gl_->numbers.id(), uniform(gl_->numbers, "world_to_clip"), 1, GL_FALSE,
                            &clip[0][0]);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl_->draw(gl_->numbers, GL_GEQUAL);
  glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);

  std::vector<std::uint32_t> numbers(static_cast<std::size_t>(view.width) * view.height);
  glReadPixels(0, 0, view.width, view.height, GL_RED_INTEGER, GL_UNSIGNED_INT, numbers.data());
  check_gl("reading triangle numbers");
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  // OpenGL's rows are ordered from the bottom up.
  for (int top = 0, bottom = view.height - 1; top < bottom; ++top, --bottom) {
    std::swap_ranges(numbers.begin() + static_cast<std::ptrdiff_t>(top) * view.width,
                     numbers.begin() + static_cast<std::ptrdiff_t>(top + 1) * view.width,
                     numbers.begin() + static_cast<std::ptrdiff_t>(bottom) * view.width);
  }
  return numbers;
}

std::size_t FrameRenderer::bytes_uploaded() const {
  std::size_t bytes = 0;
  for (const GrowingBuffer* buffer :
       {&gl_->indices, &gl_->heights, &gl_->morphs, &gl_->batches, &gl_->levels, &gl_->commands}) {
    bytes += buffer->written();
  }
  return bytes;
}

}  // namespace terrabench
