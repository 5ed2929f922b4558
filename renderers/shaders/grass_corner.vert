#version 450 core
// Passes a triangle's corners to grass.geom. Instance k draws strand k + 1 of each triangle.
#include "grass_ground.glsl"

out Root {
  vec3 position;
  vec3 normal;
  flat uint number;  // of the triangle's strand, counted from 1
} root;

void main() {
  uint number = uint(gl_VertexID) / 3u;
  uvec4 triangle = triangles[number];
  Corner at = corner_at(triangle[uint(gl_VertexID) % 3u]);
  root.position = at.position;
  root.normal = at.normal;
  root.number = uint(gl_InstanceID) + 1u;
}
