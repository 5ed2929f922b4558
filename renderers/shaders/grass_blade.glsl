// A strand's two crossed billboards: eight corners, four per billboard. Light and air are those of the strand's root.
#include "grass_light.glsl"
out Blade {
  vec2 at;          // in the texture: x across, y up
  flat vec3 light;  // linear; what arrives at the eye from white
  flat vec3 air;    // and what the air adds to it
  flat vec2 layer_random;
} blade;

const float kLayers = 4.0;  // of the texture

vec3 bend(Strand strand) {
  float phase = 1.7 * look.eye.w + dot(strand.root.xz, vec2(0.31, 0.23)) + 0.8 * strand.random;
  float gust = 0.6 + 0.3 * sin(phase) + 0.1 * sin(3.7 * phase);
  return vec3(look.wind.x, 0.0, look.wind.y) * gust * strand.height;
}

struct Bush {  // a strand as its corners need it
  vec3 root, up, side, across, bend, light, air;
  float random;
};

Bush bush_of(Strand strand) {
  // Grass takes the light of the ground that it grows on.
  float direct = 0.25 + 0.75 * max(dot(strand.up, look.sun.xyz), 0.0);
  vec3 light = look.sky_colour.rgb * (0.5 + 0.5 * strand.up.y) + look.sun_colour.rgb * direct;
  vec4 air = air_before(strand.root);
  return Bush(strand.root, strand.up * strand.height, strand.side * strand.width,
              normalize(cross(strand.up, strand.side)) * strand.width, bend(strand),
              light * (0.8 + 0.4 * fract(strand.random * 7.0)) * air.a, air.rgb, strand.random);
}

void set_corner(Bush bush, uint corner) {
  uint billboard = corner >> 2;
  float across = float(corner & 1u), up = float(corner >> 1 & 1u);
  vec3 world = bush.root + (billboard == 0u ? bush.side : bush.across) * (across - 0.5) + bush.up * up + bush.bend * up;
  blade.at = vec2(across, up);
  blade.light = bush.light;
  blade.air = bush.air;
  blade.layer_random = vec2(mod(floor(bush.random * kLayers) + float(billboard), kLayers), bush.random);
  gl_ClipDistance[0] = dot(look.clip_plane, vec4(world, 1.0));
  gl_Position = look.world_to_clip * vec4(world, 1.0);
}
