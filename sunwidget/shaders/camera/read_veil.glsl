// What the camera and the air between put before the whole picture, in the exposure of the frame.

#include "sky/relit_sky.glsl"
#include "land/relit_land.glsl"
#include "sky/sky_seen.glsl"

// Shadows in the haze take no more than this share of what is there: the model may know more of them than
// the photo holds.
const float kMostTaken = 0.4;
// Much of a glare is lit air, and that lies behind the land: this share of it comes from the lens.
const float kLensShare = 0.25;

// `veil` of the exposure of `light` (veil.glsl); `matte` is the pixel's share of sky. The old sun's glare
// has gone with what hid sky and land behind it.
vec3 GetVeil(vec3 light, vec3 view, vec3 veil, float matte) {
  veil *= GetSkySeen();
  vec3 color = UnpackColor(described[0].w);
  float glare = GetSkySeen() * GetMoved() * described[3].y * GetCameraGlare(view, GetDescribedSun());
  vec3 added = max(veil, vec3(0.0)) + glare * mix(kLensShare, 1.0, matte) * color;
  vec3 taken = mix(land_strength, sky_strength, matte) * min(veil, vec3(0.0));
  vec3 most = kMostTaken * max(light, vec3(1e-6));
  return mix(land_strength, sky_strength, matte) * added + taken * most / (most - taken);
}
