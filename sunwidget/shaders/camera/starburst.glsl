// Rays around a bright sun: the edges of an aperture of seven blades diffract its light into fourteen directions
// (Hecht, Optics, ch. 10), and scratches on the glass into finer ones between.

vec2 MultiplyComplex(vec2 a, vec2 b) {
  return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

// The starburst in the direction of `chord` from the `sun`: 0.7 in the middle of the longest ray, -0.3 between rays.
float GetStarburst(vec3 chord, vec3 sun) {
  vec3 right = normalize(vec3(sun.z, 0.0, -sun.x));
  vec2 at = vec2(dot(chord, right), dot(chord, cross(sun, right)));
  // Powers of a complex number turn n times as fast: cheaper than angles.
  vec2 z = at / max(length(at), 1e-6);
  vec2 z2 = MultiplyComplex(z, z);
  vec2 z3 = MultiplyComplex(z2, z);
  vec2 z7 = MultiplyComplex(MultiplyComplex(z2, z2), z3);
  vec2 z14 = MultiplyComplex(z7, z7);
  float ray = 0.5 + 0.5 * dot(z14, vec2(0.92, 0.39));
  ray *= ray;
  ray *= ray * (0.7 + 0.3 * dot(z3, vec2(0.6, 0.8)));
  float fine = 0.5 + 0.5 * dot(MultiplyComplex(MultiplyComplex(z14, z3), z14), vec2(0.2, 0.98));
  fine *= fine * 0.4 * (0.6 + 0.4 * dot(z2, vec2(-0.6, 0.8)));
  return max(ray, fine) - 0.3;
}
