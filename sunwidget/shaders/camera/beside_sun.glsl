// How bright the sky is beside a sun that the picture shows by day. A camera stops down for it, and its light spreads in
// air and lens, so that photos agree whatever their sky.

#include "frame/read_composite_constants.glsl"
#include "sky/low_sun.glsl"

// Scene-linear light of such skies without the glare of the lens: beside the sun, its fall per radian, and the least.
// Near the sun it fits the medians of 207 photos with suns 6 to 45 degrees high; farther away these are darker, but there
// blind readers preferred brighter skies.
const float kBeside = 0.4;
const float kBesideFall = 0.42;
const float kLeastBeside = 0.25;
const float kBesideRange = 0.35;  // share that remains of the stops beyond them
const float kBesideBend = 0.3;    // stops over which this sets in
const float kOwnContrast = 2.0;   // most stops
const vec2 kCloudy = vec2(0.3, 0.9);  // opacity: clouds stay as bright

// Sky that was `own` in the photo and is `relit`, in a direction with this cosine to the new `sun`. As it is dimmed, its
// contrast to the photo's mean sky stays, and the user's exposure does not count.
vec3 FitBesideSun(vec3 relit, vec3 own, float opacity, float cosine) {
  vec2 known = texelFetch(composite_constants, ivec2(kBesideSun, 0), 0).xy;
  float share = (kBesideRange - 1.0) * known.x * (1.0 - smoothstep(kCloudy.x, kCloudy.y, opacity));
  float usual = max(kBeside - kBesideFall * sqrt(max(2.0 - 2.0 * cosine, 0.0)), kLeastBeside);
  float contrast = GetBounded(log2(max(GetLuminance(own), 1e-6)) - known.y, kOwnContrast);
  float stops = log2(max(GetExposureGain() * GetLuminance(relit), 1e-9) / usual) - exposure;
  float beyond = max(stops - contrast, 0.0);
  beyond *= beyond / (beyond + kBesideBend);
  return exp2(share * beyond) * relit;
}
