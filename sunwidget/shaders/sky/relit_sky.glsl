// How a pixel's sky and clouds change with the sun (method "ratio").

#include "frame/read_composite_constants.glsl"
#include "sky/described_sky.glsl"
#include "camera/response.glsl"
#include "camera/bright_air.glsl"
#include "camera/beside_sun.glsl"
#include "clouds/cloud_light.glsl"
#include "sky/tint.glsl"
#include "sky/low_sun.glsl"

uniform float sky_strength;
uniform float cloud_strength;
uniform float added_clouds;

// Logs of light: the change of the model's light at which half of the photo's excess over the model has faded,
// and the most that fades.
const float kLightFades = 1.0;
const float kMostFaded = 0.7;
// The share of a pixel's deviation from its surroundings that fades, where it is brighter and where it is darker.
const float kRimsFade = 0.8;
const float kShadeFades = 0.5;
// Cosines of the angles between old and new sun at which the old sun's glow is gone, and at which it is unchanged.
const float kFarAway = 0.77;
const float kNotAway = 0.99;
// The same for the model's own glow, which is narrower.
const float kLeft = 0.94;
const float kNotLeft = 0.998;
const float kMostGone = 1.2;  // log of light
// A cloud darker than this share of the model's light is all shade.
const float kShaded = 0.2;
const float kFarthest = 1.8;  // stops
const float kCloudBrighter = 0.33;  // log of the light of an evening's cloud over that around it
const float kTextureKept = 0.7;  // share of the clouds' texture that stays in air brightened by the new sun

// The factor by which light fades as the model's light changes by `change` (log). `own.r` (own_sky.glsl), the excess
// of the photo's sky over the model around the pixel, is haze that the model lacks or exaggerates; `own.g`, its
// excess over the rest of the sky, disappears with the sun. `local` is the pixel's excess beyond both: sunlight on
// a cloud's edge, which would remain as a rim, and what un-mixing mistook for cloud. Each excess is bounded to a
// plausible size, and what fades by `share` does not fade again by `away`. Around an unseen sun the photo may
// lack the model's glow, and a missing glow cannot fade, however little the sun has moved on from it.
float GetFadedLight(vec2 own, float local, float change, vec3 view, vec3 sun_before, vec3 sun_now) {
  float share = change * change / (change * change + kLightFades * kLightFades);
  float away = 1.0 - smoothstep(kFarAway, kNotAway, dot(sun_before, sun_now));
  float gone = sun_located * max(away - share, 0.0) * GetBounded(own.g, kMostGone);
  float lacking = (1.0 - sun_visible) * GetNearness(dot(view, sun_before)) * min(own.g, 0.0);
  float fades = GetBounded(own.r - lacking, kMostFaded) + (local > 0.0 ? kRimsFade : kShadeFades) * GetBounded(local, 1.0);
  float left = 1.0 - smoothstep(kLeft, kNotLeft, dot(sun_before, sun_now));
  return exp(-share * fades - gone - left * lacking);
}

// The change from `light` of the photo's sky to its light under the new sun. `clean` is the sky without
// the old sun (sky_behind.glsl), `mark` the old sun's glare, `own` the sky's excess over the model
// (own_sky.glsl), `disc` the new disc. `uneven` becomes the log, bounded, of the pixel's clouds' light over that around.
vec3 GetSkyChange(vec3 light, vec3 clean, float cover, float mark, vec4 own, vec3 sky_before, vec3 sky_now,
                  vec3 view, vec3 disc, out float uneven) {
  float gain = GetExposureGain();
  float moved = GetMoved();
  vec3 sky = light + mark * moved * (clean - light);
  vec3 ambient = GetCloudAmbientBefore();
  vec3 sun_before = GetSunBefore();
  vec3 sun_now = GetDescribedSun();
  // Clouds that the user added are certain.
  float opacity = mix(GetKnownOpacity(cover, sun_before), cover, smoothstep(0.0, 0.05, added_clouds));
  // Where clouds hide the photo's sun there is no peak that could leave with it. At dusk it goes with the daylight.
  float day = smoothstep(-0.05, 0.05, sun_now.y);
  float hidden = opacity * (1.0 - sun_visible) * day;
  sky_before = GetSkyBehindClouds(sky_before, ambient, hidden);
  sky_now = GetSkyBehindClouds(sky_now, GetCloudAmbientNow(), hidden * (1.0 - moved));
  own.rg += (1.0 - day) * own.a;
  float share = GetSunlitShare(clean, sky_before, ambient, GetCloudLobeBefore(), opacity);
  vec3 cloud_before = GetCloud(ambient, GetCloudLobeBefore(), share, sky_before, sun_before, view, opacity);
  vec3 cloud_now = GetCloud(GetCloudAmbientNow(), GetCloudLobeNow(), share, sky_now, sun_now, view, opacity);
  vec3 plain = GetRatio(sky_now, sky_before);
  vec3 veiled = GetRatio(mix(sky_now, cloud_now, opacity), mix(sky_before, cloud_before, opacity));
  // Where un-mixing errs, new light reveals a hard cloud edge: clouds differ from the sky by less than kFarthest.
  float parted = log2(GetLuminance(veiled) / GetLuminance(plain)) / kFarthest;
  veiled *= exp2(kFarthest * (GetBounded(parted, 1.0) - parted));
  vec3 ratio = plain + cloud_strength * (veiled - plain);
  vec3 relit = sky * ratio;
  float cloud = opacity * cloud_strength;
  vec3 model = mix(sky_before, cloud_before, cloud);
  float risen = GetRisen(sun_before, sun_now);
  relit = ShiftToModelColor(relit, sky, model, ratio, opacity, cloud, sky_before, sky_now, risen);
  float shaded = cloud * (1.0 - smoothstep(kShaded, 0.8, GetLuminance(clean) / GetLuminance(cloud_before)));
  // Measured on the relit pixel, not on the photo: where the model replaces the photo there is no rim to fade.
  vec3 whole = mix(sky_before, cloud_before, opacity);
  float local = log(max(GetLuminance(relit), 1e-15) / max(GetLuminance(whole * ratio), 1e-15)) - own.r;
  local *= cloud_strength;
  uneven = GetBounded(opacity * local, 1.0);
  relit *= GetFadedLight(own.rg, local, log(GetLuminance(model * ratio) / GetLuminance(model)), view, sun_before, sun_now);
  relit *= GetLowSunChange(cloud - shaded, view, sun_before, sun_now);
  // Colors tell an evening's clouds from its sky badly; what is brighter than the sky around it is cloud.
  float white = mix(cover, clamp(local / kCloudBrighter, 0.0, 1.0), GetEveningSky());
  relit = TurnToPhotos(relit, sky, white, uneven, view, view.y, sun_before, sun_now, risen);
  relit = CompressBrightAir(relit, light, exp(-kTextureKept * uneven));
  relit = FitBesideSun(relit, clean, opacity, dot(view, sun_now));
  // The new disc, behind clouds; the matte hides it behind land.
  relit += moved * (1.0 - cover) * (1.0 - cover) * disc;
  return gain * relit - light;
}
