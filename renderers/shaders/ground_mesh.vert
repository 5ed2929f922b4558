#version 450 core
// A vertex of a frame's mesh.
#include "scene.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 position_normal;

out vec3 world, normal;
invariant gl_Position;

void main() {
  world = position;
  normal = position_normal;
  gl_Position = world_to_clip * vec4(world, 1.0);
  gl_ClipDistance[0] = dot(clip_plane, vec4(world, 1.0));
}
