#version 450 core
// A tessellated patch is one vertex: TessellatedPatch of terrain/frame.h.
layout(location = 0) in uvec2 corner_and_factors;

out uvec2 patch_record;

void main() { patch_record = corner_and_factors; }
