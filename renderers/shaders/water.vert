#version 450 core
// The water's surface: one square around the eye, at the water's level.
#include "scene.glsl"
uniform float reach;  // metres from the eye

out vec3 world;

void main() {
  vec2 corner = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID >> 1) * 2 - 1);
  world = vec3(eye.x + reach * corner.x, water.x, eye.z + reach * corner.y);
  gl_Position = world_to_clip * vec4(world, 1.0);
}
