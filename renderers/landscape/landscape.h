// Draws the frames of a level-of-detail method as a landscape (hybrid paper, §3.4 and §4): ground with
// textures by height and slope, sky with clouds, fog with the sun's colour, water that reflects and refracts,
// and, for still pictures, cast shadows and ambient occlusion.
//
// A picture takes these passes: shadow maps; the depth of the picture, from which occlusion is computed; the
// scene mirrored at the water's level and cut off below it; the scene cut off above it; the picture. An eye
// under water swaps the two sides. Passes that nothing needs are left out: those of water without water.
// O(triangles · passes + pixels).
#pragma once

#include <cstdint>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <memory>

#include "renderers/context.h"
#include "renderers/landscape/style.h"
#include "terrain/frame.h"
#include "terrain/image.h"
#include "terrain/view.h"

namespace terrabench {

struct LandscapeGl;

enum class Pass : std::uint8_t { kShadow, kDepth, kReflection, kRefraction, kPicture };

// What a pass draws. The uniform block of scene.glsl holds the same at binding 0, together with the style.
struct PassView {
  Pass pass = Pass::kPicture;
  glm::mat4 world_to_clip{1};
  glm::vec4 clip_plane{0};  // gl_ClipDistance[0] is its product with (position, 1), and is enabled
  glm::vec3 eye{0};         // mirrored in Pass::kReflection, where triangles are clockwise
  int width = 0, height = 0;
  double seconds = 0;
};
// Whether a pass needs colours, in linear light, and not only depth. The picture alone is in sRGB.
inline bool has_colors(Pass pass) { return pass != Pass::kShadow && pass != Pass::kDepth; }

// The view to update a level-of-detail method with, so that its frame holds what reflections and shadows need
// beside the view itself: the same eye and the same pixels per angle, wider.
View surroundings(const View&);

// For the frames of one method, each drawn once and in order. The context must outlive it.
class LandscapeRenderer {
 public:
  // Computes the textures, which takes about a second. Throws environment_error as link_program() does.
  LandscapeRenderer(GlContext&, const LandscapeStyle&);
  ~LandscapeRenderer();
  LandscapeRenderer(const LandscapeRenderer&) = delete;
  LandscapeRenderer& operator=(const LandscapeRenderer&) = delete;

  // Called in each pass after the ground is drawn, with the pass's framebuffer bound and depth test on: draws
  // what else stands on the ground, such as grass.
  std::function<void(const PassView&)> also;
  // Called before each pass; may change what it draws.
  std::function<void(PassView&)> adjust;

  // Draws into the context's picture, resized to view.width × view.height, at `seconds` of the clouds' and
  // waves' time. Throws usage_error for a view that is not finite or empty and environment_error for lack of
  // memory.
  void draw(const Frame&, const View&, double seconds = 0);
  Image image();  // the last picture drawn
  // Whether it shows any ground or water. Waits for the GPU.
  bool shows_ground();
  // Takes over a frame without drawing it.
  void skip(const Frame&);
  // Style from the next picture on; textures are kept unless their seed or the clouds' size changes.
  void restyle(const LandscapeStyle&);

 private:
  GlContext& context_;
  LandscapeStyle style_;
  std::unique_ptr<LandscapeGl> gl_;
};

}  // namespace terrabench
