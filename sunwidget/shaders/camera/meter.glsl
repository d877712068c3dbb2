// The reading of a camera's exposure meter under this sun, from the model alone. One pixel: r is the mean
// log2 luminance of the picture, g log2 of the sky's (from the mean of its fourth root, so that a sun in view does
// not dominate), both in the photo's scene-linear unit.

#include "frame/picture.glsl"
#include "atmosphere/read_sky_view.glsl"
#include "sky/matched_sky.glsl"
#include "sky/daylight.glsl"

uniform sampler2D sky_view;
uniform sampler2D light;
uniform sampler2D layers;
uniform float sun_azimuth;
uniform float sun_elevation;
uniform float land_facing;

out vec4 result;

const int kColumns = 16;
const int kRows = 12;
const float kLandAlbedo = 0.18;

void main() {
  float sum = 0.0;
  vec2 bright = vec2(0.0);
  vec3 sun = GetSunDirection(sun_azimuth, sun_elevation);
  // The meter averages, so a half-visible sun represents any state of the disc: a twig that hides
  // the sun must not change the exposure.
  vec3 land = sky_gain * kLandAlbedo * (GetNightSky(GetMoon()) + GetLightScale(GetMoon()) / 3.14159265
      * GetLandIrradiance(ReadDaylight(light), 0.5, land_facing, sun));
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      vec2 place = (vec2(column, row) + 0.5) / vec2(kColumns, kRows);
      float sky = ReadBilinear(layers, place).r;
      vec3 color = mix(land, GetMatchedSky(sky_view, GetViewDirection(place)), sky);
      float luminance = max(dot(color, vec3(0.2126, 0.7152, 0.0722)), 1e-20);
      sum += log2(luminance);
      bright += (sky + 1e-3) * vec2(sqrt(sqrt(luminance)), 1.0);
    }
  }
  result = vec4(sum / float(kColumns * kRows), 4.0 * log2(bright.x / bright.y), 0.0, 1.0);
}
