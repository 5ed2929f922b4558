#include "grass_look.glsl"
vec4 grass_finished(vec3 linear, vec3 world, float alpha) {
  vec3 ray = world - look.eye.xyz;
  float far = length(ray);
  float towards_sun = pow(max(dot(ray / max(far, 1e-6), look.sun.xyz), 0.0), 8.0);
  vec3 fog = mix(look.fog_colour.rgb, look.fog_sun_colour.rgb, towards_sun);
  linear = mix(fog, linear, exp(-look.fog_colour.a * far));
  if (look.sun.w > 0.5) return vec4(linear, alpha);
  linear = clamp(linear, 0.0, 1.0);
  vec3 srgb = mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055,
                  greaterThan(linear, vec3(0.0031308)));
  return vec4(srgb, alpha);
}
