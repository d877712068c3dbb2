// Color and luminance of the zenith over the sun's elevation, -12 to 28 degrees, half a degree per
// texel: CIE 1931 x, y and luminance in cd m^-2. With as many orders as the model has.

#include "atmosphere/sky_march.glsl"
#include "atmosphere/spectrum.glsl"

uniform float altitude;
out vec4 result;

void main() {
  float mu_s = sin(radians(-12.0 + 0.5 * floor(gl_FragCoord.x)));
  float h = clamp(altitude, 1.0, 0.99 * kAtmosphereHeight);
  vec3 xyz = kSpectralToXyz * ComputeSkyRadiance(h, 1.0, mu_s, mu_s);
  float sum = xyz.x + xyz.y + xyz.z;
  // Without light the color is equal-energy white (E).
  vec2 chromaticity = sum > 0.0 ? xyz.xy / sum : vec2(1.0 / 3.0);
  result = vec4(chromaticity, 1000.0 * max(xyz.y, 0.0), 0.0);
}
