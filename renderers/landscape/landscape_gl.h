// What a LandscapeRenderer keeps on the GPU: programs, textures and the targets of its passes.
#pragma once

#include <array>
#include <optional>

#include "renderers/frame_buffers.h"
#include "renderers/gl.h"
#include "renderers/landscape/landscape.h"
#include "renderers/landscape/pass_target.h"
#include "renderers/landscape/scene_block.h"

namespace terrabench {

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
