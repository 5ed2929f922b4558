#version 450 core
#include "grass_light.glsl"
in Blade {
  vec2 at;
  flat vec3 light;
  flat vec3 air;
  flat vec2 layer_random;
} blade;

layout(binding = 0) uniform sampler2DArray blades;
uniform int samples;  // per pixel: 1 or 4

layout(location = 0) out vec4 color;

void main() {
  // Level and derivatives are stated exactly: OpenGL leaves those of texture() and fwidth() to the driver.
  vec2 right = dFdxFine(blade.at), up = dFdyFine(blade.at);
  float texels = float(textureSize(blades, 0).x) * sqrt(max(dot(right, right), dot(up, up)));  // per pixel
  vec4 painted = textureLod(blades, vec3(blade.at, blade.layer_random.x), log2(max(texels, 1.0)));
  // The edge of a blade is one pixel wide at every distance: a pixel there is covered in a share of its samples,
  // whose numbers differ among strands. OpenGL's alpha to coverage would leave the choice to the driver.
  float cover = clamp((painted.a - 0.5) / max(fwidthFine(painted.a), 1e-3) + 0.5, 0.0, 1.0);
  int covered = int(cover * float(samples) + 0.5);
  if (covered == 0) discard;
  int mask = (1 << covered) - 1, first = int(blade.layer_random.y * float(samples));
  gl_SampleMask[0] = (mask << first | mask >> (samples - first)) & ((1 << samples) - 1);
  float shade = mix(0.35, 1.0, blade.at.y);  // blades shade each other near the root
  color = vec4(finished(painted.rgb * shade * blade.light + blade.air), 1.0);
}
