#version 450 core
// A vertex of a frame's mesh (FrameMesh), lit flat by relief.frag.
#include "lit_vertex.glsl"
layout(location = 0) in vec3 position;
layout(location = 2) in uint mesh_first_triangle;  // one value per mesh

flat out uint first_triangle;

void main() {
  write_vertex(position, vec3(0.0, 1.0, 0.0), vec3(0.0), 0.0);
  first_triangle = mesh_first_triangle;
}
