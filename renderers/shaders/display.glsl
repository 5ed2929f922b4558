// Follows scene.glsl, in fragment shaders.

// Linear light to the display's.
vec3 to_display(vec3 linear) {
  const float kKnee = 0.72;  // above it, light is compressed towards 1
  vec3 over = max(linear - kKnee, 0.0);
  linear = min(linear, kKnee) + (1.0 - kKnee) * (1.0 - exp(-over / (1.0 - kKnee)));
  return mix(12.92 * linear, 1.055 * pow(max(linear, 0.0), vec3(1.0 / 2.4)) - 0.055,
             greaterThan(linear, vec3(0.0031308)));
}
