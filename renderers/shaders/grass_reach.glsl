// Whether a strand is drawn in this frame.

// Strands thin out with distance: each has a distance of its own beyond which it is not drawn.
bool in_reach(Strand strand) {
  if (look.wind.w <= 0.0) return true;
  float own = mix(look.wind.w, look.wind.z, fract(strand.random * 17.0));
  return distance(strand.root, look.eye.xyz) < own;
}

// False if the sphere around the strand's billboards lies outside the view.
bool in_view(Strand strand) {
  float radius = strand.height * (1.0 + length(look.wind.xy)) + strand.width;
  mat4 rows = transpose(look.world_to_clip);
  for (int side = 0; side < 3; ++side) {
    for (float sign = -1.0; sign < 2.0; sign += 2.0) {
      vec4 plane = rows[3] + sign * rows[side];
      if (dot(plane, vec4(strand.root, 1.0)) < -radius * length(plane.xyz)) return false;
    }
  }
  return true;
}
