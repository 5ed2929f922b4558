#include "renderers/frame_renderer.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <optional>
#include <utility>

#include "renderers/frame_buffers.h"
#include "renderers/frame_style.h"
#include "renderers/gl.h"
#include "renderers/ramp.h"
#include "renderers/target.h"

namespace terrabench {
namespace {

constexpr GLuint kPaintUnit = 2;  // in shaders/relief.glsl

// During its life, triangles seen from below are culled. They would be visible only at ridges, where rounding
// can let the slope behind win a depth test.
struct CullUndersides {
  CullUndersides() { glEnable(GL_CULL_FACE); }
  ~CullUndersides() { glDisable(GL_CULL_FACE); }
};

// The programs for a frame's heights, patches and meshes that give the same fragments. Those for patches and
// for meshes are linked when a frame first has some.
class Programs {
 public:
  explicit Programs(std::string_view fragment, std::string_view geometry = "")
      : fragment_(fragment), geometry_(geometry), heights_(link("frame.vert")) {}

  const Program& heights() const { return heights_; }
  const Program& patches() {
    if (!patches_) patches_.emplace(link_patches("frame_patch.tese", fragment_, geometry_));
    return *patches_;
  }
  const Program& meshes() {
    if (!meshes_) meshes_.emplace(link("frame_mesh.vert"));
    return *meshes_;
  }

 private:
  Program link(std::string_view vertex) const { return link_program(vertex, fragment_, geometry_); }

  std::string_view fragment_, geometry_;
  Program heights_;
  std::optional<Program> patches_, meshes_;
};

// Colours other than those of heights; `ground` is painted over `paint_extent` metres.
struct Colours {
  glm::vec2 cell;  // metres
  glm::ivec2 paint_size;
  glm::vec2 paint_extent;
};

void set_colours(const Program& program, GroundColours chosen, const Colours& colours) {
  if (chosen == GroundColours::kPaint) {
    // Samples lie at the middles of texels.
    const glm::vec2 size(colours.paint_size), scale = (size - 1.0F) / size / colours.paint_extent,
                                              offset = 0.5F / size;
    glProgramUniform2fv(program.id(), uniform(program, "paint_scale"), 1, glm::value_ptr(scale));
    glProgramUniform2fv(program.id(), uniform(program, "paint_offset"), 1, glm::value_ptr(offset));
  }
  const bool by_size = chosen == GroundColours::kTriangleSize;
  glProgramUniform1i(program.id(), uniform(program, "painted"), by_size ? 1 : 0);
  glProgramUniform2fv(program.id(), uniform(program, "size_cell"), 1,
                      glm::value_ptr(by_size ? colours.cell : glm::vec2(0)));
  if (!by_size) return;
  std::vector<glm::vec3> palette;
  for (const Rgb& colour : triangle_size_colours()) palette.push_back(as_shares(colour));
  glProgramUniform3fv(program.id(), uniform(program, "size_colours"), static_cast<GLsizei>(palette.size()),
                      glm::value_ptr(palette.front()));
}

// Draws what was uploaded; `prepare` sets each program's uniforms.
template <class Prepare>
void draw_all(FrameBuffers& buffers, Programs& programs, GLenum nearer, const Prepare& prepare) {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(nearer);
  if (buffers.has_heights()) {
    prepare(programs.heights());
    glUseProgram(programs.heights().id());
    buffers.draw_heights();
  }
  if (buffers.has_patches()) {
    prepare(programs.patches());
    glUseProgram(programs.patches().id());
    buffers.draw_patches();
  }
  if (buffers.has_meshes()) {
    prepare(programs.meshes());
    glUseProgram(programs.meshes().id());
    buffers.draw_meshes();
  }
  glUseProgram(0);
  glDisable(GL_DEPTH_TEST);
}

}  // namespace

std::span<const Rgb> triangle_size_colours() {
  static constexpr Rgb kColours[] = {{215, 48, 39},   {244, 135, 68}, {253, 205, 112}, {235, 240, 160},
                                     {145, 207, 120}, {50, 150, 110}, {69, 117, 180},  {90, 60, 140}};
  return kColours;
}

struct FrameRenderer::Gl {
  Programs plain{"frame_relief.frag"}, wired{"relief.frag", "wire.geom"}, numbers{"triangle_number.frag"};
  Texture1d ramp = make_ramp_texture();
  std::optional<Programs> painted;  // linked when there is paint
  Texture2d paint;
  Colours colours{};
  FrameBuffers buffers;
  VisibleQuery ground;
};

FrameRenderer::FrameRenderer(GlContext& context) : context_(context) {
  context_.make_current();
  gl_ = std::make_unique<Gl>();
}

FrameRenderer::~FrameRenderer() { context_.make_current_to_delete(); }

void FrameRenderer::draw(const Frame& frame, const View& view, const FrameStyle& style) {
  upload(frame);
  draw_uploaded(view, style);
}

void FrameRenderer::upload(const Frame& frame) {
  context_.make_current();
  gl_->buffers.upload(frame);
  gl_->colours.cell = {frame.cell_x, frame.cell_z};
}

void FrameRenderer::paint(const Image& colours, const glm::vec2& extent) {
  context_.make_current();
  if (!gl_->painted) gl_->painted.emplace("frame_painted.frag", "wire.geom");
  gl_->paint = Texture2d();
  glTextureStorage2D(gl_->paint.id(), 1, GL_RGB8, colours.width, colours.height);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(gl_->paint.id(), 0, 0, 0, colours.width, colours.height, GL_RGB, GL_UNSIGNED_BYTE,
                      colours.rgb.data());
  glTextureParameteri(gl_->paint.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(gl_->paint.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(gl_->paint.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  check_gl("painting the ground");
  gl_->colours.paint_size = {colours.width, colours.height};
  gl_->colours.paint_extent = extent;
}

void FrameRenderer::draw_uploaded(const View& view, const FrameStyle& style) {
  context_.make_current();
  context_.target().begin(view.width, view.height, style.background);
  const CullUndersides culling;
  glBindTextureUnit(0, gl_->ramp.id());
  // Triangles are known to the geometry shader alone.
  const bool triangles = style.wire_width > 0 || style.colours == GroundColours::kTriangleSize;
  Programs* programs = triangles ? &gl_->wired : &gl_->plain;
  GroundColours colours = style.colours;
  if (colours == GroundColours::kPaint && gl_->colours.paint_size.x == 0) colours = GroundColours::kHeight;
  if (colours == GroundColours::kPaint) {
    glBindTextureUnit(kPaintUnit, gl_->paint.id());
    programs = &*gl_->painted;
  }
  gl_->ground.begin();
  draw_all(gl_->buffers, *programs, GL_LEQUAL, [&](const Program& program) {
    set_matrix(program, world_to_clip(view));
    set_style(program, view, style);
    set_colours(program, colours, gl_->colours);
  });
  gl_->ground.end();
}

bool FrameRenderer::shows_ground() {
  context_.make_current();
  return gl_->ground.any();
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
  constexpr GLuint kNone[4] = {};  // all four components are read, of whatever format
  // Depth is near ÷ distance, whose relative precision in floats is the same at any distance: a metre behind
  // a ridge ten kilometres away is hidden. There is no far plane.
  glm::mat4 clip = world_to_clip(view);
  for (int column = 0; column < 4; ++column) clip[column][2] = column == 3 ? view.near : 0;
  const GLfloat far = 0;
  glClearNamedFramebufferuiv(framebuffer.id(), GL_COLOR, 0, kNone);
  glClearNamedFramebufferfv(framebuffer.id(), GL_DEPTH, 0, &far);
  gl_->buffers.upload(untessellated(frame));  // a tessellator may give triangles in any order
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  draw_all(gl_->buffers, gl_->numbers, GL_GEQUAL, [&](const Program& program) { set_matrix(program, clip); });
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

std::size_t FrameRenderer::bytes_uploaded() const { return gl_->buffers.bytes_uploaded(); }
std::size_t FrameRenderer::bytes_resent() const { return gl_->buffers.bytes_resent(); }

}  // namespace terrabench
