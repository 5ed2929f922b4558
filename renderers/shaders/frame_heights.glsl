// The position of a vertex of a level-of-detail frame: repeats vertex_position() of terrain/frame.cpp step by step.
// Included by the vertex shaders that draw heights; their inputs and storage are those of renderers/frame_buffers.cpp.
#include "ground_block.glsl"
layout(location = 0) in uint batch_number;

struct BatchRecord {
  int level;
  uint first_triangle;
  uint corner;  // of patches and nodes; where chunks morph, their share as the bits of a float
  uint morph;  // of patches, the seams of a morphing node, or the floor of skirts
};
struct LevelRecord {
  ivec2 corner;
  vec2 eye;
  float from, to;
  int spacing, unused;
};
layout(std430, binding = 1) readonly buffer Batches { BatchRecord batches[]; };
layout(std430, binding = 2) readonly buffer Levels { LevelRecord levels[]; };
layout(std430, binding = 3) readonly buffer Morphs { float morphs[]; };  // five per patch: inside and sides
layout(std430, binding = 4) readonly buffer ChunkVertices { uvec2 chunk_vertices[]; };  // sample, height

float between(float a, float b, float share) { return clamp(a + (b - a) * share, min(a, b), max(a, b)); }

// MorphingPatch of terrain/frame.cpp.
bool on_border(ivec2 at, ivec2 low, ivec2 high) { return any(equal(at, low)) || any(equal(at, high)); }

float on_side(BatchRecord batch, ivec2 at, ivec2 low, ivec2 high) {
  bool along_x = at.y == low.y || at.y == high.y;
  uint side_number = along_x ? (at.y == low.y ? 0u : 2u) : (at.x == low.x ? 3u : 1u);
  float target = morphs[5u * batch.morph + 1u + side_number];
  int step = 1 << int(target);
  float share = target - floor(target);
  ivec2 along = along_x ? ivec2(1, 0) : ivec2(0, 1);
  int place = along_x ? at.x : at.y, first = along_x ? low.x : low.y, end = along_x ? high.x : high.y;
  if (share <= 0.0 || place == end || ((place - first) & (2 * step - 1)) != step) return sample_at(at);
  int ahead = min(step, end - place);
  float way = float(step) / float(step + ahead);
  return between(sample_at(at), between(sample_at(at - step * along), sample_at(at + ahead * along), way),
                 share);
}

float shown(BatchRecord batch, ivec2 at, ivec2 low, ivec2 high) {
  return on_border(at, low, high) ? on_side(batch, at, low, high) : sample_at(at);
}

float morphed_height(BatchRecord batch, ivec2 at) {
  ivec2 low = ivec2(int(batch.corner) % samples.x, int(batch.corner) / samples.x);
  ivec2 high = min(low + patch_side, samples - 1);
  if (on_border(at, low, high)) return on_side(batch, at, low, high);
  int step = 1 << batch.level;
  float share = morphs[5u * batch.morph] - float(batch.level);
  ivec2 odd = (at - low) & step;
  if (share <= 0.0 || odd == ivec2(0)) return sample_at(at);
  ivec2 before = at - odd, after = min(at + odd, high);
  ivec2 place = before - low;
  bool diagonal = odd.x != 0 && odd.y != 0;
  float way = float(step) / float(odd.x != 0 ? after.x - before.x : after.y - before.y);
  if (diagonal && ((place.x ^ place.y) & (2 * step)) != 0) {
    int z = before.y;
    before.y = after.y;
    after.y = z;
  }
  float there = between(shown(batch, before, low, high), shown(batch, after, low, high), way);
  return between(sample_at(at), there, share);
}

// MorphingNode of terrain/frame.cpp.
ivec2 odd_in_node(BatchRecord batch, ivec2 at, ivec2 low, ivec2 high) {
  ivec2 odd = (at - low) & (1 << batch.level);
  return ivec2(at.x == high.x ? 0 : odd.x, at.y == high.y ? 0 : odd.y);
}

ivec2 place_in_node(BatchRecord batch, ivec2 vertex, ivec2 low, ivec2 high) {
  ivec2 odd = odd_in_node(batch, vertex, low, high), before = vertex - odd, after = min(vertex + odd, high);
  if (vertex.y == low.y && (batch.morph & 1u) != 0u) return before;
  if (vertex.y == high.y && (batch.morph & 4u) != 0u) return after;
  if (vertex.x == low.x && (batch.morph & 8u) != 0u) return before;
  if (vertex.x == high.x && (batch.morph & 2u) != 0u) return after;
  return vertex;
}

float coarser(BatchRecord batch, ivec2 at, ivec2 low, ivec2 high) {
  ivec2 odd = odd_in_node(batch, at, low, high), before = at - odd, after = min(at + odd, high);
  if (odd == ivec2(0)) return sample_at(at);
  vec2 way = vec2(at - before) / vec2(max(after - before, 1));
  float south_west = sample_at(ivec2(before.x, after.y)), north_east = sample_at(ivec2(after.x, before.y));
  if (odd.x == 0) return between(north_east, south_west, way.y);
  if (odd.y == 0) return between(south_west, north_east, way.x);
  float diagonal = between(south_west, north_east, (1.0 - way.y) / (2.0 - way.x - way.y));
  return between(diagonal, sample_at(after), way.x + way.y - 1.0);
}

vec3 node_position(BatchRecord batch, ivec2 vertex) {
  ivec2 low = ivec2(int(batch.corner) % samples.x, int(batch.corner) / samples.x);
  ivec2 high = min(low + (patch_side << batch.level), samples - 1);
  ivec2 at = place_in_node(batch, vertex, low, high);
  vec3 position = vec3(float(at.x) * cell.x, sample_at(at), float(at.y) * cell.y);
  LevelRecord level = levels[batch.level];
  float share = level.from < level.to
                    ? clamp((distance(morph_eye, position) - level.from) / (level.to - level.from), 0.0, 1.0)
                    : 0.0;
  if (share > 0.0) position.y = between(position.y, coarser(batch, at, low, high), share);
  return position;
}

vec3 grid_position(BatchRecord batch) {
  int count = samples.x * samples.y;
  bool moves = gl_VertexID >= 2 * count, on_floor = !moves && gl_VertexID >= count;
  int vertex = moves      ? int(chunk_vertices[gl_VertexID - 2 * count].x)
               : on_floor ? gl_VertexID - count
                          : gl_VertexID;
  ivec2 at = ivec2(vertex % samples.x, vertex / samples.x);
  if (morph_ranges > 0) return node_position(batch, at);
  float y = moves ? between(heights[vertex], uintBitsToFloat(chunk_vertices[gl_VertexID - 2 * count].y),
                            uintBitsToFloat(batch.corner))
            : on_floor        ? uintBitsToFloat(batch.morph)
            : patch_side == 0 ? heights[vertex]
                              : morphed_height(batch, at);
  return vec3(float(at.x) * cell.x, y, float(at.y) * cell.y);
}

float clip_height(int level, ivec2 at) {
  at &= side - 1;
  return heights[(level * side + at.y) * side + at.x];
}

// The two samples of the coarser level beside one of this level, along one axis.
ivec2 ends(int at, int spacing, int begin, int end) {
  int odd = at & 1;
  ivec2 two = ivec2(at - odd, at + odd) / 2;
  if (at * spacing >= end) two.x = two.y;
  if (at * spacing <= begin) two.y = two.x;
  return two;
}

vec3 clip_position(BatchRecord batch) {
  LevelRecord level = levels[batch.level];
  ivec2 inside = ivec2(gl_VertexID % side, gl_VertexID / side), at = level.corner + inside;
  float y = clip_height(batch.level, at);
  if (level.from < level.to) {
    vec2 away = abs(vec2(inside) - level.eye);
    float weight = clamp((max(away.x, away.y) - level.from) / (level.to - level.from), 0.0, 1.0);
    if (weight > 0.0) {
      ivec2 x = ends(at.x, level.spacing, first.x, last.x), z = ends(at.y, level.spacing, first.y, last.y);
      float there = 0.5 * (clip_height(batch.level + 1, ivec2(x[0], z[1])) +
                           clip_height(batch.level + 1, ivec2(x[1], z[0])));
      y = mix(y, there, weight);
    }
  }
  ivec2 place = clamp(at * level.spacing, first, last) - origin;
  return vec3(float(place.x) * cell.x, y, float(place.y) * cell.y);
}

vec3 frame_position(BatchRecord batch) { return side == 0 ? grid_position(batch) : clip_position(batch); }
