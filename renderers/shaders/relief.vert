#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float curvature;

uniform mat4 world_to_clip;

out vec3 world;
out vec3 world_normal;
out float bend;

void main() {
  world = position;
  world_normal = normal;
  bend = curvature;
  gl_Position = world_to_clip * vec4(position, 1.0);
}
