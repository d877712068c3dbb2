// The direct sun's illuminance at normal incidence over its elevation from -1 to 90 degrees, dense at the
// horizon (-1 + 91 t^2): rgb linear Rec. 709, a luminous, klx.

#include "atmosphere/read_sky_view.glsl"
#include "frame/srgb.glsl"

uniform vec2 pass_size;
uniform float altitude;
uniform sampler2D columns;
out vec4 result;

void main() {
  float t = floor(gl_FragCoord.x) / (pass_size.x - 1.0);
  float elevation = radians(-1.0 + 91.0 * t * t);
  float h = clamp(altitude, 1.0, 0.99 * kAtmosphereHeight);
  vec4 irradiance = kSolarIrradiance * GetTransmittanceToTop(columns, h, sin(elevation))
      * GetVisibleFractionOfDisc(elevation - asin(GetCosineOfHorizon(h)));
  vec3 light = SpectralToRec709(irradiance);
  result = vec4(light, GetLuminance(light));
}
