#version 450 core
in vec3 world;
in vec3 world_normal;
in float bend;

uniform sampler1D ramp;        // linear light
uniform vec2 height_range;     // metres at the ramp's ends
uniform vec3 sun;              // unit length, towards the light
uniform vec3 eye;
uniform float exaggeration;    // of slopes, for the light only
uniform bool facets;           // the mesh has no normals
uniform bool edges;            // this draws the wireframe

out vec4 color;

const float kAmbient = 0.30;
const float kFill = 0.3;                       // from the viewer, on steep ground: walls and caves in shade keep form
const vec3 kSky = vec3(0.86, 0.93, 1.0);       // what shadows are tinted with
const vec3 kBack = vec3(0.30, 0.29, 0.28);     // the inside of a mesh, seen where it is open
const vec3 kEdge = vec3(0.05, 0.05, 0.06);

vec3 to_srgb(vec3 linear) {
  return mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, greaterThan(linear, vec3(0.0031308)));
}

// Which way the surface faces, on the side that is seen.
vec3 surface_normal() {
  vec3 n;
  if (facets) {
    n = cross(dFdx(world), dFdy(world));
    n = dot(n, eye - world) < 0.0 ? -n : n;
  } else {
    n = gl_FrontFacing ? world_normal : -world_normal;
  }
  return normalize(vec3(n.x * exaggeration, n.y, n.z * exaggeration));
}

void main() {
  if (edges) {
    color = vec4(to_srgb(kEdge), 0.55);
    return;
  }
  // Texel centres stand at the ends of the range.
  float size = float(textureSize(ramp, 0));
  float t = clamp((world.y - height_range.x) / (height_range.y - height_range.x), 0.0, 1.0);
  vec3 albedo = gl_FrontFacing ? texture(ramp, (t * (size - 1.0) + 0.5) / size).rgb : kBack;

  // Sun and sky, in units of what level ground receives.
  vec3 n = surface_normal();
  float sky = kAmbient * (0.5 + 0.5 * n.y);
  float direct = (1.0 - kAmbient) * max(dot(n, sun), 0.0) / max(sun.y, 0.3);
  float fill = kFill * (1.0 - abs(n.y)) * max(dot(n, normalize(eye - world)), 0.0);
  float light = (sky + direct + fill) * (1.0 + bend);
  vec3 tint = mix(kSky, vec3(1.0), min(light, 1.0));
  // Slopes towards the sun near white without being cut off there, and dark colours keep their hue.
  vec3 lit = light <= 1.0 ? albedo * light * tint : 1.0 - pow(1.0 - albedo, vec3(light));
  color = vec4(to_srgb(clamp(lit, 0.0, 1.0)), 1.0);
}
