// Air brightened by the new sun is compressed to a camera's range, from a bright sky on, and with it the water that
// mirrors it; less so where the photo shows its own sun or moon, and so how bright that air is.

#include "sky/sun_visible.glsl"

const float kBrightAir = 0.25;  // scene-linear
const float kAirRange = 0.5;    // of the stops beyond it; chosen by pairs (docs/methods/effects.md)
const float kKnownAirRange = 0.9;

// `relit` was `light` in the photo. What is `mean` as bright as it decides, so that a cloud's texture stays.
vec3 CompressBrightAir(vec3 relit, vec3 light, float mean) {
  float kept = max(kBrightAir, GetLuminance(light) * mean);
  float beyond = max(log2(max(GetExposureGain() * GetLuminance(relit) * mean, 1e-9) / kept), 0.0);
  return relit * exp2(beyond * (mix(kAirRange, kKnownAirRange, max(sun_visible, photo_light)) - 1.0));
}
