#version 450 core
#include "grass_look.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;

out vec3 world;
out vec3 facing;

void main() {
  world = position;
  facing = normal;
  gl_ClipDistance[0] = dot(look.clip_plane, vec4(position, 1.0));
  gl_Position = look.world_to_clip * vec4(position, 1.0);
}
