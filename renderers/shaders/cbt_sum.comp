#version 450 core
// Sums the level below into one level: 32 nodes, whose sums fill whole words, per invocation. The topmost levels are
// summed by one invocation, which also writes the sizes of the next frame's passes and of the draw call.
layout(local_size_x = 64) in;

#include "cbt_tree.glsl"
layout(std430, binding = 4) writeonly buffer Commands {
  uvec4 draw;    // of glDrawArraysIndirect
  uvec3 groups;  // of glDispatchComputeIndirect
  uint unused;
};

uniform int level;

// In the five levels above the bits, nodes count theirs: one word instead of up to four.
uint sum_below(uint node) {
  int levels = depth - findMSB(node);
  if (levels > 5) return sum(2u * node) + sum(2u * node + 1u);
  uint first = (2u << depth) + (node << levels);
  return uint(bitCount(words[first >> 5] >> (first & 31u) & 0xFFFFFFFFu >> (32 - (1 << levels))));
}

void sum_group(uint first_node, uint bits) {
  uint word = ((2u << level) + first_node * bits) / 32u, filled = 0u, pending = 0u;
  for (uint node = first_node; node < first_node + 32u; ++node) {
    uint value = sum_below(node);
    pending |= value << filled;
    filled += bits;
    if (filled < 32u) continue;
    words[word++] = pending;
    filled -= 32u;
    pending = filled == 0u ? 0u : value >> (bits - filled);
  }
}

void write(uint node, uint bits, uint value) {
  uint first = (2u << findMSB(node)) + node * bits, word = first >> 5, shift = first & 31u;
  uint mask = (1u << bits) - 1u;
  words[word] = (words[word] & ~(mask << shift)) | value << shift;
  if (shift + bits <= 32u) return;
  words[word + 1u] = (words[word + 1u] & ~(mask >> (32u - shift))) | value >> (32u - shift);
}

void main() {
  if (level >= 5) {
    uint parts = 1u << (level - 5);
    for (uint k = gl_GlobalInvocationID.x; k < parts; k += gl_NumWorkGroups.x * gl_WorkGroupSize.x) {
      sum_group((1u << level) + 32u * k, uint(depth - level) + 1u);
    }
    return;
  }
  if (gl_GlobalInvocationID.x != 0u) return;
  for (uint node = (2u << level) - 1u; node > 0u; --node) {
    write(node, uint(depth - findMSB(node)) + 1u, sum_below(node));
  }
  uint leaves = sum(1u);
  groups = uvec3(min((leaves + 63u) / 64u, 65535u), 1u, 1u);
  draw = uvec4(3u * leaves, 1u, 0u, 0u);
}
