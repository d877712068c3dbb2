// How a pixel's land changes with the sun (method "ratio"): by the ratio of irradiances.

#include "lib/terms.glsl"
#include "lib/response.glsl"
#include "lib/land.glsl"

uniform float land_strength;

// The share of the light that is a mirror image follows `mirror_ratio`.
vec3 GetLandChange(vec3 light, vec3 land_ratio, float mirror, vec3 mirror_ratio) {
  land_ratio += mirror * (mirror_ratio - land_ratio);
  vec3 land = light * land_ratio;
  land += term[0].z * (vec3(GetLuminance(land)) - land);
  return land_strength * (term[0].x * land - light);
}

vec3 GetLitBefore(float upright) {
  return mix(term[1].rgb, term[2].rgb, upright);
}

vec3 GetLandRatio(float upright) {
  return GetRatio(mix(term[3].rgb, term[4].rgb, upright), GetLitBefore(upright));
}
