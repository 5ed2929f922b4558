#version 450 core
// Water (hybrid paper, §3.4): the reflected and the refracted scene, warped by a moving du/dv map, mixed by the
// Fresnel term; highlights of the sun by a moving normal map.
#include "scene.glsl"
#include "display.glsl"
#include "sky_blend.glsl"
#include "atmosphere.glsl"
#include "shadow.glsl"
#include "fresnel.glsl"
in vec3 world;

layout(binding = 2) uniform sampler2D wave_map;  // du, dv; slope along x and z
layout(binding = 3) uniform sampler2D reflection;
layout(binding = 4) uniform sampler2D refraction;
layout(binding = 5) uniform sampler2D refraction_depth;

layout(location = 0) out vec4 color;

// Of two copies of the map that move in different directions, and a third, wider one that hides that they repeat. In
// the distance copies are 4, 16, … times as wide, so that waves are never finer than a pixel.
vec4 waves_at(vec2 p, float octave) {
  float scale = pow(0.25, octave);
  vec2 travelled = vec2(waves.z) / water.w * scale;
  p *= scale / water.w;
  const mat2 kTurn = mat2(0.731, 0.682, -0.682, 0.731), kTurnMore = mat2(0.292, -0.956, 0.956, 0.292);
  vec4 first = texture(wave_map, p + travelled * vec2(0.8, 0.6));
  vec4 second = texture(wave_map, kTurn * p * 0.617 - travelled * vec2(0.35, 0.72) + 0.37);
  vec4 third = texture(wave_map, kTurnMore * p * 0.193 + travelled * vec2(0.1, -0.24) + 0.71);
  second.zw = transpose(kTurn) * second.zw;
  third.zw = transpose(kTurnMore) * third.zw;
  return 0.5 * first + 0.5 * second + 0.45 * third;
}

vec4 waves_at(vec2 p, vec2 dx, vec2 dy) {
  float texels = 512.0 / water.w * min(length(dx), length(dy));
  float sizes = max(0.5 * log2(max(texels, 1e-6)) - 1.0, 0.0), octave = floor(sizes);
  return mix(waves_at(p, octave), waves_at(p, octave + 1.0), sizes - octave);
}

// Metres from the eye to what the refraction pass shows there.
float depth_at(vec2 at) {
  vec4 p = clip_to_world * vec4(at * 2.0 - 1.0, texture(refraction_depth, at).r, 1.0);
  return distance(p.xyz / p.w, eye.xyz);
}

void main() {
  vec3 away = world - eye.xyz;
  float reach = length(away);
  vec3 v = -away / reach;
  vec4 wave = waves_at(world.xz, dFdx(world.xz), dFdy(world.xz));
  vec3 n = normalize(vec3(-waves.y * wave.z, 1.0, -waves.y * wave.w)) * water.y;
  // Waves that face away from the eye are hidden behind others.
  n = normalize(n + v * max(0.02 - dot(n, v), 0.0));

  vec2 at = gl_FragCoord.xy / pixels.xy;
  vec2 warp = waves.x * wave.xy * clamp(40.0 * water.w / reach, 0.05, 1.0);
  float behind = depth_at(at) - reach;
  vec2 refracted_at = clamp(at + warp * clamp(behind / water.w, 0.0, 1.0), 0.002, 0.998);
  float thickness = depth_at(refracted_at) - reach;
  if (thickness < 0.0) {  // what stands before the water must not smear into it
    refracted_at = at;
    thickness = max(behind, 0.0);
  }
  vec2 reflected_at = clamp(at + warp * vec2(1.0, 2.2), 0.002, 0.998);

  vec3 below = texture(refraction, refracted_at).rgb;
  if (water.y > 0.0) below = through_water(below, thickness);
  vec3 above = texture(reflection, reflected_at).rgb;
  float share = reflectance(fresnel_cosine(int(fresnel.x), n, v, sun.xyz), fresnel.y, fresnel.z);
  // From below, beyond the critical angle, nothing but the reflection is seen.
  if (water.y < 0.0) share = max(share, 1.0 - smoothstep(0.60, 0.72, dot(n, v)));
  vec3 light = mix(below, above, share);

  vec3 half_way = normalize(v + sun.xyz);
  float glint = waves.w * pow(max(dot(n, half_way), 0.0), fresnel.w) * smoothstep(0.0, 0.08, sun.y);
  if (glint > 0.001 && water.y > 0.0) light += sun_light.rgb * glint * sunlight_at(world, vec3(0.0, 1.0, 0.0));
  color = vec4(to_display(through_air(light, world)), 1.0);
}
