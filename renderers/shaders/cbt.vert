#version 450 core
// A corner of a leaf of the tree, lit flat by relief.frag: three vertices per leaf, which its number finds.
#include "cbt_tree.glsl"
#include "lit_vertex.glsl"

void main() {
  Place leaf = place_of(leaf_of(uint(gl_VertexID) / 3u));
  ivec2 corners[3] = ivec2[](leaf.a, leaf.b, leaf.c);
  // Beyond the ground's border a leaf would stand upright over its last samples: it becomes a point.
  bool over_ground = all(lessThan(min(min(leaf.a, leaf.b), leaf.c), last));
  ivec2 corner = corners[over_ground ? gl_VertexID % 3 : 0];
  vec2 at = plan(corner);
  write_vertex(vec3(at.x, height_at(corner), at.y), vec3(0.0, 1.0, 0.0), vec3(0.0), 0.0);
}
