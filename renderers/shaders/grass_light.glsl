#include "grass_look.glsl"
// The air between the eye and a point: light l from there arrives as rgb + a · l.
vec4 air_before(vec3 world) {
  vec3 ray = world - look.eye.xyz;
  float far = length(ray);
  float towards_sun = pow(max(dot(ray / max(far, 1e-6), look.sun.xyz), 0.0), 8.0);
  vec3 fog = mix(look.fog_colour.rgb, look.fog_sun_colour.rgb, towards_sun);
  float clear = exp(-look.fog_colour.a * far);
  return vec4(fog * (1.0 - clear), clear);
}

// Linear light as the picture wants it.
vec3 finished(vec3 linear) {
  if (look.sun.w > 0.5) return linear;
  linear = clamp(linear, 0.0, 1.0);
  return mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, greaterThan(linear, vec3(0.0031308)));
}
