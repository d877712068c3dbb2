// The air in front of the land (aerial perspective): how its light changes with the sun, and how more or less haze
// changes all land. Its share of a pixel's light is seen in the photo (analysis/haze.py).

#include "atmosphere/atmosphere.glsl"
#include "atmosphere/extinction.glsl"
#include "sky/tint.glsl"
#include "sky/sky_seen.glsl"

uniform sampler2D air_source;
uniform sampler2D air_edit;
uniform float aerial_perspective;

// Large depths are guesses: distances are compressed to at most this.
const float kFarthestAir = 15000.0;  // m
// Most of the air's light that less haze takes away.
const float kLargestShare = 0.9;
// Sine of the height at which air in front of land is lit as the sky.
const float kLevelAir = 0.01;
// Sine of the sun's height below which the near air is as dark as the land.
const float kAirDark = -0.05;

int GetAirColumn(vec2 place) {
  return int(place.x * float(textureSize(air_edit, 0).x));
}

// The new sky at the horizon, without the tint that it loses and, by day, without the evening's balance.
vec3 GetHorizon(int column) {
  vec3 before = texelFetch(air_source, ivec2(column, 0), 0).rgb;
  vec3 now = texelFetch(air_edit, ivec2(column, 0), 0).rgb;
  float lost = GetLostTint(before, now);
  float evening = GetRisen(GetSunBefore(), GetDescribedSun()) * GetEveningBalance();
  vec3 sky = RemoveEvening(RemoveLostTint(now, lost), lost, evening);
  return sky * (GetLuminance(now) / GetLuminance(sky));
}

// Weight of the air's own change: its share of the light, `share`. Below the horizon the sun leaves the near air dark
// while the far sky glows, so that the air changes as the land.
float GetAirShare(float share) {
  return GetSkySeen() * aerial_perspective * share * smoothstep(kAirDark, 0.0, GetDescribedSun().y);
}

// Light that relit land, `light`, gains with more haze than the photo's: with t = exp(-extinction * distance) (Koschmieder
// 1924), light = J t + A (1 - t) becomes J t' + A (1 - t'). `horizon` is A, the new sky there. Less haze
// takes away at most what `share` says is air.
vec3 GetHazeChange(vec3 horizon, float log_depth, vec3 light, float share) {
  float distance = exp2(16.0 * log_depth);
  distance = distance * kFarthestAir / (distance + kFarthestAir);
  vec3 more = GetExtinction(air_density, aerosol_optical_depth, aerosol_scale_height, angstrom_exponent)
      - GetExtinction(source_air_density, source_aerosol_optical_depth, source_aerosol_scale_height,
                      source_angstrom_exponent);
  vec3 kept = min(exp(-distance * more), vec3(1.0 / (1.0 - kLargestShare * share)));
  return GetSkySeen() * aerial_perspective * (1.0 - kept) * (horizon - light);
}
