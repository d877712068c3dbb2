// Laying the veil (veil.glsl) over a pixel.

#include "lib/relit_sky.glsl"
#include "lib/relit_land.glsl"

// Glare that leaves with the old sun, and shadows in the haze, take no more than this share of what
// is there: the model may know more of them than the photo holds.
const float kMostTaken = 0.4;

// `veil` of the exposure of `light`; `matte` is the pixel's share of sky.
vec3 GetVeil(vec3 light, vec4 veil, float matte) {
  // A shadow in the haze darkens what is behind it and not the glow, which is the lens's own: against
  // each other they would leave a small rest that changes with each pixel of a drag.
  vec3 shadow = min(veil.a, 0.0) * GetGlareColor();
  vec3 plain = veil.rgb - shadow;
  // The sky has the glow already where the photo told it (lib/camera_glare.glsl).
  vec3 before_sky = glare_profile.x > 0.0 ? max(veil.a, 0.0) * GetGlareColor() : plain;
  vec3 added = mix(land_strength * plain, sky_strength * before_sky, matte);
  vec3 taken = min(added, vec3(0.0)) + mix(land_strength, sky_strength, matte) * shadow;
  vec3 most = kMostTaken * max(light, vec3(1e-6));
  return max(added, vec3(0.0)) + taken * most / (most - taken);
}
