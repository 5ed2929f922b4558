// Draws what level-of-detail methods make (terrain/frame.h): keeps heights and indices on the GPU, uploads
// what a frame says has changed, and draws all batches with one call. The vertices stand where
// vertex_position() says.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "renderers/context.h"
#include "terrain/frame.h"
#include "terrain/image.h"
#include "terrain/view.h"

namespace terrabench {

struct FrameStyle {
  float lowest = 0, highest = 1;      // metres at the two ends of the colour ramp
  glm::vec3 sun{-0.5F, 0.7F, -0.5F};  // towards the light
  Rgb background{255, 255, 255};
  float shading_exaggeration = 1;  // of slopes, for the light only
  float wire_width = 0;            // pixels; 0 draws no wires
  float wire_opacity = 0.55F;
};

// For the frames of one method, each given once and in order. Facets are lit flat, so that a picture shows
// the triangles and nothing else. The context must outlive it.
class FrameRenderer {
 public:
  explicit FrameRenderer(GlContext&);
  ~FrameRenderer();
  FrameRenderer(const FrameRenderer&) = delete;
  FrameRenderer& operator=(const FrameRenderer&) = delete;

  // Uploads and draws into the context's picture of view.width × view.height; the ground has no underside.
  // The first frame is uploaded whole. Does not wait for the GPU: finish() does. Throws environment_error
  // when OpenGL has no room for the heights.
  void draw(const Frame&, const View&, const FrameStyle&);
  void finish();
  Image image();  // of what was drawn last

  // The number of the triangle, in the order of triangles(Frame), that each pixel shows: row by row from the
  // top, from 1 on; 0 where there is none. One sample a pixel, at its centre, and no far plane. Uploads as
  // draw() does.
  std::vector<std::uint32_t> triangle_numbers(const Frame&, const View&);

  // What went into the GPU's buffers since the beginning: of each frame FrameStats::bytes_sent(), of the
  // first whatever the frame holds. A few hundred bytes of uniforms a frame are not counted.
  std::size_t bytes_uploaded() const;

 private:
  struct Gl;
  GlContext& context_;
  std::unique_ptr<Gl> gl_;
};

}  // namespace terrabench
