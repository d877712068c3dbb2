// How a pixel's water changes with the sun (method "ratio"): the sky that it mirrors changes, the old
// sun's glints go and the new sun's come (mirror_ratio.glsl).

#include "lib/hash.glsl"
#include "lib/relit_land.glsl"
#include "lib/matched_sky.glsl"

uniform sampler2D terms;
uniform float water_strength;
uniform float glitter;
uniform float source_glitter;
uniform float wind_speed;
uniform float source_wind_speed;
uniform float wind_direction;
uniform float source_wind_direction;

// Brightest a pixel of glints gets, as radiance per unit of the sun's light, 1/sr. Far below what one
// facet shows of the sun: no pixel is as small, and a camera would show no more.
const float kBrightest = 1.0;
// Height of a wave in the picture, in radians: a part for the horizon, and a share of how far below
// the horizon it lies. Waves look several times as wide as high.
const float kFarWave = 0.0011;
const float kNearWave = 0.035;
const float kWaveWidth = 5.0;

float GetWave(int row, float column) {
  float cell = floor(column);
  float share = column - cell;
  uint seed = Hash(uint(row));
  float left = float(Hash(seed + uint(int(cell))) >> 8u);
  float right = float(Hash(seed + uint(int(cell) + 1)) >> 8u);
  return mix(left, right, share * share * (3.0 - 2.0 * share)) / 16777216.0;
}

// A pattern of waves in [0, 1] that lies on the water in perspective; it does not know the sun, so
// that glints stay on their waves while the sun is dragged.
float GetWaves(float azimuth, float depth, float size) {
  float far = size * kFarWave;
  float row = log(1.0 + depth * kNearWave / far) / kNearWave;
  float first = floor(row);
  float share = row - first;
  // Width of the waves of these two rows.
  vec2 width = kWaveWidth * far * exp(kNearWave * (vec2(first, first + 1.0)));
  vec2 column = azimuth / width + vec2(mod(first, 7.0), mod(first + 1.0, 7.0)) * 0.37 + 4096.0;
  return mix(GetWave(int(first), column.x), GetWave(int(first) + 1, column.y), share * share * (3.0 - 2.0 * share));
}

// What waves make of glints of mean radiance one: near ones are larger than a pixel and glint one by
// one, far ones blend. Log-normal, as the facets that happen to face the sun are few.
float GetSparkle(vec3 view, float own_wave) {
  float depth = max(-view.y, 0.0);
  float azimuth = atan(view.x, max(view.z, 1e-3));
  float waves = 0.45 * GetWaves(azimuth, depth, 1.0) + 0.33 * GetWaves(azimuth, depth, 0.41)
      + 0.22 * GetWaves(azimuth, depth, 0.17) - 0.5;
  float near = smoothstep(0.0, 0.1, depth);
  return exp(mix(4.0, 7.0, near) * waves + mix(1.5, 4.0, near) * (own_wave - 0.5) - mix(0.3, 1.0, near));
}

// How far the glints are others than the photo's, 0 to 1: with the sun, the wind and their slider.
float GetGlitterChange() {
  float wind = 0.5 * abs(wind_speed - source_wind_speed) + 0.05 * abs(wind_direction - source_wind_direction);
  return max(term[0].y, clamp(2.0 * abs(glitter - source_glitter) + wind, 0.0, 1.0));
}

// `light` of the photo's water becomes the light under the new sun. `clean` is the water without the
// old glints (water_behind.glsl), `mark` where those lie,
// `wave` how bright a wave is here, `mirror` what mirror_ratio.glsl says.
vec3 GetWaterChange(vec3 light, vec3 clean, float mark, float wave, vec4 mirror, vec3 air, vec3 view) {
  float changed = GetGlitterChange();
  vec3 calm = light + changed * mark * (clean - light);
  float shown = mirror.a * GetSparkle(view, wave);
  // The sun's own colour: what tints the photo's sky would dye what is nearly white.
  vec3 sun = texelFetch(terms, ivec2(12, 0), 0).rgb / sky_gain * GetLuminance(sky_gain);
  vec3 glints = changed * shown / (1.0 + shown / kBrightest) * sun;
  vec3 relit = max(calm * mirror.rgb + air, vec3(0.0)) + glints;
  return land_strength * (term[0].x * relit - light);
}
