// The added clouds' layer: where it is and how much of it there is. It lies at one height above a
// round earth, so that it keeps its perspective and ends at the horizon.

#include "lib/cloud_noise.glsl"

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

// How far the field of clouds rises over the threshold that leaves the wanted share of the sky:
// > 0 is cloud, about 0.25 the middle of a large one. `octave_share` is how much of the third
// octave counts.
float GetCoverField(vec2 at, float octave_share) {
  vec3 p = vec3(0.5 * at, 0.7 * cloud_pattern);
  // Warped by itself, clouds get lobes and gaps instead of round blots.
  float bend = GetNoise(0.7 * p + vec3(19.7, 3.1, 7.3));
  p.xy += 0.5 * vec2(bend, -bend);
  float field = GetNoise(p) + 0.5 * GetNoise(2.03 * p + vec3(5.2, 1.3, 8.1))
      + 0.25 * octave_share * GetNoise(4.1 * p + vec3(1.7, 9.2, 2.8));
  // The field is normal with deviation 0.22 (measured); the logistic's quantile is within 2 %.
  float share = mix(0.003, 0.997, added_clouds);
  return field + 0.13 * log(share / (1.0 - share));
}

// Opacity of the added clouds in this direction, as it hides the sun; without fine detail.
float GetAddedCover(vec3 view) {
  if (added_clouds <= 0.0) return 0.0;
  float far = GetDistanceToLevel(view.y, added_cloud_height);
  float field = GetCoverField(GetLayerPlace(far * view.xz), 1.0);
  float depth = clamp(field / 0.3, 0.0, 1.0);
  float above = smoothstep(-0.004, 0.004, view.y);
  return above * smoothstep(0.0, 0.02, added_clouds) * (1.0 - exp(-5.0 * depth));
}
