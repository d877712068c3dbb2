// How bright the sky is beside a sun that the picture shows by day. A camera stops down for it, and its light spreads in
// air and lens, so that photos agree whatever their sky.

#include "frame/read_composite_constants.glsl"
#include "camera/response.glsl"
#include "sky/sun_visible.glsl"
#include "sky/low_sun.glsl"

// Scene-linear light of such skies without the glare of the lens: beside the sun, its fall per radian, and the least.
// Near the sun it fits the medians of 207 photos with suns 6 to 45 degrees high; farther away these are darker, but there
// blind readers preferred brighter skies.
const float kBesideSun = 0.4;
const float kBesideFall = 1.2;
const float kLeastBeside = 0.25;
const float kBesideRange = 0.35;  // share that remains of the stops beyond them
const float kBesideBend = 0.3;    // stops over which this sets in
const float kFainter = 0.8;       // stops below them from which darker skies are lifted, close to the sun
const float kLiftFall = 7.0;      // of the lift, per 2 - 2 cos
const vec2 kBesideDay = vec2(0.1, 0.19);  // sine of the sun's height
const float kOwnContrast = 2.0;   // most stops
const vec2 kGlowSeen = vec2(0.35, 0.65);  // share of the glow that no cloud hides: not seen, seen
const vec2 kCloudy = vec2(0.3, 0.9);      // opacity: clouds stay as bright

// Sky that was `own` in the photo and is `relit`, in a direction with this cosine to the new `sun`. As it is dimmed, its
// contrast to the photo's mean sky stays, and the user's exposure counts in neither direction. What is added is half white.
vec3 FitBesideSun(vec3 relit, vec3 own, float opacity, float cosine, vec3 sun) {
  float share = auto_exposure * (1.0 - max(sun_visible, photo_light)) * smoothstep(kBesideDay.x, kBesideDay.y, sun.y)
      * smoothstep(kGlowSeen.x, kGlowSeen.y, texelFetch(composite_constants, ivec2(kGlare, 0), 0).a)
      * (1.0 - smoothstep(kCloudy.x, kCloudy.y, opacity));
  float chord = max(2.0 - 2.0 * cosine, 0.0);
  float usual = max(kBesideSun * exp(-kBesideFall * sqrt(chord)), kLeastBeside);
  float contrast = log2(max(GetLuminance(own), 1e-6) / max(GetLuminance(GetSceneLight(photo_sky_linear_mean)), 1e-6));
  contrast *= inversesqrt(1.0 + contrast * contrast / (kOwnContrast * kOwnContrast));
  float light = max(GetLuminance(relit), 1e-9);
  float stops = log2(max(GetExposureGain() * light, 1e-9) / usual) - exposure;
  float beyond = max(stops - contrast, 0.0);
  beyond -= kBesideBend * (1.0 - exp(-beyond / kBesideBend));
  float lacking = exp(-kLiftFall * chord) * max(-stops - kFainter, 0.0);
  float lift = exp2((1.0 - kBesideRange) * share * lacking) - 1.0;
  return exp2((kBesideRange - 1.0) * share * beyond) * (relit + 0.5 * lift * (relit + light));
}
