// A strand's two crossed billboards: eight corners, four per billboard.
out Blade {
  vec3 world;
  vec2 at;         // in the texture: x across, y up
  flat vec3 up;
  flat float layer;
  flat float random;
} blade;

const float kLayers = 4.0;  // of the texture

vec3 bend(Strand strand) {
  float phase = 1.7 * look.eye.w + dot(strand.root.xz, vec2(0.31, 0.23)) + 0.8 * strand.random;
  float gust = 0.6 + 0.3 * sin(phase) + 0.1 * sin(3.7 * phase);
  return vec3(look.wind.x, 0.0, look.wind.y) * gust * strand.height;
}

void set_corner(Strand strand, uint corner) {
  uint billboard = corner >> 2;
  float across = float(corner & 1u), up = float(corner >> 1 & 1u);
  vec3 side = billboard == 0u ? strand.side : normalize(cross(strand.up, strand.side));
  vec3 world = strand.root + side * (across - 0.5) * strand.width + strand.up * up * strand.height;
  world += bend(strand) * up * up;
  blade.world = world;
  blade.at = vec2(across, up);
  blade.up = strand.up;
  blade.layer = mod(floor(strand.random * kLayers) + float(billboard), kLayers);
  blade.random = strand.random;
  gl_ClipDistance[0] = dot(look.clip_plane, vec4(world, 1.0));
  gl_Position = look.world_to_clip * vec4(world, 1.0);
}
