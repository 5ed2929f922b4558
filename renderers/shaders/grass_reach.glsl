// Strands thin out with distance: each has a distance of its own beyond which it is not drawn.
bool in_reach(Strand strand) {
  if (look.wind.w <= 0.0) return true;
  float own = mix(look.wind.w, look.wind.z, fract(strand.random * 17.0));
  return distance(strand.root, look.eye.xyz) < own;
}
