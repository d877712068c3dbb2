// The model's sky in the photo's colors: one gain per channel, fitted once at the photo's own
// sun (analysis/fit/fit.py) and frozen, since a refit after a move would pull a sunset back to noon.

#include "sky/day_color.glsl"

uniform vec3 sky_gain;

vec3 GetMatchedSky(sampler2D sky_view, SkyView view, vec3 direction) {
  ivec2 size = textureSize(sky_view, 0);
  vec3 sky = SpectralToRec709(GetSkyRadiance(sky_view, view, ivec2(0), size, direction));
  // Saturated spectra leave Rec. 709: keep a small share of the luminance in each channel.
  float luminance = max(dot(sky, vec3(0.2126, 0.7152, 0.0722)), 1e-12);
  float moon = GetMoon();
  return GetDayColor() * sky_gain * (GetLightScale(moon) * max(sky, vec3(0.02 * luminance)) + GetNightSky(moon));
}

vec3 GetMatchedSky(sampler2D sky_view, vec3 direction) {
  return GetMatchedSky(sky_view, ReadSkyView(sky_view), direction);
}
