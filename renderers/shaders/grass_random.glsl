// Pseudo-random numbers in [0, 1) for grass.

// As the paper prints it, from a pair of numbers (hybrid paper, §3.3). Its digits are those of the sine of large
// numbers, which every GPU rounds in its own way.
float printed_random(vec2 at) { return fract(sin(dot(at, vec2(12.9898, 78.233))) * 43758.5453); }

// A bijection of 32-bit integers whose output bits each depend on every input bit (lowbias32 by C. Wellons, 2018).
// Integer arithmetic is the same on every GPU and on the processor.
uint scrambled(uint bits) {
  bits = (bits ^ bits >> 16) * 0x7feb352du;
  bits = (bits ^ bits >> 15) * 0x846ca68bu;
  return bits ^ bits >> 16;
}
uint scrambled(vec3 position) {
  uvec3 bits = floatBitsToUint(position);
  return scrambled(bits.x + scrambled(bits.y + scrambled(bits.z)));
}
float fraction(uint bits) { return float(bits >> 8) / 16777216.0; }
