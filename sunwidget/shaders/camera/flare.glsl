// Lens flare: faint ghosts (images of the aperture, reflected between two surfaces of the lens)
// on the line from the sun through the picture's center, and a ring around the center. Per unit of the
// sun's light.

float GetGhost(vec2 at, vec2 center, float radius) {
  float edge = length(at - center) / radius;
  // Ghosts are a little brighter at the rim.
  return smoothstep(1.0, 0.8, edge) * (0.6 + 0.4 * edge * edge);
}

// `at` and `sun` are relative to the picture's center, in heights of the picture.
vec3 GetFlare(vec2 at, vec2 sun) {
  vec3 light = vec3(0.9, 0.7, 0.5) * GetGhost(at, -0.35 * sun, 0.035);
  light += vec3(0.5, 0.8, 0.6) * GetGhost(at, -0.62 * sun, 0.06);
  light += vec3(0.4, 0.5, 0.9) * GetGhost(at, -1.15 * sun, 0.11);
  light += vec3(0.8, 0.5, 0.4) * GetGhost(at, 0.45 * sun, 0.022);
  vec3 ring = (length(at + 0.2 * sun) - vec3(0.62, 0.6, 0.58)) / 0.035;
  light += 0.25 / (1.0 + ring * ring * ring * ring);
  // A sun far outside the picture causes no flare.
  return 0.02 * light * (1.0 - smoothstep(0.8, 1.3, length(sun)));
}
