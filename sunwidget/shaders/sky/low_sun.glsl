// How photos of a low sun differ from the clear-sky model: haze and clouds along the path redden its light, and
// cameras expose for the bright part. Learned by training/skies/low_sun.py.

#include "sky/nearness.glsl"
#include "sky/day_color.glsl"
#include "sky/bounded.glsl"

uniform float exposure;
uniform float auto_exposure;  // 0 to 1: with a locked exposure only colors turn

// Change of color at constant luminance (log2), around the sun and far from it.
const vec3 kRoundLowSun = vec3(0.42, -0.08, -1.21);
const vec3 kFarFromLowSun = vec3(0.38, -0.12, -0.17);
const float kDarker = 0.6;  // darkening far from it (log2); photos show 1
// Shares of the change that are applied, to clear sky and to cloud: photos show the finest evenings.
const float kFinest = 0.3;
const float kFinestClouds = 0.8;

// 1 up to three degrees, 0 by day.
float GetNotDay(vec3 sun) {
  return 1.0 - smoothstep(0.06, 0.17, sun.y);
}

// Positive from one degree below the horizon to ten above, 1 between two and three.
float GetLowness(vec3 sun) {
  return smoothstep(-0.02, 0.03, sun.y) * GetNotDay(sun);
}

// Of the photo's sun and of the new one; a moon is never low.
vec2 GetLownesses(vec3 sun_before, vec3 sun_now) {
  return vec2(GetLowness(sun_before) * (1.0 - photo_light), GetLowness(sun_now) * (1.0 - GetMoon()));
}

vec3 GetLowSunLight(float lowness, float cosine) {
  return lowness * mix(kFarFromLowSun - kDarker, kRoundLowSun, GetNearness(cosine));
}

// Factor for the sky in the direction `view`. From a photo with a low sun, no more of this change is removed than
// the new sun adds: when its sun rises, sky/tint.glsl changes its colors.
// `lit` is the share of the pixel that is sunlit cloud.
vec3 GetLowSunChange(float lit, vec3 view, vec3 sun_before, vec3 sun_now) {
  vec2 low = GetLownesses(sun_before, sun_now);
  if (low.x == low.y && sun_before == sun_now) return vec3(1.0);
  vec3 change = GetLowSunLight(low.y, dot(view, sun_now)) - GetLowSunLight(min(low.x, low.y), dot(view, sun_before));
  return exp2(mix(kFinest, kFinestClouds, lit) * change);
}

// Log2 of red and of blue over green.
vec2 GetLogColor(vec3 light) {
  return log2(max(light.rb, vec2(1e-9)) / max(light.g, 1e-9));
}

// Turns the color of `light` by `turn.xy`, logs as of `GetLogColor`, and its luminance by `turn.z`.
vec3 TurnColor(vec3 light, vec3 turn) {
  vec3 turned = light * exp2(vec3(turn.x, 0.0, turn.y));
  return turned * (GetLuminance(light) / max(GetLuminance(turned), 1e-9)) * exp2(turn.z);
}

// How photos of dusk look towards a sun of about 4 degrees below the horizon, near the horizon and high above it. Medians
// of 96 photos (training/skies/dusk.py).
const vec2 kDuskBelow = vec2(1.5, -1.15);
const vec2 kDuskAbove = vec2(-0.5, 1.2);  // less violet than photos (2^0.25), as readers prefer
const vec2 kDuskOpposite = vec2(0.2, 0.4);  // opposite the sun
// Their luminance (log2) falls by 2.2 from the horizon to 40 degrees above it, that of edits by a day's sky only by .7 to 1.
const float kDuskFall = 2.2;
const float kDuskMean = 1.1;
const vec2 kDuskFalls = vec2(-0.07, -0.035);  // from 2 degrees below the horizon to 4: until then the model's fall is right
const float kDuskShare = 0.5;  // of the way to them
const float kOppositeShare = 0.25;
const float kDuskHeight = 19.0;  // of the sky near the horizon: half at 11 degrees
const float kDuskFade = 4.1;  // of the luminance

float GetDuskness(vec3 sun) {
  return (1.0 - smoothstep(-0.06, 0.01, sun.y)) * smoothstep(-0.17, -0.08, sun.y);
}

// How far it becomes dusk.
float GetDuskens(vec3 sun_before, vec3 sun_now) {
  return max(GetDuskness(sun_now) - GetDuskness(sun_before), 0.0) * GetSunToSun();
}

// 1 towards the sun's azimuth, and 0 away from it.
float GetTowards(vec3 view, vec3 sun) {
  float lengths = dot(view.xz, view.xz) * dot(sun.xz, sun.xz);
  return smoothstep(-0.2, 0.8, dot(view.xz, sun.xz) * inversesqrt(max(lengths, 1e-9)));
}

// A third to a half of what distinguishes land of such photos from that of edits: it is neutral, and darker.
const vec3 kDuskLand = vec3(0.15, -0.25, -0.4);

vec3 GetDuskLandTurn(vec3 sun_before, vec3 sun_now) {
  return GetDuskens(sun_before, sun_now) * kDuskLand * vec3(1.0, 1.0, GetTowards(vec3(0.0, 0.0, 1.0), sun_now));
}

// Where no sky is `seen`, land lit by a low sun is darker than a meter makes it, and warmer. Contrast rises, and brighter
// parts are warmer: `uneven` is the log of their light over the mean.
const vec3 kLowLand = vec3(0.2, -0.4, -0.6);
const vec3 kLowLandTexture = vec3(0.15, -0.25, 0.45);

// 1 at three degrees, fading by day, and below the horizon as dusk darkens the land.
float GetEvening(vec3 sun) {
  return smoothstep(-0.08, 0.05, sun.y) * GetNotDay(sun);
}

vec3 GetLowLandTurn(float uneven, float seen, vec3 sun_before, vec3 sun_now) {
  float falls = max(GetEvening(sun_now) * (1.0 - GetMoon()) - GetEvening(sun_before) * (1.0 - photo_light), 0.0);
  vec3 turn = (1.0 - seen) * kLowLand + GetBounded(uneven, 2.0) * kLowLandTexture;
  return falls * turn * vec3(1.0, 1.0, auto_exposure);
}

// The turn of a sky's `color` towards that of such photos as the sun sets.
vec3 GetDuskTurn(vec2 color, vec3 view, vec3 sun_before, vec3 sun_now) {
  float towards = GetTowards(view, sun_now);
  float share = mix(kOppositeShare, kDuskShare, towards);
  float height = max(view.y, 0.0);
  vec2 wanted = mix(kDuskAbove, mix(kDuskOpposite, kDuskBelow, towards), exp(-kDuskHeight * height * height));
  float falls = 1.0 - smoothstep(kDuskFalls.x, kDuskFalls.y, sun_now.y);
  return GetDuskens(sun_before, sun_now)
      * vec3(share * (wanted - color), falls * (kDuskFall * exp(-kDuskFade * height) - kDuskMean));
}

// Red over green of skies of a low sun by their blue over green: in white light, its change with less blue than green,
// and with more. Fits the medians of 326 photos; training/skies/hues.py prints those of 130 of them.
const vec3 kLowReds = vec3(0.02, 0.72, -0.6);
const float kLowShare = 0.5;  // of the way to them
// The turn of clouds per log of their light over that around them: what is brighter becomes warmer, and brighter still.
const vec3 kLowTexture = vec3(0.6, -0.5, 0.5);
// The same at dusk, where they are less bright: by day the sun lit them.
const vec3 kDuskTexture = vec3(1.2, -1.0, -0.4);

// The turn of a sky's `color` to the reds of such photos.
vec3 GetLowSkyTurn(vec2 color) {
  float wanted = kLowReds.x + kLowReds.y * max(-color.y, 0.0) + kLowReds.z * max(color.y, 0.0);
  return vec3(kLowShare * max(wanted - color.x, 0.0), 0.0, 0.0);
}

// Turns light of the sky in the direction `view`, or of what mirrors it, as the sun moves. `own` is the photo's light,
// `cloud` how far it is cloud, which is gray by day, `uneven` the log of its light over that around it, `day_y` the height
// that counts by day.
vec3 TurnToPhotos(vec3 light, vec3 own, float cloud, float uneven, vec3 view, float day_y, vec3 sun_before, vec3 sun_now,
                  float risen) {
  vec2 low = GetLownesses(sun_before, sun_now);
  float lowers = max(low.y - low.x, 0.0);
  vec3 turn = uneven * (lowers * kLowTexture + GetDuskens(sun_before, sun_now) * kDuskTexture);
  vec2 color = GetLogColor(light) + turn.xy;
  turn += GetDuskTurn(color, view, sun_before, sun_now) + GetBlueDayTurn(color, cloud, day_y, sun_now.y, risen)
      + lowers * GetLowSkyTurn(color);
  float fall = log2(max(GetExposureGain() * GetLuminance(light), 1e-9) / max(GetLuminance(own), 1e-9)) - exposure;
  turn += GetMoved() * vec3(vec2(GetMoon() == photo_light), GetSunToSun() * auto_exposure)
      * GetOwnColorTurn(color, GetLogColor(own), fall, dot(view, sun_now), sun_now.y, risen);
  return TurnColor(light, turn);
}
