// How a pixel's water changes with the sun (method "ratio"): the sky that it mirrors changes, the old
// sun's glints go and the new sun's come (mirror_ratio.glsl).

#include "water/waves.glsl"
#include "land/relit_land.glsl"
#include "sky/tint.glsl"

// How much of the color of water that has turned is that of the sky at the horizon.
const float kMirroredColor = 0.7;

uniform float water_strength;
uniform float glitter;
uniform float source_glitter;
uniform float wind_speed;
uniform float source_wind_speed;
uniform float wind_direction;
uniform float source_wind_direction;

// Brightest a pixel of glints gets, as radiance per unit of the sun's light, 1/sr. Far below what one
// facet shows of the sun: no pixel is as small, and a camera would show no more.
const float kBrightest = 0.4;

// How far the glints are others than the photo's, 0 to 1: with the sun, the wind and their slider.
float GetGlitterChange() {
  float wind = 0.5 * abs(wind_speed - source_wind_speed) + 0.05 * abs(wind_direction - source_wind_direction);
  return max(GetMoved(), clamp(2.0 * abs(glitter - source_glitter) + wind, 0.0, 1.0));
}

// `light` of the photo's water becomes the light under the new sun. `clean` is the water without the
// old glints (water_behind.glsl), `mark` where those lie, `sparkle` what waves make of
// the new ones, `mirror` what mirror_ratio.glsl says, `sky` the new one at the horizon.
vec3 GetWaterChange(vec3 light, vec3 clean, float mark, float sparkle, vec4 mirror, vec3 air, vec3 sky) {
  float changed = GetGlitterChange();
  vec3 calm = light + changed * mark * (clean - light);
  float shown = mirror.a * DecodeSparkle(sparkle);
  // The sun's own color: what tints the photo's sky would dye what is nearly white.
  vec3 sun = texelFetch(composite_constants, ivec2(kWaterSunNow, 0), 0).rgb / sky_gain * GetLuminance(sky_gain);
  vec3 glints = changed * shown / (1.0 + shown / kBrightest) * sun;
  vec3 relit = max(calm * mirror.rgb + air, vec3(0.0));
  sky = RemoveBalance(sky, GetRisen(GetSunBefore(), GetDescribedSun()) * GetEveningBalance());
  // As in the sky (sky/tint.glsl): color that the photo's water has beyond the model's fades.
  float level = GetLuminance(relit);
  relit += kMirroredColor * GetTurned(mirror.rgb, max(calm, vec3(1e-6))) * (sky * (level / GetLuminance(sky)) - relit);
  relit += glints;
  return land_strength * (GetExposureGain() * relit - light);
}
