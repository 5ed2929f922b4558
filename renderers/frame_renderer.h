// Draws the frames of level-of-detail methods (terrain/frame.h): keeps heights and indices on the GPU,
// uploads the frame's dirty ranges, and draws all batches with one call, or all patches, which the GPU's
// tessellator divides. Vertices have the positions of vertex_position().
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <span>
#include <vector>

#include "renderers/context.h"
#include "terrain/frame.h"
#include "terrain/image.h"
#include "terrain/view.h"

namespace terrabench {

// What colours the ground: its height; the size of its triangles; a colour per sample, see paint().
enum class GroundColours : std::uint8_t { kHeight, kTriangleSize, kPaint };

struct FrameStyle {
  float lowest = 0, highest = 1;      // metres at the two ends of the colour ramp
  glm::vec3 sun{-0.5F, 0.7F, -0.5F};  // towards the light
  Rgb background{255, 255, 255};
  float shading_exaggeration = 1;  // factor by which slopes are steepened for the light only
  float wire_width = 0;            // pixels; 0 draws no wires
  float wire_opacity = 0.55F;
  GroundColours colours = GroundColours::kHeight;
};

// Of triangles that are half a square of 1, 2, 4, … cells; sizes in between are mixed.
std::span<const Rgb> triangle_size_colours();

// For the frames of one method, each drawn once and in order: heights and meshes. Facets are lit flat, so
// that the triangles are visible. The context must outlive it.
class FrameRenderer {
 public:
  explicit FrameRenderer(GlContext&);
  ~FrameRenderer();
  FrameRenderer(const FrameRenderer&) = delete;
  FrameRenderer& operator=(const FrameRenderer&) = delete;

  // Uploads and draws into the context's picture, resized to view.width × view.height. Triangles seen from
  // below are not drawn. The first frame is uploaded whole. Does not wait for the GPU. Throws
  // environment_error when the heights do not fit into OpenGL's buffers.
  void draw(const Frame&, const View&, const FrameStyle&);
  // Whether the last picture shows any of the ground. Waits for the GPU.
  bool shows_ground();
  // The two halves of draw(), so that each can be timed: the second draws the frame that was uploaded last.
  void upload(const Frame&);
  void draw_uploaded(const View&, const FrameStyle&);
  void finish();  // waits for the GPU
  // The ground's colours for GroundColours::kPaint: a pixel per sample of the full terrain, the north-western
  // first, `extent` metres from the first to the last along x and z.
  void paint(const Image&, const glm::vec2& extent);
  Image image();  // the last picture drawn

  // For each pixel, row by row from the top: the number of its visible triangle in the order of
  // triangles(Frame), counted from 1; 0 for none. One sample per pixel, at its centre, and no far plane.
  // Uploads like draw().
  std::vector<std::uint32_t> triangle_numbers(const Frame&, const View&);

  // All bytes written to the GPU's buffers: the whole first frame, FrameStats::bytes_sent() of the others,
  // and bytes_resent(): arrays sent once more because their buffer had to grow. A few hundred bytes of
  // uniforms per frame are not counted.
  std::size_t bytes_uploaded() const;
  std::size_t bytes_resent() const;

 private:
  struct Gl;
  GlContext& context_;
  std::unique_ptr<Gl> gl_;
};

}  // namespace terrabench
