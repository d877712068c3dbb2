// Appearance of a full moon: no limb darkening (its dust scatters light back towards the source),
// and maria, the dark plains, as seen from the northern hemisphere when it stands in the south.

// Albedo relative to its mean at a point of the disc, x to the right and y up in units of its radius.
float GetMoonAlbedo(vec2 place) {
  // x, y and inverse radius: Imbrium, Serenitatis, Tranquillitatis, Procellarum, Nubium, Fecunditatis.
  const vec3 maria[6] = vec3[6](vec3(-0.25, 0.5, 3.2), vec3(0.3, 0.45, 5.0), vec3(0.46, 0.14, 4.2),
      vec3(-0.62, 0.15, 3.4), vec3(-0.28, -0.35, 4.0), vec3(0.72, -0.1, 5.5));
  float dark = 0.0;
  for (int i = 0; i < 6; ++i) {
    vec2 apart = (place - maria[i].xy) * maria[i].z;
    float falloff = 1.0 + dot(apart, apart);
    dark += 1.0 / (falloff * falloff);
  }
  return 1.12 - 0.5 * min(dark, 1.0);
}
