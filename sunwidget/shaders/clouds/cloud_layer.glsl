// The added clouds' layer: where it is and how much of it there is. It lies at one height above a
// round earth, so that it keeps its perspective and ends at the horizon.

#include "clouds/cloud_noise.glsl"

uniform float added_clouds;        // share of the sky, [0, 1]
uniform float added_cloud_size;    // km
uniform float added_cloud_height;  // km above the camera
uniform float cloud_pattern;
uniform float wind_speed;          // m/s
uniform float wind_direction;      // degrees, where it blows to, + right of the heading
uniform float wind_time;           // min

const float kEarthRadius = 6371.0;  // km

// Kilometres to where a view ray meets a level `height` km above the camera.
float GetDistanceToLevel(float rise, float height) {
  float down = kEarthRadius * rise;
  return sqrt(down * down + height * (2.0 * kEarthRadius + height)) - down;
}

// Position in the layer, in cloud sizes, that has drifted with the wind to this place (km).
vec2 GetLayerPlace(vec2 kilometres) {
  float turn = radians(wind_direction);
  vec2 drift = 0.06 * wind_speed * wind_time * vec2(sin(turn), cos(turn));
  return (kilometres - drift) / added_cloud_size;
}

// Warped by this, the field gets lobes and gaps instead of round blots.
vec2 GetWarp(vec2 at) {
  float bend = 0.5 * GetNoise(vec3(0.35 * at, 0.49 * cloud_pattern) + vec3(19.7, 3.1, 7.3));
  return vec2(bend, -bend);
}

// The field that is cloud where it is positive, 0.25 in the middle of a large one. `known` is how
// much of its two finer octaves counts: what is smaller than a pixel is left out.
float GetCoverField(vec2 at, vec2 warp, vec2 known) {
  vec3 p = vec3(0.5 * at + warp, 0.7 * cloud_pattern);
  float field = GetNoise(p);
  if (known.x > 0.0) field += 0.5 * known.x * GetNoise(2.03 * p + vec3(5.2, 1.3, 8.1));
  if (known.y > 0.0) field += 0.25 * known.y * GetNoise(4.1 * p + vec3(1.7, 9.2, 2.8));
  // It is normal with deviation 0.22 (measured); the logistic's quantile is within 2 % of that.
  float share = mix(0.003, 0.997, added_clouds);
  return field + 0.13 * log(share / (1.0 - share));
}

// Opacity of the added clouds in this direction, as it hides the sun; without fine detail.
float GetAddedCover(vec3 view) {
  if (added_clouds <= 0.0) return 0.0;
  float far = GetDistanceToLevel(view.y, added_cloud_height);
  vec2 at = GetLayerPlace(far * view.xz);
  float field = GetCoverField(at, GetWarp(at), vec2(1.0));
  float above = smoothstep(-0.004, 0.004, view.y);
  return above * smoothstep(0.0, 0.02, added_clouds) * (1.0 - exp(-16.0 * max(field, 0.0)));
}
