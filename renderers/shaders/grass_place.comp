#version 450 core
// Grows all strands into a buffer, each at its own place; or those in view, one after the other, and counts them as
// instances of the draw call that follows.
layout(local_size_x = 64) in;

#include "grass_look.glsl"
#include "grass_ground.glsl"
#include "grass_reach.glsl"
#include "grass_record.glsl"
layout(std430, binding = 2) writeonly buffer Strands { StrandRecord strands[]; };
layout(std430, binding = 3) buffer Command {  // of glDrawElementsIndirect
  uint count;
  uint instances;
  uint first_index;
  int base_vertex;
  uint base_instance;
} command;

uniform bool in_view_only;

// The triangle of a strand: the last whose first strand is not beyond it.
uint triangle_of(uint strand) {
  uint low = 0u, high = growth.triangles;
  while (high - low > 1u) {
    uint middle = (low + high) / 2u;
    if (triangles[middle].w <= strand) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return low;
}

void main() {
  uint number = gl_GlobalInvocationID.x;
  if (number >= growth.strands) return;
  uvec4 triangle = triangles[triangle_of(number)];
  Strand strand = strand_at(corner_at(triangle.x), corner_at(triangle.y), corner_at(triangle.z),
                            number - triangle.w + 1u);
  uint place = number;
  if (in_view_only) {
    if (!in_reach(strand) || !in_view(strand)) return;
    place = atomicAdd(command.instances, 1u);
  }
  strands[place] = StrandRecord(vec4(strand.root, strand.height), vec4(strand.up, strand.random),
                                vec4(strand.side, strand.width));
}
