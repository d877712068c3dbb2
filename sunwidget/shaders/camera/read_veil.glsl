// Light that the camera and the air in between add over the whole picture, in the frame's exposure.

#include "sky/relit_sky.glsl"
#include "land/relit_land.glsl"
#include "sky/sky_seen.glsl"

// Shadows in the haze remove at most this share of a pixel's light: the model may have more haze than
// the photo holds.
const float kMostTaken = 0.4;
// Much of a glare is lit air, which lies behind the land: this share of it comes from the lens.
const float kLensShare = 0.25;
// Glare is uneven as the clouds that it passes are, by this power (chosen by eye).
const float kUnevenGlow = 2.0;

// `map` is the pixel of veil.glsl, in the exposure of `light`, `matte` the pixel's share of sky, `uneven` as in
// `GetSkyChange`.
// The old sun's glare was already removed together with the veil that hid sky and land behind it.
vec3 GetVeil(vec3 light, vec3 view, vec4 map, float matte, float uneven) {
  vec3 veil = map.rgb * GetSkySeen();
  vec3 color = UnpackColor(described[0].w);
  // Rays are seen before the sky only: readers took those before land for a fault.
  float rays = matte * texelFetch(composite_constants, ivec2(kBesideSun, 0), 0).z;
  float glare = GetSkySeen() * GetMoved() * described[3].y * GetCameraGlare(view, GetDescribedSun(), rays);
  vec3 added = max(veil, vec3(0.0)) + glare * mix(kLensShare, map.a * exp(kUnevenGlow * uneven), matte) * color;
  vec3 taken = mix(land_strength, sky_strength, matte) * min(veil, vec3(0.0));
  vec3 most = kMostTaken * max(light, vec3(1e-6));
  return mix(land_strength, sky_strength, matte) * added + taken * most / (most - taken);
}
