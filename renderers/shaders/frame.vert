#version 450 core
// A vertex of a frame's heights, lit flat by relief.frag.
#include "frame_heights.glsl"
uniform mat4 world_to_clip;

out Vertex {
  vec3 world;
  vec3 normal;
  vec3 paint;
  float bend;
  noperspective vec3 to_edge;
  flat vec3 strength;
  flat vec3 reach;
} vertex;
flat out uint first_triangle;

void main() {
  BatchRecord batch = batches[batch_number];
  vertex.world = frame_position(batch);
  vertex.normal = vec3(0.0, 1.0, 0.0);
  vertex.paint = vec3(0.0);
  vertex.bend = 0.0;
  vertex.to_edge = vec3(0.0);
  vertex.strength = vec3(0.0);
  vertex.reach = vec3(0.0);
  first_triangle = batch.first_triangle;
  gl_Position = world_to_clip * vec4(vertex.world, 1.0);
}
