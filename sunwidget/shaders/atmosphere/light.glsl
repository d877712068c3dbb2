// The light at the camera, nine texels:
//   0  sky's irradiance on a horizontal surface            4  ... on one that faces left
//   1  sun's irradiance at normal incidence, times the     5  ... on one that faces away
//      visible share of its disc                           6  mean radiance of the sky ahead
//   2  sky's irradiance on an upright surface that faces   7  sun's irradiance at normal
//      the camera                                             incidence, as if fully risen
//   3  ... on one that faces right                        8  as 1, at the heights of clouds
// in W m^-2 nm^-1 (6: W m^-2 sr^-1 nm^-1). Upright surfaces see the sky above the horizon only,
// not the ground. "Ahead" weights each direction by its cosine to the heading.

#include "atmosphere/read_sky_view.glsl"

uniform float altitude;  // m
uniform vec2 tile_origin;
uniform sampler2D sky_view;
uniform sampler2D columns;
out vec4 result;

// Every second row and every fourth column: trapezoids over the sky view's own samples.
const int kColumnStride = 4;
// Clouds stay sunlit after sunset on the land, the longer the higher they are: down to 1.2 degrees
// for cumulus (1.5 km), 3 for cirrus (9 km). Their number decreases with height, so that their light
// fades without a jump.
const Length kLowestCloud = 1500.0;
const Length kHighestCloud = 15000.0;
const int kCloudLevels = 16;

// Weight of the light from `direction` in texel `index`.
Number GetWeight(int index, vec3 direction) {
  float cosine = index == 0 ? direction.y
      : index == 2 ? -direction.z
      : index == 3 ? direction.x
      : index == 4 ? -direction.x
      : direction.z;
  return max(cosine, 0.0);
}

vec4 IntegrateSky(int index) {
  SkyView view = ReadSkyView(sky_view);
  ivec2 size = textureSize(sky_view, 0);
  ivec2 rows = GetSkyViewRows(size.y);
  float level = length(view.sun.xz);
  vec2 towards = level > 1e-6 ? view.sun.xz / level : vec2(0.0, 1.0);
  vec2 across = vec2(towards.y, -towards.x);
  int last_column = (size.x - 1) / kColumnStride;
  vec4 sum = vec4(0.0);
  float norm = 0.0;
  for (int row = 0; row < rows.x; ++row) {
    float v = 1.0 - float(row) / float(rows.x - 1);
    float elevation = GetElevationOfRow(float(row), rows, view.horizon);
    // d elevation: derivative of the square-root scale; trapezoid ends count half.
    float span = 2.0 * (0.5 * kPi - view.horizon) * v / float(rows.x - 1);
    span *= row == 0 ? 0.5 : 1.0;
    float rise = cos(elevation);
    for (int k = 0; k <= last_column; ++k) {
      float u = float(k) / float(last_column);
      float azimuth = GetAzimuthOfColumn(u);
      float width = kPi * (0.3 + 1.4 * u) / float(last_column);
      width *= k == 0 || k == last_column ? 0.5 : 1.0;
      float c = cos(azimuth);
      float s = sin(azimuth);
      vec3 left = vec3(rise * (c * towards - s * across), sin(elevation)).xzy;
      vec3 right = vec3(rise * (c * towards + s * across), sin(elevation)).xzy;
      float nu = dot(left, view.sun);
      float share = (GetWeight(index, left) + GetWeight(index, right)) * rise * span * width;
      sum += share * GuessRadiance(view, nu)
          * texelFetch(sky_view, ivec2(k * (size.x - 1) / last_column, row), 0);
      norm += share;
    }
  }
  return index == 6 ? sum / norm : sum;
}

void main() {
  int index = int(gl_FragCoord.x + tile_origin.x);
  vec3 sun = ReadSkyView(sky_view).sun;
  float h = clamp(altitude, 1.0, 0.99 * kAtmosphereHeight);
  float above = asin(clamp(sun.y, -1.0, 1.0)) - asin(GetCosineOfHorizon(h));
  vec4 risen = kSolarIrradiance * GetTransmittanceToTop(columns, h, sun.y);
  if (index == 8) {
    vec4 sum = vec4(0.0);
    float norm = 0.0;
    for (int i = 0; i < kCloudLevels; ++i) {
      float part = (float(i) + 0.5) / float(kCloudLevels);
      float level = min(h + mix(kLowestCloud, kHighestCloud, part), 0.99 * kAtmosphereHeight);
      float weight = (1.0 - part) * (1.0 - part) * (1.0 - part);
      sum += weight * GetTransmittanceToSun(columns, level, sun.y);
      norm += weight;
    }
    result = kSolarIrradiance * sum / norm;
    return;
  }
  vec4 sky = IntegrateSky(index);
  result = index == 1 ? risen * GetVisibleFractionOfDisc(above) : index == 7 ? risen : sky;
}
