// Follows scene.glsl, in fragment shaders.

// Linear light to the display's, rounded with a dither of one step, so that skies have no bands.
vec3 to_display(vec3 linear) {
  const float kKnee = 0.72;  // above it, light is compressed towards 1
  vec3 over = max(linear - kKnee, 0.0);
  linear = min(linear, kKnee) + (1.0 - kKnee) * (1.0 - exp(-over / (1.0 - kKnee)));
  vec3 srgb = mix(12.92 * linear, 1.055 * pow(max(linear, 0.0), vec3(1.0 / 2.4)) - 0.055,
                  greaterThan(linear, vec3(0.0031308)));
  uvec2 at = uvec2(gl_FragCoord.xy);
  uint hash = (at.x * 1664525u + at.y * 1013904223u) ^ 0x9e3779b9u;
  hash = (hash ^ (hash >> 15)) * 0x2c1b3c6du;
  hash = (hash ^ (hash >> 12)) * 0x297a2d39u;
  hash ^= hash >> 15;
  float first = float(hash & 0xffffu) / 65536.0, second = float(hash >> 16) / 65536.0;
  return srgb + (first - second) / 255.0;
}
