#version 450 core
// The sky behind everything.
#include "scene.glsl"
#include "display.glsl"
#include "sky_blend.glsl"
#include "atmosphere.glsl"
in vec2 at;

uniform bool shown;  // in the picture, not in a pass that others read

layout(location = 0) out vec4 color;

void main() {
  vec4 far = clip_to_world * vec4(at, 0.5, 1.0);
  vec3 d = normalize(far.xyz / far.w - eye.xyz);
  vec3 light = water.z > 0.5 ? through_water(vec3(0.0), 1e9) : sky_towards(d);
  color = vec4(shown ? to_display(light) : light, 1.0);
}
