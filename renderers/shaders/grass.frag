#version 450 core
#include "grass_light.glsl"
in Blade {
  vec3 world;
  vec2 at;
  flat vec3 up;
  flat float layer;
  flat float random;
} blade;

layout(binding = 0) uniform sampler2DArray blades;
uniform bool multisampled;  // alpha becomes the share of a pixel's samples

layout(location = 0) out vec4 color;

void main() {
  vec4 painted = texture(blades, vec3(blade.at, blade.layer));
  // The edge of a blade is one pixel wide at every distance.
  float cover = clamp((painted.a - 0.5) / max(fwidth(painted.a), 1e-3) + 0.5, 0.0, 1.0);
  if (cover < (multisampled ? 0.05 : 0.5)) discard;
  // Grass takes the light of the ground that it grows on, less near the root, where blades shade each other.
  float shade = mix(0.35, 1.0, blade.at.y) * (0.8 + 0.4 * fract(blade.random * 7.0));
  float direct = 0.25 + 0.75 * max(dot(blade.up, look.sun.xyz), 0.0);
  vec3 light = look.sky_colour.rgb * (0.5 + 0.5 * blade.up.y) + look.sun_colour.rgb * direct;
  color = grass_finished(painted.rgb * light * shade, blade.world, cover);
}
