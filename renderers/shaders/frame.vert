#version 450 core
// A vertex of a frame's heights, lit flat by relief.frag.
#include "frame_heights.glsl"
#include "lit_vertex.glsl"
flat out uint first_triangle;

void main() {
  BatchRecord batch = batches[batch_number];
  write_vertex(frame_position(batch), vec3(0.0, 1.0, 0.0), vec3(0.0), 0.0);
  first_triangle = batch.first_triangle;
}
