// Transmittance of the path to the sun over 380-780 nm: total, and of molecules, aerosol and ozone
// alone. A sun below the horizon gets the path that grazes the horizon.

#include "atmosphere/wavelength.glsl"

uniform vec2 pass_size;
uniform float sun_elevation;
uniform float altitude;
uniform sampler2D columns;
out vec4 result;

void main() {
  float wavelength = mix(380.0, 780.0, floor(gl_FragCoord.x) / (pass_size.x - 1.0));
  float h = clamp(altitude, 1.0, 0.99 * kAtmosphereHeight);
  float mu = max(sin(radians(sun_elevation)), GetCosineOfHorizon(h));
  vec3 path = FetchBilinear(columns, GetColumnsCoordinate(h, mu)).xyz;
  vec3 depth = path * vec3(GetRayleighScatteringAt(wavelength), GetMieExtinctionAt(wavelength),
                           GetOzoneAbsorptionAt(wavelength));
  result = exp(-vec4(depth.x + depth.y + depth.z, depth));
}
