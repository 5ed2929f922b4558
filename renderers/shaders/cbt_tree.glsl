// The bits and sums of lod/cbt/bit_tree.h, in words of 32 bits, and the triangles and neighbours of
// lod/cbt/bisection.h, step by step. The blocks are those of renderers/cbt/gpu_cbt.cpp.
layout(std430, binding = 0) buffer Tree { uint words[]; };
layout(std430, binding = 1) readonly buffer Heights { float heights[]; };
layout(std140, binding = 0) uniform Lattice {
  ivec2 last;   // sample
  ivec2 roots;  // squares
  vec2 cell;    // metres
  int side_log, depth;
};

uint first_root() { return 1u << (depth - 2 * side_log); }

// The leaves in and below a node.
uint sum(uint node) {
  uint level = uint(findMSB(node)), bits = uint(depth) - level + 1u;
  uint first = (2u << level) + node * bits, shift = first & 31u;
  uint value = words[first >> 5] >> shift;
  if (shift + bits > 32u) value |= words[(first >> 5) + 1u] << (32u - shift);
  return value & ((1u << bits) - 1u);
}

uint leaf_of(uint number) {
  uint node = 1u;
  for (uint leaves = sum(1u); leaves > 1u;) {
    uint left = sum(2u * node);
    bool right = number >= left;
    node = 2u * node + uint(right);
    leaves = right ? leaves - left : left;
    if (right) number -= left;
  }
  return node;
}

struct Place {
  uint node;
  ivec2 a, b, c;
  uint across, beside_b, beside_a;  // 0 at the border
};

uint child(uint parent, uint which) { return parent == 0u ? 0u : 2u * parent + which; }

Place half_of(Place p, bool right) {
  ivec2 middle = (p.a + p.b) / 2;
  if (right) {
    return Place(2u * p.node + 1u, p.b, p.c, middle, child(p.beside_b, 0u), 2u * p.node, child(p.across, 0u));
  }
  return Place(2u * p.node, p.c, p.a, middle, child(p.beside_a, 1u), child(p.across, 1u), 2u * p.node + 1u);
}

uint root_in(ivec2 square, uint which) {
  if (any(lessThan(square, ivec2(0))) || any(greaterThanEqual(square, roots))) return 0u;
  return first_root() + 2u * uint(square.y * roots.x + square.x) + which;
}

Place root_place(uint node) {
  int number = int(node - first_root()) / 2, side = 1 << side_log;
  ivec2 square = ivec2(number % roots.x, number / roots.x), low = square * side, high = low + side;
  ivec2 east_corner = ivec2(high.x, low.y), south_corner = ivec2(low.x, high.y);
  bool falling = (square.x + square.y) % 2 == 0, second = (node & 1u) != 0u;
  uint north = root_in(square - ivec2(0, 1), 1u), south = root_in(square + ivec2(0, 1), 0u);
  uint west = root_in(square - ivec2(1, 0), uint(falling)), east = root_in(square + ivec2(1, 0), uint(!falling));
  uint other = node ^ 1u;
  if (falling) {
    return second ? Place(node, high, low, south_corner, other, west, south)
                  : Place(node, low, high, east_corner, other, east, north);
  }
  return second ? Place(node, east_corner, south_corner, high, other, south, east)
                : Place(node, south_corner, east_corner, low, other, north, west);
}

// The node must be a root or below one.
Place place_of(uint node) {
  int below = findMSB(node) - findMSB(first_root());
  Place place = root_place(node >> below);
  while (below-- > 0) place = half_of(place, (node >> below & 1u) != 0u);
  return place;
}

vec2 plan(ivec2 point) { return vec2(min(point, last)) * cell; }

float height_at(ivec2 point) {
  ivec2 at = min(point, last);
  return heights[at.y * (last.x + 1) + at.x];
}
