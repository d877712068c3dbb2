// Air brightened by the new sun is compressed to a camera's range, from a bright sky on, and with it the water that
// mirrors it.

const float kBrightAir = 0.25;  // scene-linear
const float kAirRange = 0.5;    // of the stops beyond it; chosen by pairs (docs/methods/effects.md)
const float kBend = 0.2;        // stops over which it sets in, or it would show as an arc

// `relit` was `light` in the photo. What is `mean` as bright as it decides, so that a cloud's texture stays.
vec3 CompressBrightAir(vec3 relit, vec3 light, float mean) {
  float kept = max(kBrightAir, GetLuminance(light) * mean);
  float beyond = max(log2(max(GetExposureGain() * GetLuminance(relit) * mean, 1e-9) / kept), 0.0);
  float lost = beyond - kBend * (1.0 - exp(-beyond / kBend));
  return relit * exp2((kAirRange - 1.0) * lost);
}
