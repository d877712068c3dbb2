// How photos of a low sun differ from the clear-sky model: haze and clouds along the path redden its light, and
// cameras expose for the bright part. Learned by training/skies/low_sun.py.

#include "sky/nearness.glsl"

// Change of color at constant luminance (log2), around the sun and far from it.
const vec3 kRoundLowSun = vec3(0.42, -0.08, -1.21);
const vec3 kFarFromLowSun = vec3(0.38, -0.12, -0.17);
const float kDarker = 0.6;  // darkening far from it (log2); photos show 1
// Shares of the change that are applied, to clear sky and to cloud: photos show the finest evenings.
const float kFinest = 0.3;
const float kFinestClouds = 0.8;

// Positive from one degree below the horizon to ten above, 1 between two and three.
float GetLowness(vec3 sun) {
  return smoothstep(-0.02, 0.03, sun.y) * (1.0 - smoothstep(0.06, 0.17, sun.y));
}

vec3 GetLowSunLight(float lowness, float cosine) {
  return lowness * mix(kFarFromLowSun - kDarker, kRoundLowSun, GetNearness(cosine));
}

// Factor for the sky in the direction `view`. From a photo with a low sun, no more of this change is removed than
// the new sun adds: when its sun rises, sky/tint.glsl changes its colors.
// `lit` is the share of the pixel that is sunlit cloud.
vec3 GetLowSunChange(float lit, vec3 view, vec3 sun_before, vec3 sun_now) {
  float before = GetLowness(sun_before) * (1.0 - photo_light);
  float now = GetLowness(sun_now) * (1.0 - GetMoon());
  if (before == now && sun_before == sun_now) return vec3(1.0);
  vec3 change = GetLowSunLight(now, dot(view, sun_now)) - GetLowSunLight(min(before, now), dot(view, sun_before));
  return exp2(mix(kFinest, kFinestClouds, lit) * change);
}
