// What all shaders of a landscape share: one pass over the scene, and the style. Laid out as SceneBlock in
// renderers/landscape/landscape_gl.h. Colours are linear light, lengths metres. Clip space has z in 0…1
// (glClipControl), 1 at the near plane and 0 at the far plane, which keeps distant depths precise; shadow maps have 0
// nearest the sun.
layout(std140, binding = 0) uniform Scene {
  mat4 world_to_clip;
  mat4 clip_to_world;
  mat4 to_shadow[3];   // to texture coordinates and depth of the cascades, finest first
  vec4 shadow_texel;   // metres per texel of the cascades; w: 1 with shadows
  vec4 clip_plane;     // what has a negative product with (position, 1) is not drawn
  vec4 eye;            // w: seconds
  vec4 sun;            // unit vector towards the sun; w: exponent of its colour in the fog
  vec4 sun_light;      // w: strength of its colour in the fog
  vec4 sky_light;      // light from the whole sky; w: strength of ambient occlusion
  vec4 sky_high;       // colour overhead; w: how fast it changes above the horizon
  vec4 sky_low;        // colour at the horizon; w: y of the direction up to which the fog covers the sky
  vec4 fog_color;      // w: distance at which the ground keeps the share 1/e of its colour
  vec4 cloud_color;    // w: turns of the dome so far
  vec4 cloud_range;    // noise value without cloud, and of full cloud; share of shading
  vec4 border;         // the ground in plan: low x, low z, high x, high z
  vec4 border_fade;    // width of its blend into the sky; distances from the eye between which the blend sets in
  vec4 band_tops;      // heights up to which sand, grass, earth and rock lie; snow above
  vec4 ground;         // height over which bands blend, steep angle, angle of blending (degrees), texture width
  vec4 ground_modes;   // angle: 0 true, 1 as printed; 1: tri-planar; strength of bumps; 1: has no occlusion map
  vec4 materials[10];  // dark and light colour of sand, grass, earth, rock and snow
  vec4 water;          // level; side of the eye, 1 above, -1 below, 0 no water; 1: fog of water; width of waves
  vec4 water_color;    // w: distance at which light has passed the share 1/e
  vec4 waves;          // distortion, slope, metres travelled so far, strength of the highlight
  vec4 fresnel;        // reading (water.glsl), reflectance at normal view, power; exponent of the highlight
  vec4 pixels;         // width and height of the picture
};
layout(binding = 1) uniform sampler2D sky_noise;
