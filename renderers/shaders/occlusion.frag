#version 450 core
// Ambient occlusion from the depth of the picture, after McGuire et al. 2011 ("The Alchemy screen-space ambient
// obscurance algorithm"): how much of the sky near ground hides, at pixels around.
#include "scene.glsl"
in vec2 at;

layout(binding = 5) uniform sampler2D depth_map;
uniform float radius;  // as a share of the distance from the eye

layout(location = 0) out float open;

vec3 position_at(vec2 p) {
  vec4 world = clip_to_world * vec4(p * 2.0 - 1.0, textureLod(depth_map, p, 0.0).r, 1.0);
  return world.xyz / world.w;
}

void main() {
  vec2 here = at * 0.5 + 0.5;
  if (textureLod(depth_map, here, 0.0).r <= 0.0) {
    open = 1.0;
    return;
  }
  vec2 pixel = 1.0 / pixels.xy;
  vec3 p = position_at(here);
  // The flatter side of each pair, so that silhouettes do not bend the normal.
  vec3 right = position_at(here + vec2(pixel.x, 0.0)) - p, left = p - position_at(here - vec2(pixel.x, 0.0));
  vec3 up = position_at(here + vec2(0.0, pixel.y)) - p, down = p - position_at(here - vec2(0.0, pixel.y));
  vec3 n = normalize(cross(dot(right, right) < dot(left, left) ? right : left,
                           dot(up, up) < dot(down, down) ? up : down));
  float reach = radius * distance(p, eye.xyz);
  float turn = 6.2831853 * fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715))));
  float hidden = 0.0;
  const int kTaps = 20;
  float across = 0.5 * radius * pixels.y / pixels.x;
  for (int tap = 0; tap < kTaps; ++tap) {
    float share = (float(tap) + 0.5) / float(kTaps), angle = turn + 2.399963 * float(tap);
    vec2 offset = sqrt(share) * vec2(cos(angle) * across, sin(angle) * 0.5 * radius) * 1.6;
    vec3 to = position_at(clamp(here + offset, pixel, 1.0 - pixel)) - p;
    float square = dot(to, to);
    float fade = max(1.0 - square / (reach * reach * 4.0), 0.0);
    hidden += fade * max(dot(to, n) - 0.02 * reach, 0.0) / (sqrt(square) + 0.05 * reach);
  }
  open = clamp(1.0 - sky_light.w * 2.2 * hidden / float(kTaps), 0.0, 1.0);
}
