#version 450 core
// Grows one strand of a triangle anew in each frame, as the paper does.
layout(triangles) in;
layout(triangle_strip, max_vertices = 8) out;

#include "grass_strand.glsl"
#include "grass_blade.glsl"
#include "grass_reach.glsl"

in Root {
  vec3 position;
  vec3 normal;
  flat uint number;
} root[];

void main() {
  Strand strand = strand_at(Corner(root[0].position, root[0].normal), Corner(root[1].position, root[1].normal),
                            Corner(root[2].position, root[2].normal), root[0].number);
  if (!in_reach(strand) || !in_view(strand)) return;
  Bush bush = bush_of(strand);
  for (uint corner = 0u; corner < 8u; ++corner) {
    set_corner(bush, corner);
    EmitVertex();
    if (corner % 4u == 3u) EndPrimitive();
  }
}
