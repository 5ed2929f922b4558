// What Cbt::Criterion (lod/cbt/cbt.cpp) decides, with the operations of ScreenBound::allow() in a ball, of
// NestedErrors::box() and of Frustum::see() in their order, none of them fused.
layout(std430, binding = 2) readonly buffer Errors { float errors[]; };
layout(std430, binding = 3) readonly buffer Radii { float radii[]; };
layout(std140, binding = 1) uniform Rule {
  dvec4 eye_pixels, forward_focal, near_secant;
  dvec4 planes[6];
};

int point_number(ivec2 point) { return point.y * ((roots.x << side_log) + 1) + point.x; }

double allowed(dvec3 centre, double radius) {
  dvec3 forward = forward_focal.xyz;
  double pixels = eye_pixels.w, focal = forward_focal.w, near = near_secant.x, secant = near_secant.y;
  precise dvec3 off = centre - eye_pixels.xyz;
  precise double away = sqrt(off.x * off.x + off.y * off.y + off.z * off.z);
  precise double nearest = max(near, (away - radius) / secant);
  precise double ahead = off.x * forward.x + off.y * forward.y + off.z * forward.z - radius;
  precise double least = max(nearest, ahead);
  precise double spread = min(secant, (sqrt(off.x * off.x + off.z * off.z) + radius) / least);
  precise double metres = (1.0lf - 1e-6lf) * pixels * least / (focal * spread + pixels * abs(forward.y));
  return metres;
}

bool is_coarse(Place t) {
  ivec2 legs = abs(t.a - t.c), middle = (t.a + t.b) / 2;
  if (legs.x + legs.y <= 1) return false;
  precise vec2 at = plan(middle);
  return double(errors[point_number(middle)]) >
         allowed(dvec3(at.x, height_at(middle), at.y), double(radii[point_number(middle)]));
}

// Of a triangle that can be split. Tests the planes of the mask, and clears those that its box lies wholly inside of.
bool is_in_view(ivec2 a, ivec2 b, ivec2 c, inout uint mask) {
  const double largest = 3.4028234663852886e38lf;
  ivec2 middle = (a + b) / 2;
  precise vec2 low = plan(min(min(a, b), c)), high = plan(max(max(a, b), c));
  precise double height = double(height_at(middle)), radius = double(radii[point_number(middle)]);
  precise float bottom = float(max(height - radius, -largest)), top = float(min(height + radius, largest));
  precise dvec3 from = dvec3(low.x, bottom, low.y), to = dvec3(high.x, top, high.y);
  precise dvec3 centre = 0.5lf * (from + to), reach = to - centre;
  for (int k = 0; k < 6; ++k) {
    if ((mask & (1u << k)) == 0u) continue;
    dvec4 plane = planes[k];
    precise double inside = plane.x * centre.x + plane.y * centre.y + plane.z * centre.z + plane.w;
    precise double margin = abs(plane.x) * reach.x + abs(plane.y) * reach.y + abs(plane.z) * reach.z;
    if (inside < -margin) return false;
    if (inside >= margin) mask &= ~(1u << k);
  }
  return true;
}

// From the root down, as Cbt::decide_all() goes: boxes nest, but one that touches a plane may be in view by rounding
// while the next larger one is not.
bool is_in_view(uint node) {
  int below = findMSB(node) - findMSB(first_root());
  Place place = root_place(node >> below);
  for (uint mask = 63u; is_in_view(place.a, place.b, place.c, mask);) {
    if (mask == 0u || below == 0) return true;
    --below;
    place = half_of(place, (node >> below & 1u) != 0u);
  }
  return false;
}

// The bit that a node's right half has if the node is split.
uint bit_of_split(uint node) {
  uint right = 2u * node + 1u;
  return (2u << depth) + (right << (depth - findMSB(right)));
}
