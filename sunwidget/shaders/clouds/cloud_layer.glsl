// Position and cover of the layer of added clouds. It lies at one height above a
// spherical earth, so that it keeps its perspective and ends at the horizon.

#include "clouds/cloud_noise.glsl"

uniform float added_clouds;        // share of the sky, [0, 1]
uniform float added_cloud_size;    // km
uniform float added_cloud_height;  // km above the camera
uniform float cloud_pattern;
uniform float wind_speed;          // m/s
uniform float wind_direction;      // direction towards which it blows, degrees, + right of the heading
uniform float wind_time;           // min

const float kEarthRadius = 6371.0;  // km

// Distance (km) at which a view ray reaches a level `height` km above the camera. `rise` is the sine of its elevation.
float GetDistanceToLevel(float rise, float height) {
  float down = kEarthRadius * rise;
  return sqrt(down * down + height * (2.0 * kEarthRadius + height)) - down;
}

// Position in the layer, in cloud sizes, of the point that the wind has moved to this place (km).
vec2 GetLayerPlace(vec2 kilometers) {
  float turn = radians(wind_direction);
  vec2 drift = 0.06 * wind_speed * wind_time * vec2(sin(turn), cos(turn));
  return (kilometers - drift) / added_cloud_size;
}

// Warp that gives the field lobes and gaps instead of round blobs.
vec2 GetWarp(vec2 at) {
  float bend = 0.5 * GetNoise(vec3(0.35 * at, 0.49 * cloud_pattern) + vec3(19.7, 3.1, 7.3));
  return vec2(bend, -bend);
}

// Cover field, positive inside clouds and 0.25 in the middle of a large one. `detail` is the
// weight of its two finer octaves: structure smaller than a pixel is omitted.
float GetCoverField(vec2 at, vec2 warp, vec2 detail) {
  vec3 p = vec3(0.5 * at + warp, 0.7 * cloud_pattern);
  float field = GetNoise(p);
  if (detail.x > 0.0) field += 0.5 * detail.x * GetNoise(2.03 * p + vec3(5.2, 1.3, 8.1));
  if (detail.y > 0.0) field += 0.25 * detail.y * GetNoise(4.1 * p + vec3(1.7, 9.2, 2.8));
  // The field is normal with deviation 0.22 (measured); the logistic quantile is within 2 % of the normal one.
  float share = mix(0.003, 0.997, added_clouds);
  return field + 0.13 * log(share / (1.0 - share));
}

// Opacity of the added clouds in this direction, for hiding the sun; without fine detail.
float GetAddedCover(vec3 view) {
  if (added_clouds <= 0.0) return 0.0;
  float far = GetDistanceToLevel(view.y, added_cloud_height);
  vec2 at = GetLayerPlace(far * view.xz);
  float field = GetCoverField(at, GetWarp(at), vec2(1.0));
  float above = smoothstep(-0.004, 0.004, view.y);
  return above * smoothstep(0.0, 0.02, added_clouds) * (1.0 - exp(-16.0 * max(field, 0.0)));
}
