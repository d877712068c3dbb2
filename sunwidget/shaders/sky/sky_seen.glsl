// Whether the photo shows enough sky to reveal its light.

uniform float sky_share;  // of the picture

// Without a visible sky, the land changes uniformly, by this share of the stops.
const float kRestraint = 0.6;
// Shares of sky that reveal nothing, and everything.
const float kNoSky = 0.005;
const float kSomeSky = 0.03;

float GetSkySeen() {
  return smoothstep(kNoSky, kSomeSky, sky_share);
}

// Factor on the stops by which light and exposure change.
float GetRestraint() {
  return mix(kRestraint, 1.0, GetSkySeen());
}
