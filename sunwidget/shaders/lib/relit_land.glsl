// How a pixel's land changes with the sun (method "ratio"): by the ratio of irradiances.

#include "lib/terms.glsl"
#include "lib/response.glsl"
#include "lib/land.glsl"

uniform float land_strength;

// The share of the light that is a mirror image follows `mirror_ratio`; `air` is what the air before
// it adds (air.glsl).
vec3 GetLandChange(vec3 light, vec3 land_ratio, float mirror, vec3 mirror_ratio, vec3 air) {
  land_ratio += mirror * (mirror_ratio - land_ratio);
  vec3 land = max(light * land_ratio + air, vec3(0.0));
  land += term[0].z * (vec3(GetLuminance(land)) - land);
  return land_strength * (term[0].x * land - light);
}

vec3 GetLitBefore(float upright) {
  return mix(term[1].rgb, term[2].rgb, upright);
}
