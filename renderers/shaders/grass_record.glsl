// A strand as it is kept in a buffer: Strand without padding.
struct StrandRecord {
  vec4 root_height;
  vec4 up_random;
  vec4 side_width;
};
