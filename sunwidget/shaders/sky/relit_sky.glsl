// How a pixel's sky and clouds change with the sun (method "ratio").

#include "frame/read_composite_constants.glsl"
#include "sky/described_sky.glsl"
#include "camera/response.glsl"
#include "clouds/cloud_light.glsl"
#include "sky/tint.glsl"
#include "sky/low_sun.glsl"

uniform float sky_strength;
uniform float cloud_strength;
uniform float added_clouds;

// Height of the sun under which it lights clouds from below.
const float kGrazing = 0.05;
// Their share of the sun's light when it stands at the horizon.
const float kUnderlit = 0.7;
// Logs of light: by how much the model's changes when half of what the photo's has of its own has faded, and
// the most that does.
const float kLightFades = 1.0;
const float kMostFaded = 0.7;
// How much of a pixel's own light fades: of what is brighter than round about, and of what is darker.
const float kRimsFade = 0.8;
const float kShadeFades = 0.5;
// Cosines of the angles between old and new sun at which the glow round the old one is gone, and still whole.
const float kFarAway = 0.77;
const float kNotAway = 0.99;
const float kMostGone = 1.2;  // log of light
// Light of a cloud, over the model's, from which it is not all shade; how much of the color of shade is the sky's.
const float kShaded = 0.2;
const float kShadesColor = 0.7;
const float kFarthest = 1.8;  // stops
const float kBrightAir = 0.4;  // scene-linear
const float kAirRange = 0.5;
const float kKnownAirRange = 0.9;

float GetBounded(float log_light, float most) {
  return log_light * inversesqrt(1.0 + log_light * log_light / (most * most));
}

// The part of the light that fades as the model's light changes by `change`, as a factor. What the photo's sky is
// brighter than the model round about, `own.r` (own_sky.glsl), is a haze that the model does not know, or knows too
// well; what is more of it than elsewhere in its sky, `own.g`, is gone where the sun is. `local` is
// what a pixel has beyond both: the sun on a cloud's edge, which would stay a rim, and what un-mixing took for cloud.
// No more goes than is believable, and what went by `share` does not go again by `away`. Round a sun that is not seen
// the photo may lack the model's glow: what was not there cannot go.
float GetFadedLight(vec2 own, float local, float change, vec3 view, vec3 sun_before, vec3 sun_now) {
  float share = change * change / (change * change + kLightFades * kLightFades);
  float away = 1.0 - smoothstep(kFarAway, kNotAway, dot(sun_before, sun_now));
  float gone = sun_visible * max(away - share, 0.0) * GetBounded(own.g, kMostGone);
  float lacking = (1.0 - sun_visible) * GetNearness(dot(view, sun_before)) * min(own.g, 0.0);
  float fades = GetBounded(own.r - lacking, kMostFaded) + (local > 0.0 ? kRimsFade : kShadeFades) * GetBounded(local, 1.0);
  return exp(-share * fades - gone - away * lacking);
}

// `light` of the photo's sky becomes the light under the new sun. `clean` is the sky without the
// old sun (sky_behind.glsl), `mark` where the old sun's glare lies, `own` what the sky has
// beyond the model, `disc` the new disc.
vec3 GetSkyChange(vec3 light, vec3 clean, float cover, float mark, vec2 own, vec3 sky_before, vec3 sky_now,
                  vec3 view, vec3 disc) {
  float gain = GetExposureGain();
  float moved = GetMoved();
  float glare = mark * moved * step(1e-6, sky_strength);
  vec3 sky = light + glare * (clean - light);
  vec3 ambient = GetCloudAmbientBefore();
  vec3 sun_before = GetSunBefore();
  vec3 sun_now = GetDescribedSun();
  // Clouds that a person has added are known.
  float opacity = mix(GetKnownOpacity(cover, sun_before), cover, smoothstep(0.0, 0.05, added_clouds));
  float share = GetSunlitShare(clean, sky_before, ambient, GetCloudLobeBefore(), opacity);
  // From below a sun at the horizon reaches what was in the shade.
  float grazing = smoothstep(0.0, kGrazing, sun_before.y) - smoothstep(0.0, kGrazing, sun_now.y);
  float share_now = share + 0.5 * max(grazing, 0.0) * max(kUnderlit - share, 0.0);
  vec3 cloud_before = GetCloud(ambient, GetCloudLobeBefore(), share, sky_before, sun_before, view, opacity);
  vec3 cloud_now = GetCloud(GetCloudAmbientNow(), GetCloudLobeNow(), share_now, sky_now, sun_now, view, opacity);
  vec3 plain = GetRatio(sky_now, sky_before);
  vec3 veiled = GetRatio(mix(sky_now, cloud_now, opacity), mix(sky_before, cloud_before, opacity));
  // Where un-mixing errs a cloud ends hard in another light: it parts from the sky by less than kFarthest.
  float parted = log2(GetLuminance(veiled) / GetLuminance(plain)) / kFarthest;
  veiled *= exp2(kFarthest * (parted * inversesqrt(1.0 + parted * parted) - parted));
  vec3 ratio = plain + cloud_strength * (veiled - plain);
  // Beyond 8x (or an eighth) noise and clipping would be amplified: trust the model there.
  float extreme = smoothstep(2.5, 4.0, abs(log2(GetLuminance(ratio) * gain)));
  vec3 relit = sky * ratio;
  relit += extreme * moved * (clean * ratio - relit);
  float cloud = opacity * min(cloud_strength, 1.0);
  vec3 model = mix(sky_before, cloud_before, cloud);
  float risen = GetRisen(sun_before, sun_now);
  relit = WithModelsColor(relit, sky, model, ratio, opacity, cloud, sky_before, sky_now, risen);
  // What of a cloud lies in shade has the sky's color, and the more so the more the sun's differs.
  float shaded = cloud * (1.0 - smoothstep(kShaded, 0.8, GetLuminance(clean) / GetLuminance(cloud_before)));
  vec3 shade = WithoutBalance(GetCloudAmbientNow(), max(GetVividness(), risen * GetEveningsBalance()));
  shade *= GetLuminance(relit) / GetLuminance(shade);
  relit += kShadesColor * shaded * GetTurned(ratio, model) * (shade - relit);
  // Of what is drawn, not of the photo: where the model stands in for it there is no rim to fade.
  vec3 whole = mix(sky_before, cloud_before, opacity);
  float local = log(max(GetLuminance(relit), 1e-15) / max(GetLuminance(whole * ratio), 1e-15)) - own.r;
  local *= min(cloud_strength, 1.0);
  relit *= GetFadedLight(own, local, log(GetLuminance(model * ratio) / GetLuminance(model)), view, sun_before, sun_now);
  relit *= GetLowSunChange(cloud - shaded, view, sun_before, sun_now);
  // What the air brightens round the new sun is drawn in a camera's range, from a bright sky on; less so
  // where the photo's own sun or moon told how bright that is.
  float level = gain * GetLuminance(relit);
  float kept = max(kBrightAir, GetLuminance(light));
  relit *= level > kept ? pow(level / kept, mix(kAirRange, kKnownAirRange, max(sun_visible, photo_light)) - 1.0) : 1.0;
  // The new disc, behind clouds; the matte hides it behind land.
  relit += moved * (1.0 - cover) * (1.0 - cover) * disc;
  return sky_strength * (gain * relit - light);
}
