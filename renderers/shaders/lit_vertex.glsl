// A vertex as relief.frag reads it.
uniform mat4 world_to_clip;

out Vertex {
#include "vertex_members.glsl"
} vertex;

void write_vertex(vec3 world, vec3 normal, vec3 paint, float bend) {
  vertex.world = world;
  vertex.normal = normal;
  vertex.paint = paint;
  vertex.bend = bend;
  vertex.to_edge = vec3(0.0);  // no wires, unless wire.geom comes next
  vertex.strength = vec3(0.0);
  vertex.reach = vec3(0.0);
  gl_Position = world_to_clip * vec4(world, 1.0);
}
