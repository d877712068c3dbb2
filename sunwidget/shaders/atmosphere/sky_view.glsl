// Radiance of the sky around the camera, without the sun's disc: azimuth from the sun along x
// (half the circle; the other half mirrors it), elevation along y, zenith in row 0, everything
// divided by GuessRadiance. See atmosphere/read_sky_view.glsl for the layout and the description in the last row.
// Below the horizon it shows the ground seen through airlight.

#include "atmosphere/sky_description.glsl"
#include "atmosphere/sky_march.glsl"

uniform vec2 pass_size;
uniform vec2 tile_origin;
out vec4 result;

void main() {
  vec2 texel = gl_FragCoord.xy + tile_origin - 0.5;
  SkyView view = DescribeSky();
  ivec2 rows = GetSkyViewRows(int(pass_size.y));
  int row = int(texel.y + 0.5);
  int column = int(texel.x + 0.5);
  if (row == rows.y) {
    result = GetDescriptionTexel(view, column);
    return;
  }
  float h = GetCameraHeight();
  float elevation = GetElevationOfRow(float(row), rows, view.horizon);
  float azimuth = GetAzimuthOfColumn(float(column) / (pass_size.x - 1.0));
  float mu = sin(elevation);
  if (row == rows.x - 1) {
    mu = GetCosineOfHorizon(h);  // exactly grazing, from above
  } else if (row == rows.x) {
    mu = GetCosineOfHorizon(h) - 1e-6;  // and from below
  }
  float mu_s = view.sun.y;
  float nu = mu * mu_s + cos(elevation) * sqrt(max(1.0 - mu_s * mu_s, 0.0)) * cos(azimuth);
  result = ComputeSkyRadiance(h, mu, mu_s, nu) / GuessRadiance(view, nu);
}
