// The share of sky colour where the noise map has intensity i (hybrid paper, §4.3): 1 at i = 0, 0 at i = 1.
float sky_share(float intensity) { return (cos(intensity * 3.14159265358979) + 1.0) / 2.0; }
