// The air in front of distant land (aerial perspective), from the strips of air.glsl.

#include "atmosphere/atmosphere.glsl"
#include "atmosphere/extinction.glsl"
#include "sky/tint.glsl"
#include "sky/sky_seen.glsl"

uniform sampler2D air_source;
uniform sampler2D air_edit;
uniform float aerial_perspective;

// Large depths are guesses: distances are compressed to at most this.
const float kFarthestAir = 15000.0;  // m
// A pixel is no darker than the air in front of it, so at most this share of it is air.
const float kLargestShare = 0.9;

int GetAirColumn(vec2 place) {
  int columns = textureSize(air_edit, 0).x;
  return clamp(int(place.x * float(columns)), 0, columns - 1);
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

// Light that the air adds to relit land when sun or haze change. `light` is the pixel's light, `gain` the
// land's own ratio, `horizon` the new sky there. Koschmieder 1924: I = J t + A (1 - t) with
// t = exp(-extinction * distance). The land without its air, I - A (1 - t), takes the ratio, and the new air is
// added: I gain - A (1 - t) gain + A' (1 - t'). Nothing is divided by t.
vec3 GetAirChange(int column, vec3 horizon, float log_depth, vec3 light, vec3 gain) {
  float distance = exp2(16.0 * log_depth);
  distance = distance * kFarthestAir / (distance + kFarthestAir);
  vec3 share_before = 1.0 - exp(-distance * GetExtinction(source_air_density, source_aerosol_optical_depth,
      source_aerosol_scale_height, source_angstrom_exponent));
  vec3 share_now = 1.0 - exp(-distance * GetExtinction(air_density, aerosol_optical_depth,
      aerosol_scale_height, angstrom_exponent));
  vec3 air_before = texelFetch(air_source, ivec2(column, 0), 0).rgb;
  vec3 before = share_before * air_before;
  float believed = min(kLargestShare * GetLuminance(light) / max(GetLuminance(before), 1e-12), 1.0);
  // If the photo's air has another color than the model's, only as much is removed as the pixel holds.
  vec3 held = min(believed * before, kLargestShare * light);
  vec3 change = share_now * horizon / max(before, vec3(1e-12));
  vec3 added = held * change + (believed * before - held) * max(change - 1.0, 0.0);
  vec3 removed = gain * held;
  return GetSkySeen() * aerial_perspective * mix(added - removed, vec3(0.0), equal(added, removed));
}
