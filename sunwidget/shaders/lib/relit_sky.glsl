// How a pixel's sky and clouds change with the sun (method "ratio").

#include "lib/terms.glsl"
#include "lib/described_sky.glsl"
#include "lib/response.glsl"
#include "lib/forward_lobe.glsl"
#include "lib/tint.glsl"

uniform float sky_strength;
uniform float cloud_strength;
uniform float silver_lining;
uniform float sun_visible;  // whether the photo shows its sun, 0 or 1

// Height of the sun (sine) under which clouds of two kilometres lose it, and high thin ones do not.
const float kSetsForLow = -0.045;
const float kStandsForLow = -0.004;
// Share of the sun's light that is left on low clouds then: it has been scattered there.
const float kAfterglow = 0.4;
// Height of the sun under which it lights clouds from below.
const float kGrazing = 0.05;
// Their share of the sun's light when it stands at the horizon.
const float kUnderlit = 0.7;
const float kFarthest = 1.8;  // stops
const float kBrightAir = 0.4;  // scene-linear
const float kAirRange = 0.5;
const float kKnownAirRange = 0.9;

// A cloud's share of full sunlight, by how bright the photo shows it: its light is what is left of the
// sky's when what lies beyond it is taken away. Inside a cloud the light is scattered sunlight, too, and
// one map's brightness is no measurement: the share stays near its mean. `sky` is without detail,
// or a cloud's bright parts would lose more than its dark ones and leave a flat grey.
float GetSunlitShare(vec3 sky, vec3 sky_before, vec3 ambient, vec3 direct, float opacity) {
  float cloud = GetLuminance(sky - (1.0 - opacity) * sky_before) / max(opacity, 0.5);
  float share = (cloud - GetLuminance(ambient)) / max(GetLuminance(direct), 1e-9);
  float known = smoothstep(0.3, 0.9, opacity) * smoothstep(0.1, 0.5, GetLuminance(direct) / GetLuminance(ambient));
  return mix(1.0, 0.6 + 0.4 * clamp(share, 0.0, 1.0), known);
}

// Light of a cloud of this opacity: the sky's and its share of the sun's, what a thin one sends on
// towards the viewer (a silver lining), and what comes through it from the sky beyond.
vec3 GetCloud(vec3 ambient, vec3 direct, float share, vec3 sky_beyond, vec3 sun, vec3 view, float opacity) {
  float low = mix(kAfterglow, 1.0, smoothstep(kSetsForLow, kStandsForLow, sun.y));
  float lit = share * mix(1.0, low, opacity * opacity);
  float lobe = 0.25 * silver_lining * GetForwardLobe(dot(sun, view)) * (1.0 - opacity);
  return mix(ambient + (lit + lobe) * direct, sky_beyond, 0.7 * (1.0 - opacity) + 0.15);
}

// `light` of the photo's sky becomes the light under the new sun. `clean` is the sky without the
// old sun (sky_behind.glsl), `mark` where the old sun's glare lies, `disc` the new disc.
vec3 GetSkyChange(vec3 light, vec3 clean, float opacity, float mark, vec3 sky_before, vec3 sky_now,
                  vec3 view, vec3 disc) {
  float gain = term[0].x;
  float moved = term[0].y;
  float glare = mark * moved * step(1e-6, sky_strength);
  vec3 sky = light + glare * (clean - light);
  vec3 ambient = term[5].rgb - term[6].rgb;
  vec3 sun_before = term[9].rgb;
  vec3 sun_now = GetDescribedSun();
  float share = GetSunlitShare(clean, sky_before, ambient, term[6].rgb, opacity);
  // From below a sun at the horizon reaches what was in the shade.
  float grazing = smoothstep(0.0, kGrazing, sun_before.y) - smoothstep(0.0, kGrazing, sun_now.y);
  float share_now = share + 0.5 * max(grazing, 0.0) * max(kUnderlit - share, 0.0);
  vec3 cloud_before = GetCloud(ambient, term[6].rgb, share, sky_before, sun_before, view, opacity);
  vec3 cloud_now = GetCloud(term[7].rgb - term[8].rgb, term[8].rgb, share_now, sky_now, sun_now, view, opacity);
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
  vec3 model = mix(sky_before, cloud_before, opacity * min(cloud_strength, 1.0));
  relit = WithModelsColor(relit, sky, model, ratio, opacity, sky_before, sky_now);
  // What the air brightens round the new sun is drawn in a camera's range, from a bright sky on; less so
  // where the photo's own sun or moon told how bright that is.
  float level = gain * GetLuminance(relit);
  float kept = max(kBrightAir, GetLuminance(light));
  relit *= level > kept ? pow(level / kept, mix(kAirRange, kKnownAirRange, max(sun_visible, photo_light)) - 1.0) : 1.0;
  // The new disc, behind clouds; the matte hides it behind land.
  relit += moved * (1.0 - opacity) * (1.0 - opacity) * disc;
  return sky_strength * (gain * relit - light);
}
