#version 450 core
// Values of sky_share().
#include "sky_blend.glsl"
layout(std430, binding = 4) readonly buffer Inputs { vec4 inputs[]; };
layout(location = 0) out float value;

void main() {
  value = sky_share(inputs[int(gl_FragCoord.x)].x);
}
