// The triangles that grass grows on, in buffers.
#include "grass_strand.glsl"

struct GroundVertex {
  float position[3];
  float normal[3];
};
layout(std430, binding = 0) readonly buffer Vertices { GroundVertex vertices[]; };
// Three corners, and the number of the triangle's first strand among all; one more at the end.
layout(std430, binding = 1) readonly buffer Triangles { uvec4 triangles[]; };

Corner corner_at(uint vertex) {
  GroundVertex at = vertices[vertex];
  return Corner(vec3(at.position[0], at.position[1], at.position[2]), vec3(at.normal[0], at.normal[1], at.normal[2]));
}
