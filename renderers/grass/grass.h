// Grass on any triangles, as crossed billboards with a procedural texture (hybrid paper, §3.3, Table 3). It
// draws into the framebuffer that is bound, so that it can be one pass of any renderer:
//
//   GrassRenderer grass;                                              // once per context
//   GrassPatch patch(grass_ground(mesh), {.strands = 40'000});        // once per piece of ground
//   ... draw the ground ...
//   grass.draw(patch, {.world_to_clip = matrix, .eye = view.eye, .sun = sun, .fog_density = 0.002F,
//                      .linear = true}, GrassTechnique::kIndirect);   // in each frame
//
// draw() wants depth test and depth writes on, and blending off. It leaves these and the culling of faces as
// they were, and changes the program, the vertex array, texture unit 0, uniform buffers 0 and 1, storage
// buffers 0 to 3, and the buffer of indirect commands. Where the framebuffer is multisampled, a share of a
// pixel's samples gives blades soft edges.
//
// Three techniques draw the same billboards:
//   kGeometryShader  as the paper: grown anew from the triangles in each frame; no memory per strand. Each
//                    invocation of the shader emits one strand, so that its output is small and many run at
//                    once
//   kInstancing      grown once, then one instance per strand; 48 B per strand
//   kIndirect        a compute shader grows the strands that are in view, and one indirect call draws them;
//                    up to 48 B per strand
// The same ground and growth give the same strands on every GPU, unless GrassGrowth::random says otherwise.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <vector>

#include "renderers/grass/growth.h"

namespace terrabench {

enum class GrassTechnique : std::uint8_t { kGeometryShader, kInstancing, kIndirect };
inline constexpr GrassTechnique kGrassTechniques[] = {GrassTechnique::kGeometryShader,
                                                      GrassTechnique::kInstancing, GrassTechnique::kIndirect};

// Camera, light, air and wind of a frame. Colours are linear light.
struct GrassLook {
  glm::mat4 world_to_clip{1};
  glm::vec3 eye{0};                             // metres
  glm::vec3 sun{-0.5F, 0.7F, -0.5F};            // towards the light; any length above 0
  glm::vec3 sun_colour{1.9F, 1.75F, 1.45F};     // on a surface that faces it
  glm::vec3 sky_colour{0.45F, 0.55F, 0.70F};    // on a surface that faces up
  glm::vec3 fog_colour{0.54F, 0.67F, 0.85F};    // far away
  glm::vec3 fog_sun_colour{1.0F, 0.85F, 0.6F};  // far away towards the sun
  float fog_density = 0;                        // per metre; 0: none
  // Points p with dot(plane, (p, 1)) < 0 are not drawn. The caller enables GL_CLIP_DISTANCE0; llvmpipe clips
  // even without. The default keeps everything.
  glm::vec4 clip_plane{0, 0, 0, 1};
  glm::vec2 wind{0};  // x, z: metres by which the tip of a strand of 1 m moves at most
  float seconds = 0;  // of the wind's motion
  // From this distance to the next in metres, strands become fewer down to none. Both 0: none thin out.
  float thin_from = 0, none_beyond = 0;
  bool linear = false;  // write linear light instead of sRGB
};

// The grass of a piece of ground, on the GPU. The context must be current where it is made, drawn and
// destroyed.
class GrassPatch {
 public:
  // Copies the ground. Throws as plan_grass() does, and environment_error when it does not fit.
  GrassPatch(const GrassGround&, const GrassGrowth&);
  ~GrassPatch();
  GrassPatch(GrassPatch&&) noexcept;
  GrassPatch& operator=(GrassPatch&&) noexcept;

  std::int64_t strands() const;
  std::size_t bytes() const;  // on the GPU, of what the techniques used so far need

 private:
  friend class GrassRenderer;
  struct Gl;
  std::unique_ptr<Gl> gl_;
};

// A strand as the GPU grew it.
struct GrassStrand {
  glm::vec3 root;
  float height;  // metres
  glm::vec3 up;
  float random;  // [0, 1)
  glm::vec3 side;
  float width;  // metres
};

// The same as the processor grows it: shaders/grass_strand.glsl once more in C++, to see how far what a GPU
// grows depends on its arithmetic (hybrid paper, §3.3). Strand `number`, counted from 1, of the triangle with
// the corners (x, y, z) of a plan. In floats. O(1).
GrassStrand grow_strand(const GrassGround&, const GrassGrowth&, const glm::uvec4& triangle,
                        std::uint32_t number);

// The programs and the texture, which all patches share.
class GrassRenderer {
 public:
  GrassRenderer();
  ~GrassRenderer();
  GrassRenderer(const GrassRenderer&) = delete;
  GrassRenderer& operator=(const GrassRenderer&) = delete;

  // Does not wait for the GPU. Patches out of view and those without strands cost nothing on the GPU.
  void draw(std::span<GrassPatch* const>, const GrassLook&, GrassTechnique);
  void draw(GrassPatch&, const GrassLook&, GrassTechnique);

  // Draws, and returns the billboards that the GPU sent to be rasterised, by its own count. kGeometryShader
  // and kIndirect leave out strands that lie outside the view or are thinned out. Waits for the GPU.
  std::int64_t count_billboards(GrassPatch&, const GrassLook&, GrassTechnique);

  // All strands of the patch, read back, in the order of the plan's triangles. Waits for the GPU.
  std::vector<GrassStrand> strands(GrassPatch&);

 private:
  struct Gl;
  std::unique_ptr<Gl> gl_;
};

}  // namespace terrabench
