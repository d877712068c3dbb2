// How a pixel's land changes with the sun (method "ratio"): by the ratio of irradiances.

#include "lib/terms.glsl"
#include "lib/response.glsl"
#include "lib/land.glsl"

uniform float land_strength;
uniform int colour_loss;  // 0 keeping luminance, 1 as eq. 3.8 of the thesis

// The share of the light that is a mirror image follows `mirror_ratio`; `air` is what the air before
// it adds (air.glsl).
vec3 GetLandChange(vec3 light, vec3 land_ratio, float mirror, vec3 mirror_ratio, vec3 air) {
  land_ratio += mirror * (mirror_ratio - land_ratio);
  vec3 land = max(abs(term[0].w) * land_ratio * light + air, vec3(0.0));
  float luminance = GetLuminance(land);
  // (C / L - 1) s + 1, or (C / L)^s, times L with s = 1 - term[0].z.
  vec3 colour = max(land / max(luminance, 1e-9), vec3(1e-4));
  vec3 lost = colour_loss == 1 ? luminance * (pow(colour, vec3(1.0 - term[0].z)) - colour) : term[0].z * (vec3(luminance) - land);
  land = max(land + step(1e-9, abs(term[0].z)) * lost, vec3(0.0));
  return land_strength * (term[0].x * land - light);
}

vec3 GetLitBefore(float upright) {
  return mix(term[1].rgb, term[2].rgb, upright);
}
