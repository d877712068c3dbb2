// The model's sky in the photo's colors: one gain per channel, fitted once at the photo's own
// sun (analysis/fit/fit.py) and frozen, since a refit after a move would pull a sunset back to noon.

#include "sky/moonlight.glsl"

uniform vec3 sky_gain;

float GetSineOfHorizon(float horizon) {
  return horizon * (1.0 - horizon * horizon / 6.0);
}

// The horizon of a photo without visible sea is uncertain: air that a soft matte shows in front of land has the
// color of the air at the horizon, not of the model's ground.
vec3 RaiseToHorizon(vec3 direction, float horizon) {
  float least = GetSineOfHorizon(horizon) + 1e-3;
  return direction.y < least ? normalize(vec3(direction.x, least, direction.z)) : direction;
}

vec3 GetMatchedSky(sampler2D sky_view, SkyView view, vec3 direction) {
  ivec2 size = textureSize(sky_view, 0);
  direction = RaiseToHorizon(direction, view.horizon);
  vec3 sky = SpectralToRec709(GetSkyRadiance(sky_view, view, ivec2(0), size, direction));
  // Saturated spectra leave Rec. 709: keep a small share of the luminance in each channel.
  float luminance = max(dot(sky, vec3(0.2126, 0.7152, 0.0722)), 1e-12);
  float moon = GetMoon();
  return sky_gain * (GetLightScale(moon) * max(sky, vec3(0.02 * luminance)) + GetNightSky(moon));
}

vec3 GetMatchedSky(sampler2D sky_view, vec3 direction) {
  return GetMatchedSky(sky_view, ReadSkyView(sky_view), direction);
}
