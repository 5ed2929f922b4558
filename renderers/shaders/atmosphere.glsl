// Sky and fog. Towards the horizon the sky takes the fog's colour, so that ground in full fog cannot be told
// from it. Follows scene.glsl and sky_blend.glsl.
const float kPi = 3.14159265358979;

// Of the fog in direction d: the sun's colour towards the sun (hybrid paper, §4.2).
vec3 fog_towards(vec3 d) {
  float towards = pow(max(dot(d, sun.xyz), 0.0), sun.w);
  return mix(fog_color.rgb, sun_light.rgb / max(max(sun_light.r, sun_light.g), max(sun_light.b, 1e-6)),
             sun_light.w * towards);
}

// The share of fog over a distance in air.
float fog_share(float metres) {
  float thick = metres / fog_color.w;
  return 1.0 - exp(-thick * thick);
}

// The noise map in direction d as thickness of cloud: from 0, where there is none, 1 and more is full cloud. The map
// is wound around the vertical axis; its rows run from the zenith to the horizon.
float cloud_thickness(vec3 d) {
  vec2 at = vec2(atan(d.x, -d.z) / (2.0 * kPi) + cloud_color.w, acos(clamp(d.y, 0.0, 1.0)) / (0.5 * kPi));
  float noise = textureLod(sky_noise, at, 0.0).r;
  return (noise - cloud_range.x) / (cloud_range.y - cloud_range.x);
}

vec3 clear_sky(vec3 d) {
  vec3 colour = mix(sky_low.rgb, sky_high.rgb, 1.0 - exp(-max(d.y, 0.0) * sky_high.w));
  float near_sun = max(dot(d, sun.xyz), 0.0);
  return colour + sun_light.rgb * (0.10 * pow(near_sun, 24.0) + 0.05 * pow(near_sun, 6.0)) * sun_light.w;
}

vec3 sky_towards(vec3 d) {
  float thickness = cloud_thickness(d), share = sky_share(clamp(thickness, 0.0, 1.0));
  // Cloud is bright where it thins out towards the sun, and darker where it thickens.
  float towards = max(dot(d, sun.xyz), 0.0);
  float thinner = thickness - cloud_thickness(normalize(d + 0.035 * sun.xyz));
  float bright = clamp(0.90 - 0.20 * max(thickness, 0.0) + 0.55 * thinner, 0.45, 1.12);
  vec3 shaded = cloud_color.rgb * mix(sky_light.rgb / max(sky_light.b, 1e-3), vec3(1.0), 0.75) * bright +
                sun_light.rgb * 0.06 * pow(towards, 5.0);
  vec3 cloud = mix(cloud_color.rgb, shaded, cloud_range.z);
  vec3 sky = share * clear_sky(d) + (1.0 - share) * cloud;
  // The disc has half a degree of radius. Its glow falls off exponentially: a steeper one shows a ring where it
  // stops being white.
  float away = length(d - sun.xyz);
  float disc = 3.0 * (1.0 - smoothstep(0.006, 0.011, away)) + 0.55 * exp(-away / 0.035) + 0.12 * exp(-away / 0.13);
  sky += sun_light.rgb * disc * share * share;
  float haze = 1.0 - smoothstep(0.0, sky_low.w, d.y);
  return mix(sky, fog_towards(d), haze * haze);
}

// What water of this thickness does to light that passes it: red is absorbed first.
vec3 through_water(vec3 light, float metres) {
  vec3 passed = exp(-metres / water_color.w * vec3(1.7, 0.85, 0.75));
  return light * passed + water_color.rgb * (sky_light.rgb + 0.5 * sun_light.rgb) * (1.0 - passed);
}

// A surface at `world` of this colour as the eye sees it: fog, and at the ground's border the sky.
vec3 through_air(vec3 colour, vec3 world) {
  vec3 away = world - eye.xyz;
  float distance = length(away);
  vec3 d = away / max(distance, 1e-6);
  if (water.z > 0.5) return through_water(colour, distance);
  colour = mix(colour, fog_towards(d), fog_share(distance));
  vec2 inside = min(world.xz - border.xy, border.zw - world.xz);
  float edge = 1.0 - smoothstep(0.0, max(border_fade.x, 1e-6), min(inside.x, inside.y));
  edge *= smoothstep(border_fade.y, border_fade.z, distance);
  return mix(colour, sky_towards(d), edge);
}
