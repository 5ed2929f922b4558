#version 450 core
// Merges diamonds of four leaves, or of two at the border: clears their bits. All sums, and the bits of left halves,
// stay as they are, so that each leaf decides on the tree of the last frame.
layout(local_size_x = 64) in;

#include "cbt_tree.glsl"
#include "cbt_rule.glsl"

void clear(uint node) {
  uint bit = bit_of_split(node);
  atomicAnd(words[bit >> 5], ~(1u << (bit & 31u)));
}

void main() {
  uint leaves = sum(1u);
  for (uint k = gl_GlobalInvocationID.x; k < leaves; k += gl_NumWorkGroups.x * gl_WorkGroupSize.x) {
    uint leaf = leaf_of(k);
    if ((leaf & 1u) != 0u || leaf / 2u < first_root() || sum(leaf / 2u) != 2u) continue;
    Place parent = place_of(leaf / 2u);
    bool alone = parent.across == 0u;
    if (!alone && (parent.node > parent.across || sum(parent.across) != 2u)) continue;
    uint mask = 63u;
    if (is_coarse(parent) &&
        (is_in_view(parent.node) ||
         (!alone && is_in_view(parent.b, parent.a, parent.a + parent.b - parent.c, mask)))) {
      continue;
    }
    clear(parent.node);
    if (!alone) clear(parent.across);
  }
}
