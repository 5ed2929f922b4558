#include "renderers/landscape/landscape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "renderers/landscape/landscape_gl.h"
#include "renderers/target.h"

namespace terrabench {
namespace {

// OpenGL's state while a landscape is drawn; restored at the end.
struct LandscapeState {
  LandscapeState() {
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_CULL_FACE);
    glEnable(GL_DEPTH_TEST);
  }
  ~LandscapeState() {
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CLIP_DISTANCE0);
    glDepthFunc(GL_LESS);
    glFrontFace(GL_CCW);
    glClearDepth(1);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glBindVertexArray(0);
    glUseProgram(0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
  }
  LandscapeState(const LandscapeState&) = delete;
  LandscapeState& operator=(const LandscapeState&) = delete;
};

// z from 1 at the near plane to 0 at the far plane.
glm::mat4 reversed_depth(const View& view) {
  glm::mat4 clip = world_to_clip(view);
  for (int column = 0; column < 4; ++column) clip[column][2] = 0.5F * (clip[column][3] - clip[column][2]);
  return clip;
}

glm::mat4 mirrored_at(float level) {
  return glm::scale(glm::translate(glm::mat4(1), {0, 2 * level, 0}), {1, -1, 1});
}

// The parts of the scene that shadow maps cover: boxes along the sun's direction around spheres ahead of the
// eye, each larger than the one before.
struct Cascade {
  glm::mat4 world_to_clip{1};  // z in 0…1, 0 nearest the sun
  float texel = 0;             // metres
};

// `reach`: how far from the eye shadows are drawn, metres; `side`: texels along a map's side. The boxes hold
// all ground within `ground` that can cast a shadow into them. Moves by whole texels with the eye, so that
// shadows do not flicker.
std::array<Cascade, kCascades> shadow_cascades(const View& view, glm::vec3 sun, const Bounds& ground,
                                               float reach, int side) {
  constexpr std::array<float, kCascades> kShares{0.05F, 0.22F, 1};
  std::array<Cascade, kCascades> cascades;
  const glm::vec3 forward = glm::normalize(view.target - view.eye);
  const glm::vec3 up = std::abs(sun.y) > 0.99F ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
  const glm::mat4 to_sun = glm::lookAt(glm::vec3(0), -sun, up);
  // Along the sun's direction: from behind everything to before everything.
  float nearest = -1e30F, farthest = 1e30F;
  for (int corner = 0; corner < 8; ++corner) {
    const float depth = (to_sun * glm::vec4(ground.corner(corner), 1)).z;
    nearest = std::max(nearest, depth);
    farthest = std::min(farthest, depth);
  }
  for (std::size_t k = 0; k < cascades.size(); ++k) {
    const float radius = 0.5F * reach * kShares[k];
    const glm::vec3 middle = view.eye + forward * radius * 0.9F;
    const float texel = 2 * radius / static_cast<float>(side);
    glm::vec3 at = to_sun * glm::vec4(middle, 1);
    at.x = std::floor(at.x / texel) * texel;
    at.y = std::floor(at.y / texel) * texel;
    const float margin = 0.01F * (nearest - farthest) + 1;
    cascades[k] = {glm::orthoRH_ZO(at.x - radius, at.x + radius, at.y - radius, at.y + radius,
                                   -nearest - margin, -farthest + margin) *
                       to_sun,
                   texel};
  }
  return cascades;
}

// What the passes of one picture share.
class Drawing {
 public:
  Drawing(LandscapeGl&, const LandscapeStyle&, const LandscapeRenderer&, const View&, double seconds);
  void draw(const RenderTarget&);

 private:
  void begin(PassView&);
  void shadows();
  void depth();
  void water_pass(Pass);
  void picture(const RenderTarget&);
  void ground(const PassView&);

  LandscapeGl& gl_;
  const LandscapeStyle& style_;
  const LandscapeRenderer& owner_;
  const View& view_;
  glm::mat4 to_clip_;
  float side_;  // of the water that the eye is on: 1 above, -1 below, 0 without water
  SceneBlock block_;
  double seconds_;
};

Drawing::Drawing(LandscapeGl& gl, const LandscapeStyle& style, const LandscapeRenderer& owner,
                 const View& view, double seconds)
    : gl_(gl),
      style_(style),
      owner_(owner),
      view_(view),
      to_clip_(reversed_depth(view)),
      side_(!style.has_water                  ? 0.0F
            : view.eye.y >= style.water_level ? 1.0F
                                              : -1.0F),
      block_(describe(style, seconds)),
      seconds_(seconds) {
  block_.pixels = glm::vec4(view.width, view.height, 0, 0);
  block_.water.y = side_;
}

void Drawing::draw(const RenderTarget& target) {
  if (style_.shadows) shadows();
  if (style_.occlusion > 0) depth();
  if (style_.has_water) {
    water_pass(Pass::kReflection);
    water_pass(Pass::kRefraction);
  }
  picture(target);
}

// Hands the pass to its user and writes the uniform block for it.
void Drawing::begin(PassView& pass) {
  pass.seconds = seconds_;
  if (owner_.adjust) owner_.adjust(pass);
  block_.world_to_clip = pass.world_to_clip;
  block_.clip_to_world = glm::mat4(glm::inverse(glm::dmat4(pass.world_to_clip)));
  block_.clip_plane = pass.clip_plane;
  block_.eye = glm::vec4(pass.eye, static_cast<float>(seconds_));
  const bool in_water = side_ < 0 && pass.pass != Pass::kRefraction;
  block_.water.z = in_water ? 1 : 0;
  gl_.write(block_);
}

void Drawing::ground(const PassView& pass) {
  gl_.draw_ground(pass.pass);
  if (!owner_.also) return;
  owner_.also(pass);
  gl_.bind();
}

void Drawing::shadows() {
  constexpr int kSide = LandscapeGl::kShadowSide;
  const float reach = std::min(view_.far, 1.5F * style_.fog_distance);
  const auto cascades = shadow_cascades(view_, style_.sun, style_.ground, reach, kSide);
  glDepthFunc(GL_LESS);
  glClearDepth(1);
  glDisable(GL_CULL_FACE);  // ground seen from below shades, too
  glBindFramebuffer(GL_FRAMEBUFFER, gl_.shadow_framebuffer.id());
  const glm::mat4 to_texture = glm::scale(glm::translate(glm::mat4(1), {0.5F, 0.5F, 0}), {0.5F, 0.5F, 1});
  for (int k = 0; k < kCascades; ++k) {
    glNamedFramebufferTextureLayer(gl_.shadow_framebuffer.id(), GL_DEPTH_ATTACHMENT, gl_.shadows->id(), 0, k);
    glViewport(0, 0, kSide, kSide);
    glClear(GL_DEPTH_BUFFER_BIT);
    PassView pass{Pass::kShadow, cascades[k].world_to_clip, glm::vec4(0), view_.eye, kSide, kSide};
    begin(pass);
    ground(pass);
    block_.to_shadow[k] = to_texture * cascades[k].world_to_clip;
    block_.shadow_texel[k] = cascades[k].texel;
  }
  block_.shadow_texel.w = 1;
  glEnable(GL_CULL_FACE);
}

void Drawing::depth() {
  glDepthFunc(GL_GREATER);
  glClearDepth(0);
  gl_.depths->bind();
  glClear(GL_DEPTH_BUFFER_BIT);
  PassView pass{Pass::kDepth, to_clip_, glm::vec4(0), view_.eye, view_.width, view_.height};
  begin(pass);
  ground(pass);
  gl_.draw_occlusion(view_, style_);
}

// The scene on the eye's side of the water, mirrored, or that on the other side. A little of the ground
// beyond the water's level is kept, so that waves at the shore find some.
void Drawing::water_pass(Pass which) {
  const bool reflects = which == Pass::kReflection;
  const float kept = reflects ? side_ : -side_;
  const float margin = (reflects ? 0.01F : 0.05F) * style_.wave_width;
  const glm::mat4 mirror = reflects ? mirrored_at(style_.water_level) : glm::mat4(1);
  PassView pass{which,
                to_clip_ * mirror,
                {0, kept, 0, -kept * style_.water_level + margin},
                glm::vec3(mirror * glm::vec4(view_.eye, 1)),
                view_.width,
                view_.height};
  glDepthFunc(GL_GREATER);
  glClearDepth(0);
  (reflects ? gl_.reflection : gl_.refraction)->bind();
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  begin(pass);
  glFrontFace(reflects ? GL_CW : GL_CCW);
  gl_.draw_sky(false);
  glEnable(GL_CLIP_DISTANCE0);
  ground(pass);
  glDisable(GL_CLIP_DISTANCE0);
  glFrontFace(GL_CCW);
}

void Drawing::picture(const RenderTarget& target) {
  glDepthFunc(GL_GREATER);
  glClearDepth(0);
  target.bind();
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  PassView pass{Pass::kPicture, to_clip_, glm::vec4(0), view_.eye, view_.width, view_.height};
  begin(pass);
  gl_.draw_sky(true);
  gl_.ground.begin();
  // Depth first, so that each pixel's light is computed once.
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  gl_.draw_ground(Pass::kDepth);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthFunc(GL_GEQUAL);
  ground(pass);
  if (style_.has_water) gl_.draw_water(view_.far);
  gl_.ground.end();
}

}  // namespace

View surroundings(const View& view) {
  constexpr float kWidest = 1.3F, kWide = 1.1F;  // half angles
  const glm::vec3 forward = glm::normalize(view.target - view.eye);
  const float pitch = std::asin(std::clamp(forward.y, -1.0F, 1.0F));
  float half = 0.5F * view.vertical_fov;
  const float picture_y = std::tan(half);
  const float picture_x = picture_y * static_cast<float>(view.width) / static_cast<float>(view.height);
  float slope_x = picture_x, slope_y = picture_y;
  // A picture with a tilted horizon fits into a square around its corners, however much it is tilted.
  constexpr float kTilted = 1e-3F;
  if (std::abs(glm::normalize(glm::cross(forward, view.up)).y) > kTilted) {
    slope_x = slope_y = std::hypot(picture_x, picture_y);
    half = std::atan(slope_y);
  }
  View wide = view;
  float reach = std::abs(pitch) + half + 0.05F;
  float slope_wide = std::tan(kWide);
  if (reach < kWidest) {
    // Level, so that what the water mirrors from above the picture is inside.
    // Farther away than floats round an eye's place to.
    const float away = std::max(1.0F, 2e-5F * glm::length(view.eye));
    wide.target = view.eye + away * glm::vec3(forward.x, 0, forward.z);
    wide.up = {0, 1, 0};
    slope_wide = std::max(slope_wide, slope_x * std::cos(half) / std::cos(reach));
  } else {
    reach = kWidest;
    slope_wide = std::tan(kWidest);
  }
  slope_wide = std::min(std::max(slope_wide, slope_x), std::max(std::tan(kWidest), slope_x));
  const float slope_tall = std::max(std::tan(reach), slope_y);
  wide.vertical_fov = 2 * std::atan(slope_tall);
  const auto pixels = [](int count, float factor) {
    return static_cast<int>(std::min(std::ceil(static_cast<float>(count) * factor), 1e8F));
  };
  wide.height = pixels(view.height, slope_tall / picture_y);
  wide.width = pixels(view.width, slope_wide / picture_x);
  return wide;
}

LandscapeRenderer::LandscapeRenderer(GlContext& context, const LandscapeStyle& style)
    : context_(context), style_(style) {
  context_.make_current();
  gl_ = std::make_unique<LandscapeGl>(style);
}

LandscapeRenderer::~LandscapeRenderer() { context_.make_current_to_delete(); }

void LandscapeRenderer::restyle(const LandscapeStyle& style) {
  context_.make_current();
  if (style.seed != style_.seed || style.cloud_size != style_.cloud_size) gl_->make_textures(style);
  style_ = style;
}

void LandscapeRenderer::draw(const Frame& frame, const View& view, double seconds) {
  check_view(view);
  context_.make_current();
  RenderTarget& target = context_.target();
  target.resize(view.width, view.height);
  gl_->make_targets(view, style_);
  gl_->buffers.upload(untessellated(frame));
  const LandscapeState state;
  Drawing(*gl_, style_, *this, view, seconds).draw(target);
  check_gl("drawing the landscape");
}

void LandscapeRenderer::skip(const Frame& frame) {
  context_.make_current();
  gl_->buffers.upload(untessellated(frame));
}

bool LandscapeRenderer::shows_ground() {
  context_.make_current();
  return gl_->ground.any();
}

Image LandscapeRenderer::image() {
  context_.make_current();
  return context_.target().read();
}

}  // namespace terrabench
