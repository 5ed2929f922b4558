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

vec3 guide(Corner at) {
  float share = 2.0 * grass_random(at.position.xz) - 1.0;
  return at.normal * growth.height * (1.0 + growth.variation * share);
}

// The paper multiplies by its "total created strands". Read as the strands of the triangle created so far, this one
// included: with the total of all, every strand of a triangle would stand at one point, and from 0 the first would
// stand at a corner.
vec3 barycentric(Corner a, float number) {
  float first = grass_random(a.position.xz / growth.texture_metres * number);
  float second = grass_random((a.position.xz + 1.0) * number);
  if (first + second > 1.0) {
    if (first > second) {
      first = 1.0 - first;
    } else {
      second = 1.0 - second;
    }
  }
  return vec3(first, second, 1.0 - first - second);
}

const uint kSum = 0u, kProduct = 1u;  // of PointReading; the third is the cross product

Strand strand_at(Corner a, Corner b, Corner c, uint number) {
  vec3 share = barycentric(a, float(number));
  vec3 x = a.position * share.x, y = b.position * share.y, z = c.position * share.z;
  vec3 tip = guide(a) * share.x + guide(b) * share.y + guide(c) * share.z;
  Strand strand;
  strand.root = growth.point == kSum ? x + y + z : growth.point == kProduct ? x * y * z : cross(cross(x, y), z);
  float high = length(tip);
  bool grows = high > 1e-6 * growth.height;  // not where opposite normals cancel
  strand.height = grows ? high : 0.0;
  strand.up = grows ? tip / high : vec3(0.0, 1.0, 0.0);
  strand.random = grass_random(strand.root.xz);
  strand.side = normalize(b.position - a.position);
  if (growth.turned != 0u) {
    float angle = 6.2831853 * fract(strand.random * 61.0);
    strand.side = normalize(cos(angle) * strand.side + sin(angle) * cross(strand.up, strand.side));
  }
  strand.width = growth.width * strand.height / growth.height;
  return strand;
}
