#version 450 core
// Into how many segments the sides and the inside of a patch are divided.
layout(vertices = 1) out;

in uvec2 patch_record[];
patch out uint patch_corner;

float factor(int place) { return float(1u << (patch_record[0].y >> (4 * place) & 15u)); }

void main() {
  patch_corner = patch_record[0].x;
  // OpenGL's order is west, north, east, south.
  for (int side = 0; side < 4; ++side) gl_TessLevelOuter[(side + 1) % 4] = factor(side);
  gl_TessLevelInner[0] = gl_TessLevelInner[1] = factor(4);
}
