#version 450 core
// Lit and fogged ground.
#include "scene.glsl"
#include "display.glsl"
#include "sky_blend.glsl"
#include "atmosphere.glsl"
#include "shadow.glsl"
#include "ground_slope.glsl"
#include "materials.glsl"
in vec3 world, normal;

layout(binding = 7) uniform sampler2D occlusion_map;  // of the picture's pixels
uniform bool shown;  // in the picture, not in a pass that others read

layout(location = 0) out vec4 color;

void main() {
  vec3 n = normalize(normal);
  Surface surface = surface_at(world, n);
  vec3 bump = ground_modes.z * surface.bump;
  vec3 facing = normalize(n - (bump - n * dot(bump, n)));

  float direct = max(dot(facing, sun.xyz), 0.0) * smoothstep(-0.05, 0.15, dot(n, sun.xyz));
  if (direct > 0.0) direct *= sunlight_at(world, n);
  float open = shown && ground_modes.w < 0.5 ? texelFetch(occlusion_map, ivec2(gl_FragCoord.xy), 0).r : 1.0;
  // Light from the sky above, and a little from lit ground below.
  vec3 ambient = sky_light.rgb * (0.62 + 0.38 * facing.y) + 0.09 * sun_light.rgb * (0.5 - 0.5 * facing.y);
  vec3 light = surface.albedo * (sun_light.rgb * direct + ambient * open);
  light = through_air(light, world);
  color = vec4(shown ? to_display(light) : light, 1.0);
}
