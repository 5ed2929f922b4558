// Where a strand of grass grows on a triangle (hybrid paper, §3.3): guide strands stand at the corners, along their
// normals; a strand between them is their mean, weighted by pseudo-random barycentric coordinates.
#include "grass_random.glsl"

layout(std140, binding = 1) uniform GrassGrowth {
  float height;     // metres, of guide strands in the mean
  float variation;  // of their height, as a share
  float width;      // metres, of a billboard as high as `height`
  float texture_metres;
  uint point;       // PointReading
  uint turned;
  uint strands;
  uint triangles;
  uint random;      // RandomReading
} growth;

struct Corner {
  vec3 position;
  vec3 normal;
};

struct Strand {
  vec3 root;
  float height;  // metres
  vec3 up;       // unit length
  float random;  // [0, 1): texture and shade
  vec3 side;     // unit length
  float width;   // metres
};

const uint kPrinted = 1u;  // of RandomReading

vec3 guide(Corner at) {
  float random = growth.random == kPrinted ? printed_random(at.position.xz) : fraction(scrambled(at.position));
  return at.normal * growth.height * (1.0 + growth.variation * (2.0 * random - 1.0));
}

// Two random numbers of a strand. The paper multiplies by its "total created strands". Read as the strands of the
// triangle created so far, this one included: with the total of all, every strand of a triangle would stand at one
// point, and from 0 the first would stand at a corner.
vec2 printed_pair(Corner a, float number) {
  return vec2(printed_random(a.position.xz / growth.texture_metres * number),
              printed_random((a.position.xz + 1.0) * number));
}

vec3 barycentric(vec2 pair) {
  if (pair.x + pair.y > 1.0) {
    if (pair.x > pair.y) {
      pair.x = 1.0 - pair.x;
    } else {
      pair.y = 1.0 - pair.y;
    }
  }
  return vec3(pair, 1.0 - pair.x - pair.y);
}

const uint kSum = 0u, kProduct = 1u;  // of PointReading; the third is the cross product

// Strand `number` of the triangle, counted from 1.
Strand strand_at(Corner a, Corner b, Corner c, uint number) {
  bool printed = growth.random == kPrinted;
  uint own = scrambled(number + scrambled(a.position) + scrambled(scrambled(b.position) + scrambled(c.position)));
  vec2 pair = printed ? printed_pair(a, float(number)) : vec2(fraction(scrambled(own + 1u)), fraction(scrambled(own + 2u)));
  vec3 share = barycentric(pair);
  vec3 x = a.position * share.x, y = b.position * share.y, z = c.position * share.z;
  vec3 tip = guide(a) * share.x + guide(b) * share.y + guide(c) * share.z;
  Strand strand;
  strand.root = growth.point == kSum ? x + y + z : growth.point == kProduct ? x * y * z : cross(cross(x, y), z);
  float high = length(tip);
  bool grows = high > 1e-6 * growth.height;  // not where opposite normals cancel
  strand.height = grows ? high : 0.0;
  strand.up = grows ? tip / high : vec3(0.0, 1.0, 0.0);
  strand.random = printed ? printed_random(strand.root.xz) : fraction(own);
  strand.side = normalize(b.position - a.position);
  if (growth.turned != 0u) {
    float angle = 6.2831853 * fract(strand.random * 61.0);
    strand.side = normalize(cos(angle) * strand.side + sin(angle) * cross(strand.up, strand.side));
  }
  strand.width = growth.width * strand.height / growth.height;
  return strand;
}
