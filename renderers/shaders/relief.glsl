// Shaded relief. Macros of the including shader, which leave out what its picture does not need:
//   BY_HEIGHT  facets coloured by height, without wires
//   BY_PLAN    facets coloured by `paint`
in Vertex {
#include "vertex_members.glsl"
} vertex;

uniform sampler1D ramp;        // linear light
uniform vec2 height_range;     // metres at the ramp's ends
uniform vec3 sun;              // unit length, towards the light
uniform vec3 eye;
uniform float exaggeration;    // of slopes, for the light only
#if !defined(BY_HEIGHT) && !defined(BY_PLAN)
uniform bool facets;           // the mesh has no normals
#endif
uniform bool painted;          // vertex.paint holds sRGB
uniform bool flat_fill;        // no light: all one colour, for hidden-line drawings
uniform vec3 fill_color;       // sRGB
uniform vec4 wire_ink;         // sRGB and opacity

#ifdef BY_PLAN
layout(binding = 2) uniform sampler2D paint;  // sRGB
uniform vec2 paint_scale, paint_offset;       // of x and z in metres to the texture
#endif

out vec4 color;

const float kAmbient = 0.30;
const float kFill = 0.3;                       // from the viewer, on steep ground: gives walls and caves in shade form
const vec3 kSky = vec3(0.86, 0.93, 1.0);       // tint of shadows
const vec3 kBack = vec3(0.30, 0.29, 0.28);     // backs of triangles, visible where a mesh is open

vec3 to_srgb(vec3 linear) {
  return mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, greaterThan(linear, vec3(0.0031308)));
}

vec3 to_linear(vec3 srgb) {
  return mix(srgb / 12.92, pow((srgb + 0.055) / 1.055, vec3(2.4)), greaterThan(srgb, vec3(0.04045)));
}

vec3 ramp_color() {
  // The ends of the range are at texel centres.
  float size = float(textureSize(ramp, 0));
  float t = clamp((vertex.world.y - height_range.x) / (height_range.y - height_range.x), 0.0, 1.0);
  return texture(ramp, (t * (size - 1.0) + 0.5) / size).rgb;
}

// Linear light.
vec3 albedo() {
#if defined(BY_PLAN)
  return to_linear(texture(paint, vertex.world.xz * paint_scale + paint_offset).rgb);
#elif defined(BY_HEIGHT)
  return gl_FrontFacing ? ramp_color() : kBack;
#else
  return painted ? to_linear(vertex.paint) : gl_FrontFacing ? ramp_color() : kBack;
#endif
}

// The normal on the visible side.
vec3 surface_normal() {
  vec3 n;
#if defined(BY_HEIGHT) || defined(BY_PLAN)
  const bool facets = true;
#endif
  if (facets) {
    n = cross(dFdx(vertex.world), dFdy(vertex.world));
    n = dot(n, eye - vertex.world) < 0.0 ? -n : n;
  } else {
    n = gl_FrontFacing ? vertex.normal : -vertex.normal;
  }
  return normalize(vec3(n.x * exaggeration, n.y, n.z * exaggeration));
}

vec3 lit_color() {
  vec3 base = albedo();

  // Light of sun and sky, relative to level ground.
  vec3 n = surface_normal();
  float sky = kAmbient * (0.5 + 0.5 * n.y);
  float direct = (1.0 - kAmbient) * max(dot(n, sun), 0.0) / max(sun.y, 0.3);
  float fill = kFill * (1.0 - abs(n.y)) * max(dot(n, normalize(eye - vertex.world)), 0.0);
  float light = (sky + direct + fill) * (1.0 + vertex.bend);
  vec3 tint = mix(kSky, vec3(1.0), min(light, 1.0));
  // Slopes towards the sun approach white without clipping, and dark colours keep their hue.
  vec3 lit = light <= 1.0 ? base * light * tint : 1.0 - pow(1.0 - base, vec3(light));
  return to_srgb(clamp(lit, 0.0, 1.0));
}

// The share of the pixel that the nearest wire covers.
float wire_cover() {
  vec3 cover = vertex.strength * clamp(vertex.reach + 0.5 - vertex.to_edge, 0.0, 1.0);
  return max(cover.x, max(cover.y, cover.z));
}

void main() {
#ifdef BY_HEIGHT
  color = vec4(lit_color(), 1.0);
#else
  vec3 surface = flat_fill ? fill_color : lit_color();
  color = vec4(mix(surface, wire_ink.rgb, wire_ink.a * wire_cover()), 1.0);
#endif
}
