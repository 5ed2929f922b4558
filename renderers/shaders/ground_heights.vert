#version 450 core
// A vertex of a frame's heights with the slope of the ground.
#include "scene.glsl"
#include "frame_heights.glsl"
out vec3 world, normal;
invariant gl_Position;

vec2 grid_slope(ivec2 at) {
  ivec2 low = max(at - 1, 0), high = min(at + 1, samples - 1);
  return vec2(sample_at(ivec2(high.x, at.y)) - sample_at(ivec2(low.x, at.y)),
              sample_at(ivec2(at.x, high.y)) - sample_at(ivec2(at.x, low.y))) /
         (vec2(max(high - low, 1)) * cell);
}

// Samples beyond the ground equal those of its border.
vec2 clip_slope(int level, ivec2 at) {
  float wide = 2.0 * float(levels[level].spacing);
  return vec2(clip_height(level, at + ivec2(1, 0)) - clip_height(level, at - ivec2(1, 0)),
              clip_height(level, at + ivec2(0, 1)) - clip_height(level, at - ivec2(0, 1))) /
         (wide * cell);
}

// Blended like the height in clip_position(): at the outer end of the transition only samples of the coarser
// level are read, since those beside this level's window are not there.
vec2 clip_slope(BatchRecord batch) {
  LevelRecord level = levels[batch.level];
  ivec2 inside = ivec2(gl_VertexID % side, gl_VertexID / side), at = level.corner + inside;
  float weight = 0.0;
  vec2 coarse = vec2(0.0);
  if (level.from < level.to) {
    vec2 away = abs(vec2(inside) - level.eye);
    weight = clamp((max(away.x, away.y) - level.from) / (level.to - level.from), 0.0, 1.0);
    if (weight > 0.0) {
      ivec2 x = ends(at.x, level.spacing, first.x, last.x), z = ends(at.y, level.spacing, first.y, last.y);
      coarse = 0.5 * (clip_slope(batch.level + 1, ivec2(x[0], z[1])) +
                      clip_slope(batch.level + 1, ivec2(x[1], z[0])));
    }
  }
  return weight < 1.0 ? mix(clip_slope(batch.level, at), coarse, weight) : coarse;
}

void main() {
  BatchRecord batch = batches[batch_number];
  world = frame_position(batch);
  vec2 slope = side == 0 ? grid_slope(ivec2(round(world.xz / cell))) : clip_slope(batch);
  normal = normalize(vec3(-slope.x, 1.0, -slope.y));
  gl_Position = world_to_clip * vec4(world, 1.0);
  gl_ClipDistance[0] = dot(clip_plane, vec4(world, 1.0));
}
