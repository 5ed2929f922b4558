#version 450 core
// Grows the strands of a triangle anew in each frame, as the paper does.
layout(triangles) in;
layout(triangle_strip, max_vertices = 64) out;  // kBlock strands of grass_corner.vert

#include "grass_look.glsl"
#include "grass_strand.glsl"
#include "grass_reach.glsl"
#include "grass_blade.glsl"

in Root {
  vec3 position;
  vec3 normal;
  flat uint first;
  flat uint last;
} root[];

void main() {
  Corner a = Corner(root[0].position, root[0].normal);
  Corner b = Corner(root[1].position, root[1].normal);
  Corner c = Corner(root[2].position, root[2].normal);
  for (uint number = root[0].first; number <= root[0].last; ++number) {
    Strand strand = strand_at(a, b, c, number);
    if (!in_reach(strand)) continue;
    for (uint corner = 0u; corner < 8u; ++corner) {
      set_corner(strand, corner);
      EmitVertex();
      if (corner % 4u == 3u) EndPrimitive();
    }
  }
}
