// Cast shadows: the share of sunlight at a point. Follows scene.glsl.
layout(binding = 6) uniform sampler2DArrayShadow shadow_maps;

float sunlight_at(vec3 world, vec3 n) {
  if (shadow_texel.w < 0.5) return 1.0;
  for (int cascade = 0; cascade < 3; ++cascade) {
    float texel = shadow_texel[cascade];
    // Beside the surface by about a texel, or it would shade itself.
    vec3 p = world + n * texel * 1.6 + sun.xyz * texel * 0.8;
    vec3 at = (to_shadow[cascade] * vec4(p, 1.0)).xyz;
    vec3 from_middle = abs(at - 0.5);
    if (max(from_middle.x, max(from_middle.y, from_middle.z)) > 0.49) continue;
    vec2 step = 1.0 / vec2(textureSize(shadow_maps, 0).xy);
    float lit = 0.0;
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        lit += texture(shadow_maps, vec4(at.xy + 1.2 * vec2(x, y) * step, float(cascade), at.z));
      }
    }
    return lit / 9.0;
  }
  return 1.0;
}
