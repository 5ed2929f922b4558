#version 450 core
// Splits leaves in view that are too coarse, with the coarser neighbours that keep the mesh conforming: sets their
// bits. Sums are still those of the last frame.
layout(local_size_x = 64) in;

#include "cbt_tree.glsl"
#include "cbt_rule.glsl"

void set(uint node) {
  uint bit = bit_of_split(node);
  atomicOr(words[bit >> 5], 1u << (bit & 31u));
}

void split(Place place) {
  while (true) {
    // Also of a diamond that was split: it may have been merged in this frame. None that it needs was.
    bool was_split = sum(place.node) > 1u;
    set(place.node);
    if (place.across != 0u) set(place.across);
    if (was_split || place.across < 2u * first_root()) return;
    place = place_of(place.across / 2u);
  }
}

void main() {
  uint leaves = sum(1u);
  for (uint k = gl_GlobalInvocationID.x; k < leaves; k += gl_NumWorkGroups.x * gl_WorkGroupSize.x) {
    Place leaf = place_of(leaf_of(k));
    if (is_coarse(leaf) && is_in_view(leaf.node)) split(leaf);
  }
}
