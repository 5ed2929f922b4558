#version 450 core
// Passes a triangle's corners to grass.geom. One instance draws kBlock strands of each triangle.
#include "grass_ground.glsl"

out Root {
  vec3 position;
  vec3 normal;
  flat uint first;  // strand of the triangle to draw, counted from 1
  flat uint last;
} root;

const uint kBlock = 8u;

void main() {
  uint number = uint(gl_VertexID) / 3u;
  uvec4 triangle = triangles[number];
  Corner at = corner_at(triangle[uint(gl_VertexID) % 3u]);
  root.position = at.position;
  root.normal = at.normal;
  uint count = triangles[number + 1u].w - triangle.w;
  root.first = uint(gl_InstanceID) * kBlock + 1u;
  root.last = min(root.first + kBlock - 1u, count);
}
