// Change of a pixel's water with the sun (method "ratio"): the mirrored sky changes, and the new
// sun's glints replace the old sun's (mirror_ratio.glsl).

#include "water/waves.glsl"
#include "land/relit_land.glsl"
#include "sky/tint.glsl"
#include "sky/low_sun.glsl"
#include "camera/bright_air.glsl"
#include "camera/beside_sun.glsl"

// Share of the color of the sky at the horizon in water whose color has changed.
const float kMirroredColor = 0.7;
const float kMirroredAbove = 0.05;  // sine of the height
const vec2 kBlueWater = vec2(-2.5, -1.2);  // log of red over blue, relative to the sky

uniform float water_strength;
uniform float glitter;
uniform float source_glitter;
uniform float wind_speed;
uniform float source_wind_speed;
uniform float wind_direction;
uniform float source_wind_direction;

// Median color of the glare of 56 photos' suns, of luminance 1, and less blue, as readers prefer: glints are no redder.
const vec3 kReddestGlints = vec3(2.0, 0.8, 0.12);

// Where facets that mirror the sun are common, a pixel shows their light only bounded, or it would burn: its sparkle
// to the power 1 - kEven, times kSparse / kCommon. With all of it bounded alike (a power of 0), a column is a flat bar.
const float kEven = 0.65;
const float kSparse = 1.2;
const float kCommon = 1.8;

// How far new glints replace the photo's, 0 to 1, after changes of the sun, the wind or the slider.
float GetGlitterChange() {
  float wind = 0.5 * abs(wind_speed - source_wind_speed) + 0.05 * abs(wind_direction - source_wind_direction);
  return max(GetMoved(), clamp(2.0 * abs(glitter - source_glitter) + wind, 0.0, 1.0));
}

// The change of the water's `light` under the new sun. `clean` is the water without the
// old glints (water_behind.glsl), `mark` their place, `sparkle` the effect of waves on
// the new ones, `mirror` the texel of mirror_ratio.glsl, `sky` the new sky at the horizon.
vec3 GetWaterChange(vec3 view, vec3 light, vec3 clean, float mark, float sparkle, vec4 mirror, vec3 sky) {
  float changed = GetGlitterChange();
  // Glints are added light: what is darker than the water behind them stands in front of it. It takes the water's
  // color, since channel by channel orange glints leave a green sea.
  float dark = min(GetLuminance(light) / max(GetLuminance(clean), 1e-6), 1.0);
  vec3 calm = light + changed * mark * (dark * clean - light);
  float bright = DecodeSparkle(sparkle);
  // The sun's own color: the tint of the photo's sky would color glints that are nearly white.
  vec3 sun = texelFetch(composite_constants, ivec2(kWaterSunNow, 0), 0).rgb / sky_gain * GetLuminance(sky_gain);
  // The photo's own glints tell how bright they are at least: they are far brighter than white, however low the sun.
  float level = GetLuminance(sun);
  sun = LimitRed(sun / level, kReddestGlints) * max(level, texelFetch(composite_constants, ivec2(kGlare, 0), 0).a);
  vec3 glints = changed * kSparse * mirror.a * bright / (1.0 + kCommon * mirror.a * pow(bright, kEven)) * sun;
  vec3 relit = max(calm * mirror.rgb, vec3(0.0));
  // As in the sky (sky/tint.glsl), the water's excess color over the model fades. Blue is the water's own.
  float redder = log(max(relit.r * sky.b, 1e-9) / max(relit.b * sky.r, 1e-9));
  float warmer = GetWarmth(relit, sky) * smoothstep(kBlueWater.x, kBlueWater.y, redder);
  float risen = GetRisen(GetSunBefore(), GetDescribedSun());
  float faded = max(kMirroredColor * GetTurned(mirror.rgb, max(calm, vec3(1e-6))), risen * warmer);
  relit += faded * (sky * (GetLuminance(relit) / GetLuminance(sky)) - relit);
  // By day it mirrors the sky near the horizon, at dusk that as high above the horizon as the water lies below it,
  // and a little higher.
  vec3 mirrored = normalize(vec3(view.x, kMirroredAbove - view.y, view.z));
  relit = TurnToPhotos(relit, calm, 0.0, 0.0, mirrored, 0.0, GetSunBefore(), GetDescribedSun(), risen);
  relit = CompressBrightAir(relit, calm, 1.0);
  relit = FitBesideSun(relit, calm, 0.0, dot(mirrored, GetDescribedSun()));
  relit += glints;
  return land_strength * (GetExposureGain() * relit - light);
}
