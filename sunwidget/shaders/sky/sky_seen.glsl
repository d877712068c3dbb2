// Whether the photo shows enough sky to reveal its light.

uniform float sky_share;  // of the picture

// Without a visible sky, the land changes uniformly: by day, when its light is a guess, by this share of the stops,
// and fully at dusk, when no sun is left to guess.
const float kRestraint = 0.6;
const vec2 kDusk = vec2(-4.0, 3.0);  // degrees of the sun
// Shares of sky that reveal nothing, and everything.
const float kNoSky = 0.005;
const float kSomeSky = 0.03;

float GetSkySeen() {
  return smoothstep(kNoSky, kSomeSky, sky_share);
}

// 0 by day, 1 when the sun is well below the horizon.
float GetDusk(float height) {
  return 1.0 - smoothstep(kDusk.x, kDusk.y, height);
}

// Factor on the stops by which light and exposure change.
float GetRestraint(float height) {
  return mix(kRestraint, 1.0, max(GetSkySeen(), GetDusk(height)));
}
