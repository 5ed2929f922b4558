#version 450 core
// Values of slope_degrees().
#include "ground_slope.glsl"
layout(std430, binding = 4) readonly buffer Inputs { vec4 inputs[]; };
layout(location = 0) out float value;

void main() {
  vec4 p = inputs[int(gl_FragCoord.x)];
  value = slope_degrees(p.x, p.y > 0.5);
}
