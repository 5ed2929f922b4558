// The paper's pseudo-random number in [0, 1), from a pair of numbers (hybrid paper, §3.3).
float grass_random(vec2 at) { return fract(sin(dot(at, vec2(12.9898, 78.233))) * 43758.5453); }
