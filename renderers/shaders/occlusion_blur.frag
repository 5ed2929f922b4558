#version 450 core
// The mean of a pixel's neighbours at about its own depth: removes the pattern of occlusion.frag's turned samples.
in vec2 at;

layout(binding = 5) uniform sampler2D depth_map;
layout(binding = 7) uniform sampler2D occlusion_map;
uniform float near;  // metres, of the near plane

layout(location = 0) out float open;

float metres_at(ivec2 p) { return near / max(texelFetch(depth_map, p, 0).r, 1e-7); }

void main() {
  ivec2 here = ivec2(gl_FragCoord.xy), last = textureSize(depth_map, 0) - 1;
  float depth = metres_at(here), sum = 0.0, weights = 0.0;
  for (int y = -3; y <= 3; ++y) {
    for (int x = -3; x <= 3; ++x) {
      ivec2 p = clamp(here + ivec2(x, y), ivec2(0), last);
      float weight = max(1.0 - abs(metres_at(p) - depth) / (0.04 * depth), 0.001);
      sum += weight * texelFetch(occlusion_map, p, 0).r;
      weights += weight;
    }
  }
  open = sum / weights;
}
