// How a pixel's land changes with the sun (method "ratio"): by the ratio of irradiances.

#include "frame/read_composite_constants.glsl"
#include "sky/described_sky.glsl"
#include "camera/response.glsl"
#include "land/land.glsl"
#include "sky/tint.glsl"
#include "sky/sky_seen.glsl"

// Scene-linear light from which the land's own color is known.
const float kDarkLand = 0.15;
// Albedo of dark land.
const float kDarkAlbedo = 0.2;
// How much of the color of land whose light has turned is its light's.
const float kLitColor = 0.35;
// How much of the photo's balance that light has lost then.
const float kBalanceGone = 0.6;
// Albedo from which land is less bright than its light would have it when that turns, and the brightest: what the photo
// has brighter glowed, and shines by no other light.
const vec2 kWhitePaint = vec2(0.5, 0.9);
// Under their light 75 in 100 warm pixels of the land of day photos are no redder: log of red over green, and over blue.
const vec2 kReddestLand = vec2(0.77, 1.6);

uniform vec3 photo_land_linear_mean;
uniform float land_strength;
uniform float exposure;
uniform int colour_loss;  // 0 keeping luminance, 1 as eq. 3.8 of the thesis

// What the old sun's glare put before the land goes with it, but no more than leaves dark land in its light, or land as
// dark as this landscape's: along the skyline the share is the sky's, and would leave a black line.
vec3 WithoutGlare(vec3 light, float share, vec3 lit_before) {
  vec3 least = min(kDarkAlbedo / 3.14159265 * lit_before, GetSceneLight(photo_land_linear_mean));
  return max(light * (1.0 - share), min(light, least));
}

// Leaves and mist that let a low sun through are redder than land can be in the light of another.
vec3 WithoutGlow(vec3 land, vec3 lit) {
  vec3 own = log(max(land, vec3(1e-6)) / max(lit, vec3(1e-6)));
  vec2 red = max(own.r - own.gb, vec2(0.0));
  own.gb += red - red * inversesqrt(1.0 + red * red / (kReddestLand * kReddestLand));
  vec3 color = lit * exp(own);
  return color * (GetLuminance(land) / max(GetLuminance(color), 1e-9));
}

// The more its light turns the less of the land's own color is known; and what is dark in the photo is half
// noise and half the lens' glare: it gets the color of its light, `lit`, and becomes less bright than the rest.
// What the old sun's glare, of which `glare` was the share, has colored gets that of the land at large.
vec3 WithoutGuesses(vec3 land, vec3 before, vec3 ratio, vec3 lit, float glare) {
  float level = GetLuminance(land);
  float dark = 1.0 - smoothstep(0.0, kDarkLand, GetLuminance(before));
  float lift = max(log2(max(GetExposureGain() * level, 1e-9) / max(GetLuminance(before), 1e-9)) - exposure, 0.0);
  // Without a sky nobody knows which light the land's colors stand in.
  float turned = GetSkySeen() * GetTurned(ratio, before);
  float risen = GetSkySeen() * GetRisen(GetSunBefore(), GetDescribedSun());
  float another = max(turned, risen);  // how far its light is another
  float guessed = max(kLitColor * another, dark * lift * lift / (lift * lift + 4.0));
  // A balance that the photo's light has bent is not that of another light.
  vec3 color = RemoveBalance(lit, max(max(kBalanceGone * turned, risen * GetEveningBalance()), GetVividness()));
  land += guessed * (color * (level / GetLuminance(color)) - land);
  vec3 mean = GetSceneLight(photo_land_linear_mean);
  vec3 usual = mix(color / GetLuminance(color), mean * ratio / max(GetLuminance(mean * ratio), 1e-9),
                   smoothstep(0.0, kDarkLand, GetLuminance(mean)));
  // That of an evening's land is its light's.
  usual = mix(usual / GetLuminance(usual), color / GetLuminance(color), another);
  land += glare * (usual * level - land);
  land = mix(land, WithoutGlow(land, color), another);
  float albedo = 3.14159265 * level / max(GetLuminance(lit), 1e-9);
  float beyond = max(albedo - kWhitePaint.x, 0.0) / (kWhitePaint.y - kWhitePaint.x);
  float most = kWhitePaint.x + (kWhitePaint.y - kWhitePaint.x) * beyond / (1.0 + beyond);
  land *= mix(1.0, min(most / max(albedo, 1e-6), 1.0), another);
  return land * exp2(-dark * lift * lift / (lift + 3.0));
}

// `clean` is the land's light without the old sun's glare, `lit` what falls on it now; the share of it that is a
// mirror image follows `mirror_ratio`, `air` is what the air before it adds (air.glsl), `glare` the share that went.
vec3 GetLandChange(vec3 light, vec3 clean, vec3 land_ratio, vec3 lit, float mirror, vec3 mirror_ratio, vec3 air, float glare) {
  land_ratio += mirror * (mirror_ratio - land_ratio);
  vec3 land = max(GetLandGain() * land_ratio * clean + air, vec3(0.0));
  float luminance = GetLuminance(land);
  // (C / L - 1) s + 1, or (C / L)^s, times L with s = 1 - GetLostColor().
  vec3 color = max(land / max(luminance, 1e-9), vec3(1e-4));
  vec3 lost = colour_loss == 1 ? luminance * (pow(color, vec3(1.0 - GetLostColor())) - color) : GetLostColor() * (vec3(luminance) - land);
  land = max(land + step(1e-9, abs(GetLostColor())) * lost, vec3(0.0));
  land = WithoutGuesses(land, max(clean, vec3(1e-6)), land_ratio, lit, glare);
  return land_strength * (GetExposureGain() * land - light);
}
