#version 450 core
// Where a vertex of a level-of-detail frame stands: vertex_position() of terrain/frame.cpp, step for step.
layout(location = 0) in uint batch_number;

struct BatchRecord {
  int level;
  uint first_triangle;
};
struct LevelRecord {
  ivec2 corner;
  vec2 eye;
  float from, to;
  int spacing, unused;
};
layout(std430, binding = 0) readonly buffer Heights { float heights[]; };
layout(std430, binding = 1) readonly buffer Batches { BatchRecord batches[]; };
layout(std430, binding = 2) readonly buffer Levels { LevelRecord levels[]; };

uniform mat4 world_to_clip;
uniform ivec2 samples;  // of the grid
uniform vec2 cell;      // metres
uniform int side;       // of the clip levels; 0 over a grid
uniform ivec2 last;     // sample of the full terrain, of clip levels

out Vertex {
  vec3 world;
  vec3 normal;
  vec3 paint;
  float bend;
  noperspective vec3 to_edge;
  flat vec3 strength;
  flat vec3 reach;
} vertex;
flat out uint first_triangle;

vec3 grid_position() {
  ivec2 at = ivec2(gl_VertexID % samples.x, gl_VertexID / samples.x);
  return vec3(float(at.x) * cell.x, heights[gl_VertexID], float(at.y) * cell.y);
}

float clip_height(int level, ivec2 at) {
  at &= side - 1;
  return heights[(level * side + at.y) * side + at.x];
}

// The two samples of the coarser level beside one of this level, along one axis.
ivec2 ends(int at, int spacing, int end) {
  int odd = at & 1;
  ivec2 two = ivec2(at - odd, at + odd) / 2;
  if (at * spacing >= end) two.x = two.y;
  if (at * spacing <= 0) two.y = two.x;
  return two;
}

vec3 clip_position(BatchRecord batch) {
  LevelRecord level = levels[batch.level];
  ivec2 at = level.corner + ivec2(gl_VertexID % side, gl_VertexID / side);
  float y = clip_height(batch.level, at);
  if (level.from < level.to) {
    vec2 away = abs(vec2(at) - level.eye);
    float weight = clamp((max(away.x, away.y) - level.from) / (level.to - level.from), 0.0, 1.0);
    if (weight > 0.0) {
      ivec2 x = ends(at.x, level.spacing, last.x), z = ends(at.y, level.spacing, last.y);
      float there = 0.5 * (clip_height(batch.level + 1, ivec2(x[0], z[1])) +
                           clip_height(batch.level + 1, ivec2(x[1], z[0])));
      y = mix(y, there, weight);
    }
  }
  ivec2 place = clamp(at * level.spacing, ivec2(0), last);
  return vec3(float(place.x) * cell.x, y, float(place.y) * cell.y);
}

void main() {
  BatchRecord batch = batches[batch_number];
  vertex.world = side == 0 ? grid_position() : clip_position(batch);
  vertex.normal = vec3(0.0, 1.0, 0.0);
  vertex.paint = vec3(0.0);
  vertex.bend = 0.0;
  vertex.to_edge = vec3(0.0);
  vertex.strength = vec3(0.0);
  vertex.reach = vec3(0.0);
  first_triangle = batch.first_triangle;
  gl_Position = world_to_clip * vec4(vertex.world, 1.0);
}
