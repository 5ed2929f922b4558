#version 450 core
#include "grass_light.glsl"
in vec3 world;
in vec3 facing;

layout(location = 0) out vec4 color;

const vec3 kSoil = vec3(0.10, 0.085, 0.04), kRock = vec3(0.24, 0.21, 0.18);  // linear light

void main() {
  vec3 normal = normalize(gl_FrontFacing ? facing : -facing);
  vec3 ground = mix(kRock, kSoil, smoothstep(0.60, 0.85, normal.y));
  vec3 light = look.sky_colour.rgb * (0.5 + 0.5 * normal.y) +
               look.sun_colour.rgb * max(dot(normal, look.sun.xyz), 0.0);
  vec4 air = air_before(world);
  color = vec4(finished(air.rgb + air.a * ground * light), 1.0);
}
