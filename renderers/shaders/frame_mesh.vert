#version 450 core
// A vertex of a frame's mesh (FrameMesh), lit flat by relief.frag.
layout(location = 0) in vec3 position;
layout(location = 2) in uint mesh_first_triangle;  // one value per mesh

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
  vertex.world = position;
  vertex.normal = vec3(0.0, 1.0, 0.0);
  vertex.paint = vec3(0.0);
  vertex.bend = 0.0;
  vertex.to_edge = vec3(0.0);
  vertex.strength = vec3(0.0);
  vertex.reach = vec3(0.0);
  first_triangle = mesh_first_triangle;
  gl_Position = world_to_clip * vec4(position, 1.0);
}
