// The share of light that water reflects (hybrid paper, §3.4: from the dot product of "the normal of the water and
// light reflection vector"), by Schlick's approximation. n: the water's normal; v: towards the eye; sun: towards the
// sun. Readings of the reflection vector: 0 the view vector (Fresnel's law); 1 the sight line reflected by the water,
// towards where the reflected light comes from; 2 the sun's light reflected by the water, as printed.
float fresnel_cosine(int reading, vec3 n, vec3 v, vec3 sun) {
  vec3 other = reading == 0 ? v : reading == 1 ? reflect(-v, n) : reflect(-sun, n);
  return clamp(dot(n, other), 0.0, 1.0);
}

float reflectance(float cosine, float at_normal, float power) {
  return at_normal + (1.0 - at_normal) * pow(1.0 - cosine, power);
}
