#version 450 core
// Gives each fragment its distance in pixels to the three edges of its triangle. Lines so have a constant width on
// the screen and lie in the surface itself, and hidden lines are hidden without a depth comparison of their own.
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

uniform vec2 pixels;          // width and height of the picture
uniform usamplerBuffer drawn; // edges to draw, per triangle: bit k for the edge from corner k to the next;
                              // bit k + 3: it is an outline, of which the neighbour does not draw a half
uniform int first_triangle;   // of this draw call
uniform bool all_edges;       // ignore `drawn`
uniform float wire_width;     // pixels
uniform vec2 size_cell;       // metres; triangles are coloured by their size in such cells; 0: they are not
uniform vec3 size_colours[8]; // sRGB: of triangles that are half a square of 1, 2, 4, … cells

in Vertex {
#include "vertex_members.glsl"
} corner[];

out Vertex {
#include "vertex_members.glsl"
} vertex;

// Lines closer together than two widths fade, so that far ground does not become solid ink.
float strength(float spacing) { return clamp(spacing / (2.0 * wire_width), 0.0, 1.0); }

vec3 size_colour() {
  vec2 a = (corner[1].world.xz - corner[0].world.xz) / size_cell;
  vec2 b = (corner[2].world.xz - corner[0].world.xz) / size_cell;
  float octave = clamp(0.5 * log2(max(abs(a.x * b.y - a.y * b.x), 1.0)), 0.0, 7.0);
  int finer = min(int(octave), 6);
  return mix(size_colours[finer], size_colours[finer + 1], octave - float(finer));
}

void main() {
  vec2 at[3];
  bool on_screen = true;  // a triangle that extends behind the eye has no screen position and gets no wires
  for (int k = 0; k < 3; ++k) {
    float w = gl_in[k].gl_Position.w;
    on_screen = on_screen && w > 0.0;
    at[k] = 0.5 * pixels * gl_in[k].gl_Position.xy / w;
  }
  uint mask = !on_screen || wire_width <= 0.0 ? 0u : all_edges ? 7u : texelFetch(drawn, gl_PrimitiveIDIn + first_triangle).r;
  vec2 a = at[1] - at[0], b = at[2] - at[0];
  float area = abs(a.x * b.y - a.y * b.x);
  vec3 height = vec3(0.0), ink = vec3(0.0), reach = vec3(0.5 * wire_width);
  for (int k = 0; k < 3; ++k) {
    float side = length(at[(k + 1) % 3] - at[k]);
    if ((mask >> k & 1u) == 0u || side <= 0.0) continue;
    height[k] = area / side;
    ink[k] = strength(height[k]);
    if ((mask >> (k + 3) & 1u) != 0u) reach[k] = wire_width;
  }
  for (int k = 0; k < 3; ++k) {
    vertex.world = corner[k].world;
    vertex.normal = corner[k].normal;
    vertex.paint = size_cell.x > 0.0 ? size_colour() : corner[k].paint;
    vertex.bend = corner[k].bend;
    vertex.to_edge = vec3(0.0);
    vertex.to_edge[(k + 1) % 3] = height[(k + 1) % 3];  // the edge across from corner k
    vertex.strength = ink;
    vertex.reach = reach;
    gl_Position = gl_in[k].gl_Position;
    EmitVertex();
  }
  EndPrimitive();
}
