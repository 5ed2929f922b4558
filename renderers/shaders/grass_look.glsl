// GrassLook of renderers/grass/grass.h, for all programs that draw grass and the ground below it.
layout(std140, binding = 0) uniform GrassLook {
  mat4 world_to_clip;
  vec4 eye;         // metres; w: seconds
  vec4 sun;         // unit length, towards the light; w: 1 to write linear light, 0 for sRGB
  vec4 sun_colour;  // linear light, as all colours here
  vec4 sky_colour;
  vec4 fog_colour;  // w: density per metre
  vec4 fog_sun_colour;
  vec4 clip_plane;
  vec4 wind;        // x, z: metres; z: metres where strands begin to thin out; w: where there are none, 0: nowhere
} look;
