#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float curvature;
layout(location = 3) in vec3 paint;

uniform mat4 world_to_clip;

out Vertex {
  vec3 world;
  vec3 normal;
  vec3 paint;
  float bend;
  noperspective vec3 to_edge;
  flat vec3 strength;
  flat vec3 reach;
} vertex;

void main() {
  vertex.world = position;
  vertex.normal = normal;
  vertex.paint = paint;
  vertex.bend = curvature;
  vertex.to_edge = vec3(0.0);  // no wires, unless wire.geom comes next
  vertex.strength = vec3(0.0);
  vertex.reach = vec3(0.0);
  gl_Position = world_to_clip * vec4(position, 1.0);
}
