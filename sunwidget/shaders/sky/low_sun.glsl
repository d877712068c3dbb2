// What photos of a low sun show beyond a clear sky's model: haze and clouds on the way redden its light, and
// cameras are exposed for the bright part. Learned by training/skies/low_sun.py.

#include "sky/nearness.glsl"

// Log2 of color, as bright, round the sun and far from it.
const vec3 kRoundLowSun = vec3(0.42, -0.08, -1.21);
const vec3 kFarFromLowSun = vec3(0.38, -0.12, -0.17);
const float kDarker = 0.6;  // far from it, log2 of light; photos say 1
// The share of it that is taken: photos are of the finest evenings. Of clear sky, and of cloud.
const float kFinest = 0.3;
const float kFinestClouds = 0.8;

// From one degree below the horizon to ten above, whole between two and three.
float GetLowness(vec3 sun) {
  return smoothstep(-0.02, 0.03, sun.y) * (1.0 - smoothstep(0.06, 0.17, sun.y));
}

vec3 GetLowSunLight(float lowness, float cosine) {
  return lowness * mix(kFarFromLowSun - kDarker, kRoundLowSun, GetNearness(cosine));
}

// Factor for a sky in the direction of `view`. Of what a photo with a low sun has of it itself no more goes than
// comes elsewhere: when its sun rises, sky/tint.glsl turns its colors.
// `lit` is the share of cloud that stands in its light.
vec3 GetLowSunChange(float lit, vec3 view, vec3 sun_before, vec3 sun_now) {
  float before = GetLowness(sun_before) * (1.0 - photo_light);
  float now = GetLowness(sun_now) * (1.0 - GetMoon());
  if (before == now && sun_before == sun_now) return vec3(1.0);
  vec3 change = GetLowSunLight(now, dot(view, sun_now)) - GetLowSunLight(min(before, now), dot(view, sun_before));
  return exp2(mix(kFinest, kFinestClouds, lit) * change);
}
