// Waves as a pattern of the parts of water that glint. It does not depend on the sun, so glints stay on
// their waves while the sun is dragged.

#include "frame/hash.glsl"

// Height of a wave in the picture, in radians: its height at the horizon, plus a share of its depth below
// the horizon. Waves look several times as wide as high.
const float kFarWave = 0.0011;
const float kNearWave = 0.035;
const float kWaveWidth = 5.0;
// Least height of waves in brightness, natural logarithm (water/water_level.glsl).
const float kLowestWave = 0.02;

float GetWave(int row, float column) {
  float cell = floor(column);
  float share = column - cell;
  uint seed = Hash(uint(row));
  float left = float(Hash(seed + uint(int(cell))) >> 8u);
  float right = float(Hash(seed + uint(int(cell) + 1)) >> 8u);
  return mix(left, right, share * share * (3.0 - 2.0 * share)) / 16777216.0;
}

// A pattern of waves in [0, 1] on the water in perspective. `azimuth` and `depth` below the
// horizon are in radians.
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

// Log of the radiance of glints on waves, for glints of mean radiance one: near waves are larger than a pixel
// and glint one by one, far ones blend. Log-normal, because few facets happen to face the sun.
// `own_wave` is the brightness of the photo's own wave here, 0.5 for the mean.
float GetLogSparkle(vec3 view, float own_wave) {
  float depth = max(-view.y, 0.0);
  float azimuth = atan(view.x, max(view.z, 1e-3));
  float waves = 0.45 * GetWaves(azimuth, depth, 1.0) + 0.33 * GetWaves(azimuth, depth, 0.41)
      + 0.22 * GetWaves(azimuth, depth, 0.17) - 0.5;
  float near = smoothstep(0.0, 0.1, depth);
  return mix(4.0, 7.0, near) * waves + mix(1.5, 4.0, near) * (own_wave - 0.5) - mix(0.3, 1.0, near);
}

// The log-sparkle as a code in [0, 1] for eight bits: steps of 4 %.
float EncodeSparkle(float log_sparkle) {
  return clamp((log_sparkle + 5.0) / 9.0, 0.0, 1.0);
}

float DecodeSparkle(float code) {
  return exp(9.0 * code - 5.0);
}
