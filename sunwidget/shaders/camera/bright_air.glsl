// Air brightened by the new sun is compressed to a camera's range, from a bright sky on, and with it the water that
// mirrors it; less so where the photo shows its own sun or moon, and so how bright that air is.

#include "sky/sun_visible.glsl"

const float kBrightAir = 0.25;  // scene-linear
const float kAirRange = 0.25;
const float kKnownAirRange = 0.9;
const vec2 kBend = vec2(0.01, 0.4);  // stops over which it sets in, in cloud and in clear air, where a bend is an arc

// `relit` was `light` in the photo. What is `mean` as bright as it decides, so that a cloud's texture stays.
vec3 CompressBrightAir(vec3 relit, vec3 light, float mean, float cloud) {
  float kept = max(kBrightAir, GetLuminance(light) * mean);
  float beyond = max(log2(max(GetExposureGain() * GetLuminance(relit) * mean, 1e-9) / kept), 0.0);
  float bend = mix(kBend.y, kBend.x, cloud);
  float lost = beyond - bend * (1.0 - exp(-beyond / bend));
  return relit * exp2(lost * (mix(kAirRange, kKnownAirRange, max(sun_visible, photo_light)) - 1.0));
}
