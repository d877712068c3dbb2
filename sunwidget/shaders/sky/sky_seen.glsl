// Whether the photo shows a sky that tells what light it stands in.

uniform float sky_share;  // of the picture

// Where none does, the land changes as one, and by this share of stops.
const float kRestraint = 0.6;
// Shares of which nothing and all is told.
const float kNoSky = 0.005;
const float kSomeSky = 0.03;

float GetSkySeen() {
  return smoothstep(kNoSky, kSomeSky, sky_share);
}

// Of the stops by which light and exposure change.
float GetRestraint() {
  return mix(kRestraint, 1.0, GetSkySeen());
}
