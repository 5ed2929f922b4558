#version 450 core
// A vertex of a tessellated patch, lit flat by relief.frag. All vertices are samples.
layout(quads, equal_spacing, cw) in;
#include "ground_block.glsl"
#include "lit_vertex.glsl"
patch in uint patch_corner;

void main() {
  ivec2 low = ivec2(int(patch_corner) % samples.x, int(patch_corner) / samples.x);
  ivec2 at = min(low + ivec2(round(gl_TessCoord.xy * float(patch_side))), samples - 1);
  vec3 position = vec3(float(at.x) * cell.x, sample_at(at), float(at.y) * cell.y);
  write_vertex(position, vec3(0.0, 1.0, 0.0), vec3(0.0), 0.0);
}
