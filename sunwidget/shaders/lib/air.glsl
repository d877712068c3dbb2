// The air before distant land (aerial perspective), by the strips that air.glsl draws.

#include "lib/atmosphere.glsl"
#include "lib/extinction.glsl"
#include "lib/tint.glsl"

uniform sampler2D air_source;
uniform sampler2D air_edit;
uniform float aerial_perspective;

// Depth is a guess where it is large: beyond this it counts ever less.
const float kFarthestAir = 15000.0;  // m
// A pixel is no darker than the air before it, so that this share of it at most is air.
const float kLargestShare = 0.9;

// What the air adds to relit land when sun or haze change. `light` is the pixel's light, `gain` the
// land's own ratio. Koschmieder 1924: I = J t + A (1 - t) with t = exp(-extinction * distance), so
// that the land without its air, I - A (1 - t), takes the ratio and the new air comes before it:
// I gain - A (1 - t) gain + A' (1 - t'). Nothing is divided by t.
vec3 GetAirChange(vec2 place, float log_depth, vec3 light, vec3 gain) {
  float distance = exp2(16.0 * log_depth);
  distance = distance * kFarthestAir / (distance + kFarthestAir);
  int column = clamp(int(place.x * float(textureSize(air_source, 0).x)), 0, textureSize(air_source, 0).x - 1);
  vec3 share_before = 1.0 - exp(-distance * GetExtinction(source_air_density, source_aerosol_optical_depth,
      source_aerosol_scale_height, source_angstrom_exponent));
  vec3 share_now = 1.0 - exp(-distance * GetExtinction(air_density, aerosol_optical_depth,
      aerosol_scale_height, angstrom_exponent));
  vec3 air_before = texelFetch(air_source, ivec2(column, 0), 0).rgb;
  vec3 air_now = texelFetch(air_edit, ivec2(column, 0), 0).rgb;
  vec3 before = share_before * air_before;
  vec3 room = light / max(before, vec3(1e-12));
  float believed = min(kLargestShare * min(min(room.r, room.g), room.b), 1.0);
  vec3 taken = gain * (believed * before);
  vec3 given = believed * (share_now * WithoutLostTint(air_before, air_now));
  return aerial_perspective * mix(given - taken, vec3(0.0), equal(given, taken));
}
