// The heights of a frame and what it says of their grid, laid out as in renderers/frame_buffers.cpp.
layout(std430, binding = 0) readonly buffer Heights { float heights[]; };

layout(std140, binding = 1) uniform Ground {
  ivec2 samples;              // of the grid
  vec2 cell;                  // metres
  ivec2 first, last, origin;  // of Frame, for clip levels
  int side;                   // of the clip levels; 0 for a grid
  int patch_side;             // cells, of what morphs or is tessellated; otherwise 0
  vec3 morph_eye;             // metres
  int morph_ranges;           // levels of morphing nodes; 0 without
};

float sample_at(ivec2 at) { return heights[at.y * samples.x + at.x]; }
