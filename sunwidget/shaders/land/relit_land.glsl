// Change of a pixel's land with the sun (method "ratio"): by the ratio of irradiances.

#include "frame/read_composite_constants.glsl"
#include "sky/described_sky.glsl"
#include "camera/response.glsl"
#include "land/land.glsl"
#include "sky/tint.glsl"
#include "sky/low_sun.glsl"
#include "sky/sky_seen.glsl"
#include "sky/sun_visible.glsl"

// Scene-linear light from which the land's own color is known.
const float kDarkLand = 0.15;
// Albedo of dark land.
const float kDarkAlbedo = 0.2;
// Least luminance of land at the skyline relative to the land nearby.
const float kNearby = 0.5;
// Share of the light's color in land whose light has changed color.
const float kLitColor = 0.35;
// By day the land's own color is better known than in the evening.
const float kDayKnows = 0.6;
// Share of the photo's balance that this light has lost.
const float kBalanceLost = 0.6;
// Albedo from which land is compressed when its light changes, and the largest: anything brighter in the photo glowed,
// and no other light makes it shine.
const vec2 kWhitePaint = vec2(0.5, 0.9);
// Largest redness of land relative to its light: log of red over green, and over blue. Three in four warm land pixels
// of daytime photos are below it.
const vec2 kReddestLand = vec2(0.77, 1.6);
// Shares of that redness that leave with an evening.
const vec2 kEveningsRed = vec2(0.9, 0.75);

// Largest blue of land over the stronger of red and green, in stops, whatever its light.
const float kBluestLand = 1.1;

uniform vec3 photo_land_linear_mean;
uniform float land_strength;
uniform int colour_loss;  // 0 preserves luminance, 1 follows eq. 3.8 of the thesis

// Removes the old sun's glare in front of the land, but leaves at least dark land in its light, or land as
// dark as this landscape's. Along the skyline `share` is the sky's and would leave a black line: there the land is not
// much darker than the land nearby (luminance `nearby`, 0 elsewhere).
vec3 RemoveGlare(vec3 light, float share, vec3 lit_before, float nearby) {
  vec3 least = min(kDarkAlbedo / 3.14159265 * lit_before, GetSceneLight(photo_land_linear_mean));
  least = max(least, kNearby * nearby / max(GetLuminance(light), 1e-6) * light);
  return max(light * (1.0 - share), min(light, least));
}

// Limits the redness of leaves and mist that a low sun shone through: no land is as red under another light.
vec3 RemoveGlow(vec3 land, vec3 lit, vec2 reddest) {
  vec3 own = log(max(land, vec3(1e-6)) / max(lit, vec3(1e-6)));
  vec2 red = max(own.r - own.gb, vec2(0.0));
  own.gb += red - red * inversesqrt(1.0 + red * red / (reddest * reddest));
  vec3 color = lit * exp(own);
  return color * (GetLuminance(land) / max(GetLuminance(color), 1e-9));
}

// Limits the blue of land that air or a camera have made blue: under another light nothing else would be as blue.
vec3 LimitBlue(vec3 land) {
  float blue = max(log2(land.b / max(max(land.r, land.g), 1e-9)), 0.0);
  float kept = inversesqrt(1.0 + blue * blue / (kBluestLand * kBluestLand));
  vec3 color = pow(max(land, vec3(1e-9)), vec3(kept));
  return color * (GetLuminance(land) / max(GetLuminance(color), 1e-9));
}

// Replaces unreliable color. The more the light's color changes, the less is known of the land's own; and dark pixels
// of the photo are half noise and half lens glare: both take on the color of their light, `lit`, and dark pixels
// brighten less. Land colored by the old sun's glare (`glare` is its share) gets the average land color, and so does land
// at the skyline (1 there), colored by an evening's sky, as the evening ends.
vec3 ReplaceGuessedColor(vec3 land, vec3 before, vec3 ratio, vec3 lit, float glare, float skyline) {
  float level = GetLuminance(land);
  float dark = 1.0 - smoothstep(0.0, kDarkLand, GetLuminance(before));
  float lift = max(log2(max(GetExposureGain() * level, 1e-9) / max(GetLuminance(before), 1e-9)) - exposure, 0.0);
  // Without a sky the light on the land is unknown.
  float known = GetSkySeen();
  float turned = known * GetTurned(ratio, before);
  float rises = GetRisen(GetSunBefore(), GetDescribedSun());
  // Where an evening is only assumed the land may be red or yellow itself.
  float risen = known * rises * GetBelief();
  float evening = risen * GetEveningBalance();
  float changed = max(turned, risen);  // how far the light has become another
  float day = smoothstep(kRises.x, kRises.y, GetSunBefore().y);
  float unknown = max(turned - kDayKnows * day * turned, risen);
  float guessed = max(kLitColor * unknown, dark * lift * lift / (lift * lift + 4.0));
  // A balance that the photo's light has shifted does not apply to another light.
  vec3 color = RemoveBalance(lit, max(max(kBalanceLost * turned, evening), GetVividness()));
  land += guessed * (color * (level / GetLuminance(color)) - land);
  vec3 mean = GetSceneLight(photo_land_linear_mean);
  vec3 usual = mix(color / GetLuminance(color), mean * ratio / max(GetLuminance(mean * ratio), 1e-9),
                   smoothstep(0.0, kDarkLand, GetLuminance(mean)));
  // As the light changes, its own color replaces the average: that of an evening's land was the evening's.
  usual = mix(usual / GetLuminance(usual), color / GetLuminance(color), changed);
  float ends = known * GetEveningsEnd(GetDayBegun(GetDescribedSun().y, rises));
  land += max(glare, skyline * ends) * (usual * level - land);
  vec2 reddest = kReddestLand * (1.0 - kEveningsRed * max(evening, ends));
  land = mix(land, RemoveGlow(land, color, reddest), unknown);
  land = mix(land, LimitBlue(land), changed);
  float albedo = 3.14159265 * level / max(GetLuminance(lit), 1e-9);
  float beyond = max(albedo - kWhitePaint.x, 0.0) / (kWhitePaint.y - kWhitePaint.x);
  float most = kWhitePaint.x + (kWhitePaint.y - kWhitePaint.x) * beyond / (1.0 + beyond);
  land *= mix(1.0, min(most / max(albedo, 1e-6), 1.0), max(turned - day * turned, risen));
  return land * exp2(-dark * lift * lift / (lift + 3.0));
}

// `clean` is the land's light without the old sun's glare, `lit` its irradiance now, `mirror` the share of mirrored
// light, which follows `mirror_ratio`, `glare` the removed share,
// `skyline` 1 where the pixel shows sky, too.
vec3 GetLandChange(vec3 light, vec3 clean, vec3 land_ratio, vec3 lit, float mirror, vec3 mirror_ratio, float glare,
                   float skyline) {
  land_ratio += mirror * (mirror_ratio - land_ratio);
  vec3 land = max(GetLandGain() * land_ratio * clean, vec3(0.0));
  float luminance = GetLuminance(land);
  // (C / L - 1) s + 1, or (C / L)^s, times L with s = 1 - GetColorLoss().
  vec3 color = max(land / max(luminance, 1e-9), vec3(1e-4));
  vec3 lost = colour_loss == 1 ? luminance * (pow(color, vec3(1.0 - GetColorLoss())) - color)
      : GetColorLoss() * (vec3(luminance) - land);
  land = max(land + step(1e-9, abs(GetColorLoss())) * lost, vec3(0.0));
  land = ReplaceGuessedColor(land, max(clean, vec3(1e-6)), land_ratio, lit, glare, skyline);
  float uneven = log2(max(GetLuminance(clean), 1e-4) / max(GetLuminance(GetSceneLight(photo_land_linear_mean)), 1e-4));
  // Under a sun that is only assumed, more contrast would light land that is before the new sun from the front.
  land = TurnColor(land, GetSkySeen() * GetDuskLandTurn(GetSunBefore(), GetDescribedSun())
      + GetLowLandTurn(max(1.0 - GetSkySeen(), sun_visible) * uneven, GetSkySeen(), GetSunBefore(), GetDescribedSun()));
  return land_strength * (GetExposureGain() * land - light);
}
