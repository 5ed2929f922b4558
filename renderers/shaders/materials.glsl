// Texture splatting (hybrid paper, §4.1): a material by height band, rock on steep ground. Textures are layers of
// tone, bump slopes along the texture's two axes and patches (renderers/landscape/textures.h). Follows scene.glsl
// and ground_slope.glsl.
layout(binding = 0) uniform sampler2DArray material_maps;

const int kRock = 3, kSnow = 4;

struct Surface {
  vec3 albedo;
  vec3 bump;  // gradient of the bumps' height, per metre
};

// A layer over a plane, at three of the sizes 1, 7.3, 53, … widths, turned against each other so that no repetition
// shows: those that are neither finer than a pixel nor wider than the picture. `texels`: how many of the layer's a
// pixel covers. Returns tone, bump slopes and patches.
vec4 tile(int layer, vec2 p, float texels) {
  const float kTimes = 0.137;
  float sizes = max(0.34883 * (log2(max(texels, 1e-6)) - 1.0), 0.0);
  int finest = int(sizes);
  float next = sizes - float(finest);
  vec3 shares = vec3(1.0 - next, 1.0, next);
  vec4 sum = vec4(0.0);
  for (int k = 0; k < 3; ++k) {
    float octave = float(finest + k), scale = pow(kTimes, octave), angle = 0.63 * octave;
    mat2 turn = mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
    vec4 texel = textureLod(material_maps, vec3(turn * p * scale + 0.31 * octave, layer),
                            log2(max(texels * scale, 1e-6))) - 0.5;
    texel.yz = transpose(turn) * texel.yz;
    sum += shares[k] * texel;
  }
  return vec4(0.5 + 1.15 * sum.x, 3.0 * sum.yz, 0.5 + 0.9 * sum.w);
}

// Texels per pixel over a plane in which a pixel's sides are these: between the longer side, which would blur
// ground seen at a flat angle, and the shorter, which would let it flicker.
float texels_of(vec2 dx, vec2 dy) {
  float a = length(dx), b = length(dy);
  return 512.0 * sqrt(max(a, b) * max(min(a, b), 0.125 * max(a, b)));
}

vec3 colour_of(int layer, vec4 texel) {
  float tone = clamp(0.65 * texel.x + 0.35 * texel.w, 0.0, 1.0);
  return mix(materials[2 * layer].rgb, materials[2 * layer + 1].rgb, tone);
}

Surface flat_surface(int layer, vec2 p, vec2 dx, vec2 dy) {
  vec4 texel = tile(layer, p, texels_of(dx, dy));
  return Surface(colour_of(layer, texel), vec3(texel.y, 0.0, texel.z));
}

// Projected along the axis that the ground faces, blended between the three.
Surface triplanar_surface(int layer, vec3 p, vec3 dx, vec3 dy, vec3 n) {
  vec3 share = pow(abs(n), vec3(6.0));
  share /= share.x + share.y + share.z;
  Surface all = Surface(vec3(0.0), vec3(0.0));
  if (share.x > 0.02) {
    vec4 texel = tile(layer, p.zy, texels_of(dx.zy, dy.zy));
    all.albedo += share.x * colour_of(layer, texel);
    all.bump += share.x * vec3(0.0, texel.z, texel.y);
  }
  if (share.y > 0.02) {
    vec4 texel = tile(layer, p.xz, texels_of(dx.xz, dy.xz));
    all.albedo += share.y * colour_of(layer, texel);
    all.bump += share.y * vec3(texel.y, 0.0, texel.z);
  }
  if (share.z > 0.02) {
    vec4 texel = tile(layer, p.xy, texels_of(dx.xy, dy.xy));
    all.albedo += share.z * colour_of(layer, texel);
    all.bump += share.z * vec3(texel.y, texel.z, 0.0);
  }
  float used = dot(share, vec3(greaterThan(share, vec3(0.02))));
  return Surface(all.albedo / used, all.bump / used);
}

void add(inout Surface sum, Surface one, float share) {
  sum.albedo += share * one.albedo;
  sum.bump += share * one.bump;
}

Surface surface_at(vec3 world, vec3 n) {
  vec3 p = world / ground.w, dx = dFdx(p), dy = dFdy(p);
  // Borders between bands wander with the noise.
  const float kWander = 1.5;
  float wander = textureLod(material_maps, vec3(p.xz * 0.037, 1.0), 3.0).a - 0.5 +
                 0.6 * (textureLod(material_maps, vec3(p.zx * 0.21, 3.0), 2.0).r - 0.5);
  float height = world.y + kWander * wander * ground.x;
  float angle = slope_degrees(n.y, ground_modes.x > 0.5) + 14.0 * wander;
  float steep = smoothstep(ground.y - ground.z, ground.y + ground.z, angle);

  float shares[5];
  float left = 1.0 - steep;
  for (int band = 0; band < 4; ++band) {
    float below = 1.0 - smoothstep(band_tops[band] - 0.5 * ground.x, band_tops[band] + 0.5 * ground.x, height);
    shares[band] = left * below;
    left -= shares[band];
  }
  shares[kSnow] = left;
  shares[kRock] += steep;

  Surface sum = Surface(vec3(0.0), vec3(0.0));
  float used = 0.0;
  for (int layer = 0; layer < 5; ++layer) {
    if (shares[layer] < 0.01) continue;
    if (ground_modes.y > 0.5) {
      add(sum, triplanar_surface(layer, p, dx, dy, n), shares[layer]);
    } else {
      add(sum, flat_surface(layer, p.xz, dx.xz, dy.xz), shares[layer]);
    }
    used += shares[layer];
  }
  return Surface(sum.albedo / used, sum.bump / used);
}
