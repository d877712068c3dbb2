// The camera's own glare round the sun: bloom and haze in the lens that no sky model knows.
// Measured once in the photo (analysis/camera_glare.py) as a Moffat profile of light of the sun's
// colour, G(angle) = a / (1 + (angle / b)^2)^c, and carried along with the sun, so that the old
// halo leaves with the old sun and the new sun has the look of its camera. It is added to the sky,
// as a lens does: the glow in a deep blue sky is white.

uniform vec3 glare_profile;  // a (scene-linear luminance), b (degrees), c

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

float GetLightRatio(vec3 now, vec3 before) {
  return dot(now, vec3(1.0)) / max(dot(before, vec3(1.0)), 1e-6);
}

// A veil scales with the light of the sun that makes it, but what it is to the sky behind must
// not outgrow what was measured: a sun that was setting in the photo would blind at noon.
float GetGlareStrength(float sun_ratio, float sky_ratio, float visible) {
  return visible * min(sun_ratio, sky_ratio);
}

// The colour of the sun travels as one float: shares of red and blue in 12 bits each.
float PackColor(vec3 color) {
  vec3 share = color / max(dot(color, vec3(1.0)), 1e-12);
  return floor(share.r * 4095.0 + 0.5) + 4096.0 * floor(share.b * 4095.0 + 0.5);
}

// Of luminance 1.
vec3 UnpackColor(float code) {
  float blue = floor(code / 4096.0);
  vec2 share = vec2(code - 4096.0 * blue, blue) / 4095.0;
  vec3 color = vec3(share.x, max(1.0 - share.x - share.y, 0.0), share.y);
  return color / max(dot(color, vec3(0.2126, 0.7152, 0.0722)), 1e-6);
}
