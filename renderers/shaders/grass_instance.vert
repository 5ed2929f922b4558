#version 450 core
// One instance per strand.
#include "grass_strand.glsl"
#include "grass_blade.glsl"
#include "grass_reach.glsl"
#include "grass_record.glsl"
layout(std430, binding = 2) readonly buffer Strands { StrandRecord strands[]; };

void main() {
  StrandRecord kept = strands[gl_InstanceID];
  Strand strand = Strand(kept.root_height.xyz, kept.root_height.w, kept.up_random.xyz, kept.up_random.w,
                         kept.side_width.xyz, kept.side_width.w);
  set_corner(bush_of(strand), uint(gl_VertexID));
  if (!in_reach(strand)) gl_Position = vec4(0.0, 0.0, -2.0, 1.0);  // outside: its triangles are degenerate, too
}
