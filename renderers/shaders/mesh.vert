#version 450 core
#include "lit_vertex.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float curvature;
layout(location = 3) in vec3 paint;

void main() { write_vertex(position, normal, paint, curvature); }
