#version 450 core
// Values of reflectance() over level water, by angles as in probe.h.
#include "fresnel.glsl"
layout(std430, binding = 4) readonly buffer Inputs { vec4 inputs[]; };
layout(location = 0) out float value;

void main() {
  vec4 p = inputs[int(gl_FragCoord.x)];
  vec3 n = vec3(0.0, 1.0, 0.0), v = vec3(sin(p.x), cos(p.x), 0.0);
  vec3 to_sun = vec3(cos(p.y) * cos(p.z), sin(p.y), cos(p.y) * sin(p.z));
  int reading = int(p.w);
  float cosine = fresnel_cosine(reading > 2 ? 0 : reading, n, v, to_sun);
  value = reading == 3 ? cosine : reading == 4 ? 1.0 - cosine : reflectance(cosine, 0.02, 5.0);
}
