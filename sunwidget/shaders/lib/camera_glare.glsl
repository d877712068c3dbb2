// The camera's own glare round the sun: bloom and haze in the lens that no sky model knows.
// Measured once in the photo (analysis/fit.py) as a Moffat profile of the excess over the model,
// G(angle) = a / (1 + (angle / b)^2)^c, and carried along with the sun, so that the old halo
// leaves with the old sun and the new sun has the look of its camera.

uniform vec3 glare_profile;  // a (ratio), b (degrees), c

float GetCameraGlare(float degrees_from_sun) {
  float x = degrees_from_sun / max(glare_profile.y, 0.1);
  return glare_profile.x * pow(1.0 + x * x, -glare_profile.z);
}

// The chord, and the series of its arc: within 1 % at a right angle, far better where glare is.
float GetDegreesFromSun(vec3 view, vec3 sun) {
  vec3 chord = view - sun;
  float x = dot(chord, chord);
  return degrees(sqrt(x) * (1.0 + x * (1.0 / 24.0 + x * (3.0 / 640.0 + x * (5.0 / 7168.0)))));
}

// `strength` is the light of the sun now over that in the photo, at most one: a veil scales with
// the light that makes it, but its ratio to the sky behind must not outgrow what was measured.
float GetGlareStrength(vec3 sun_now, vec3 sun_before, float visible) {
  return visible * min(dot(sun_now, vec3(1.0)) / max(dot(sun_before, vec3(1.0)), 1e-6), 1.0);
}
