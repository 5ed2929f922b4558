// What a LandscapeRenderer keeps on the GPU: programs, textures and the targets of its passes.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include "renderers/frame_buffers.h"
#include "renderers/gl.h"
#include "renderers/landscape/landscape.h"
#include "renderers/landscape/pass_target.h"
#include "renderers/landscape/style.h"

namespace terrabench {

// The uniform block of scene.glsl, which says what each member means.
inline constexpr int kCascades = 3;
inline constexpr unsigned kSceneBinding = 0;

struct SceneBlock {
  glm::mat4 world_to_clip{1}, clip_to_world{1};
  std::array<glm::mat4, kCascades> to_shadow{};
  glm::vec4 shadow_texel{0}, clip_plane{0}, eye{0}, sun{0}, sun_light{0}, sky_light{0}, sky_high{0},
      sky_low{0}, fog_color{0}, cloud_color{0}, cloud_range{0}, border{0}, border_fade{0}, band_tops{0},
      ground{0}, ground_modes{0};
  std::array<glm::vec4, 2 * kMaterials> materials{};
  glm::vec4 water{0}, water_color{0}, waves{0}, fresnel{0}, pixels{0};
};
static_assert(sizeof(SceneBlock) == (5 * 4 + 16 + 10 + 5) * sizeof(glm::vec4));

// The members that are the same in all passes. `seconds` moves clouds and waves.
SceneBlock describe(const LandscapeStyle&, double seconds);

struct LandscapeGl {
  static constexpr int kShadowSide = 2048;

  explicit LandscapeGl(const LandscapeStyle&);
  void make_textures(const LandscapeStyle&);
  // Makes the targets that a picture of this size and style needs, and keeps those that fit.
  void make_targets(const View&, const LandscapeStyle&);

  void write(const SceneBlock&);
  void bind();  // the block and the maps that all passes share
  void draw_sky(bool shown);
  void draw_ground(Pass);  // whose programs differ: depth alone, light, or the display's colours
  void draw_water(float reach);
  void draw_occlusion(const View&, const LandscapeStyle&);

  // Heights and meshes.
  struct GroundPrograms {
    Program heights, meshes;
  };
  GroundPrograms depth, lit;
  Program sky, water, occlusion, blur;
  VertexArray nothing;  // of shaders that compute their vertices
  FrameBuffers buffers;
  VisibleQuery ground;  // and water
  GrowingBuffer block{0};

  TextureArray materials;
  std::optional<Texture2d> sky_noise, waves;
  std::optional<TextureArray> shadows;
  Framebuffer shadow_framebuffer;
  std::optional<PassTarget> reflection, refraction, depths, occluded, blurred;
};

}  // namespace terrabench
